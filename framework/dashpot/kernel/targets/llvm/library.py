"""Functions of the C library, taken one lane after the other; NaN and infinity as they have it."""

from __future__ import annotations

from collections.abc import Sequence

from dashpot.kernel.ir.layout import LANES
from dashpot.kernel.targets.llvm.assembly import NUMBER, Assembly, Bundle

# those of the graph that are not written out, by their names in C
LIBRARY = {"sin": "sin", "cos": "cos"}
ARGUMENTS = {"sin": 1, "cos": 1, "pow": 2}


def one_by_one(name: str, arguments: Sequence[Bundle]) -> Bundle:
    """A function of the library on bundles."""
    places = ", ".join(f"{NUMBER} {{{number}}}" for number in range(len(arguments)))
    return arguments[0].made(f"call {NUMBER} @{name}_of_lanes({places})", NUMBER, *arguments[1:])


def library_functions() -> str:
    """The text of what ``one_by_one`` calls."""
    return "\n".join(_lane_by_lane(name, count) for name, count in ARGUMENTS.items())


def _lane_by_lane(name: str, count: int) -> str:
    assembly = Assembly()
    total = "poison"
    for lane in range(LANES):
        parts = [assembly.new(f"extractelement {NUMBER} %x{place}, i64 {lane}") for place in range(count)]
        answer = assembly.new(f"call double @{name}({', '.join(f'double {part}' for part in parts)})")
        total = assembly.new(f"insertelement {NUMBER} {total}, double {answer}, i64 {lane}")
    assembly.do(f"ret {NUMBER} {total}")
    places = ", ".join(f"{NUMBER} %x{place}" for place in range(count))
    head = f"declare double @{name}({', '.join(['double'] * count)})\n"
    return head + assembly.function(f"internal {NUMBER} @{name}_of_lanes({places})")
