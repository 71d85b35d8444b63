"""A network as functions that anybody's own compiled code can call."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.kernel.compiler.compile import online_of
from dashpot.kernel.ir.online import SPAN, Online
from dashpot.kernel.ir.system import SMALLEST_SPAN
from dashpot.kernel.settings import used_settings, with_settings
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Solver:
    """Functions compiled by numba, for use inside ``@njit`` code; all numbers are in SI.

    A network with a single driven end and no loads has

    ``step(state, x, v, dt, parameters) -> force``: the step of ``dt`` seconds to the displacement ``x`` and the
    velocity ``v``; ``tangent_step``, alike, answers also how the force changes with ``x`` and with ``v``;
    ``simulate(x, v, dt, parameters, out)``: the force ``out`` (n,) along a record ``x`` (n,), ``v`` (n,);
    ``simulate_path(x, v, a, dt, parameters, out)``: the same with the accelerations, where they are known better than
    the cubic through places and velocities tells them; it is what ``dashpot simulate`` computes.

    Every network has

    ``step_nodes(state, x, v, load, dt, parameters, out)``: ``x``, ``v`` of the nodes ``driven``, ``load`` in N of those
    ``loaded``; ``out`` gets the forces of the driven nodes, then the positions of the nodes ``free``.

    ``status(state)``: 0 good, 1 forces at inner nodes not balanced, 2 no static equilibrium, 3 a force not finite.

    The first step from a fresh ``state`` is the begin of the record, at rest. A state belongs to its ``parameters`` (in
    the order of ``names``): others need a fresh one.
    """

    step: Callable[..., float] | None
    tangent_step: Callable[..., tuple[float, float, float]] | None
    simulate: Callable[..., None] | None
    simulate_path: Callable[..., None] | None
    step_nodes: Callable[..., None]
    status: Callable[..., int]
    names: tuple[str, ...]
    parameters: Array
    driven: tuple[str, ...]
    loaded: tuple[str, ...]
    free: tuple[str, ...]
    size: int

    def state(self, span: float = SMALLEST_SPAN) -> Array:
        """A fresh memory. ``span`` in m is how far the motion goes: inner nodes are solved for to a millionth of it."""
        memory = np.zeros(self.size)
        memory[SPAN] = max(span, SMALLEST_SPAN)
        return memory


def jit_network(spec: NetworkSpec, settings: Mapping[str, float] = MappingProxyType({})) -> Solver:
    """The solver of a network; ``settings`` in SI are those of a run on which its parameters depend.

    Of a channel that a parameter follows they tell, by its name, the one value that it has here.

    Raises InputError for a network that cannot be compiled, or that depends on a setting that is not given.
    """
    from dashpot.kernel.targets.numba.module import load_module
    from dashpot.kernel.targets.numba.stepping import print_solver

    online = online_of(spec)
    start = np.array([[slot.value.number for slot in spec.slots()]])
    numbers = with_settings(spec, start, used_settings(spec, settings))[0]
    return _solver(online, load_module(print_solver(online)), numbers)


def _solver(online: Online, module: Any, numbers: Array) -> Solver:
    return Solver(
        getattr(module, "step", None),
        getattr(module, "tangent_step", None),
        getattr(module, "simulate", None),
        getattr(module, "simulate_path", None),
        module.step_nodes,
        module.status,
        online.numbers,
        np.ascontiguousarray(numbers),
        online.driven,
        online.loaded,
        online.free,
        online.size,
    )
