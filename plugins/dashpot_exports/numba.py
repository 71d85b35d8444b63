"""A Python module for numba."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from dashpot.contract.export import Export
from dashpot.model.network import NetworkSpec

if TYPE_CHECKING:
    from dashpot.kernel.export import Exported

ABOUT = """\
{title}

The functions are those of network.jit(): step, tangent_step, simulate, simulate_path, step_nodes and status. SI units,
compression positive; the first step from a fresh state is the begin of the record, at rest.
"""
TEXT = """

NAMES = {names!r}
UNITS = {units!r}
PARAMETERS = np.array({values!r})
DRIVEN, LOADED, FREE = {driven!r}, {loaded!r}, {free!r}
RANGE = {seen!r}  # with which the parameters were identified


def fresh_state(span={smallest!r}):
    memory = np.zeros({size})
    memory[{place}] = max(span, {smallest!r})  # how far the motion goes, m: inner nodes are solved for to a millionth
    return memory
"""


class Numba(Export):
    """A Python module of functions for your own ``@njit`` code that needs numba and numpy, but not dashpot."""

    word = "numba"

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``NAME.py``."""
        from dashpot.kernel.export import exported
        from dashpot.kernel.targets.c99.header import identifier
        from dashpot.kernel.targets.numba.code import AloneCode
        from dashpot.kernel.targets.numba.stepping import print_solver

        found = exported(network)
        about = repr(ABOUT.format(title=found.title))
        text = f"{about}\n\n{print_solver(found.online, AloneCode)}{_parameters(found)}"
        return {f"{identifier(network.name)}.py": text.encode()}


def _parameters(found: Exported) -> str:
    from dashpot.kernel.ir.online import SPAN
    from dashpot.kernel.ir.system import SMALLEST_SPAN

    online = found.online
    return TEXT.format(
        names=online.numbers,
        units=tuple(found.units),
        values=list(found.values),
        driven=online.driven,
        loaded=online.loaded,
        free=online.free,
        seen=dict(found.spec.identified.range),
        smallest=SMALLEST_SPAN,
        size=online.size,
        place=SPAN,
    )
