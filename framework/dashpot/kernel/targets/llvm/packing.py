"""A single lane: what would stand in as many vectors, of which each holds one number eight times, stands in one."""

from __future__ import annotations

from collections.abc import Sequence

from dashpot.kernel.ir.layout import LANES
from dashpot.kernel.targets.llvm.assembly import Bundle, joined


def packed(bundles: Sequence[Bundle]) -> Bundle:
    """The numbers of bundles of one vector each, the same in all lanes, side by side in as few vectors as they need."""
    rows = [bundles[first : first + LANES] for first in range(0, len(bundles), LANES)]
    return joined([_side_by_side(row) for row in rows])


def unpacked(bundle: Bundle, count: int) -> list[Bundle]:
    """``count`` numbers that stand side by side, each in all lanes of a bundle of its own."""
    return [_taken(bundle, *divmod(number, LANES)) for number in range(count)]


def _side_by_side(bundles: Sequence[Bundle]) -> Bundle:
    # the lanes that are left over repeat the first number
    first, *others = bundles
    (name,) = first.names
    for lane, other in enumerate(others, 1):
        mask = ", ".join(f"i32 {LANES + lane if place == lane else place}" for place in range(LANES))
        name = first.assembly.new(_shuffle(first.type, name, other.names[0], mask))
    return Bundle(first.assembly, first.type, (name,))


def _taken(bundle: Bundle, vector: int, lane: int) -> Bundle:
    name = bundle.names[vector]
    shuffle = _shuffle(bundle.type, name, "poison", ", ".join([f"i32 {lane}"] * LANES))
    return Bundle(bundle.assembly, bundle.type, (bundle.assembly.new(shuffle),))


def _shuffle(kind: str, first: str, second: str, mask: str) -> str:
    return f"shufflevector {kind} {first}, {kind} {second}, <{LANES} x i32> <{mask}>"
