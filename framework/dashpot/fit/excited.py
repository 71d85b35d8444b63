"""Which part of a damper's curve the runs have excited: what lies beyond was never measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.excitation import Excitation
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.kernel.system import CompiledSystem
from dashpot.model.network import Characteristic, NetworkSpec
from dashpot.model.topology import topology_of

Array = NDArray[np.float64]

VELOCITY = "m/s"
RARE = 1e-3  # share of the samples at either end that does not count


@dataclass(frozen=True)
class VelocityCurve:
    """A force table over velocity: its ``path``, knots ``velocity`` m/s and ``force`` N, ``low`` and ``high`` ends of
    their 95 % intervals (of a number that was not searched: the number), and what the simulated runs ``reached``, m/s.
    """

    path: str
    velocity: tuple[float, ...]
    force: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    reached: tuple[float, float]

    @property
    def excited(self) -> tuple[bool, ...]:
        """Whether each knot lies within what was reached."""
        return tuple(self.reached[0] <= velocity <= self.reached[1] for velocity in self.velocity)


def velocity_curves(spec: NetworkSpec, runs: Sequence[ScoredRun]) -> list[VelocityCurve]:
    """The tables over velocity of a network, identified or known, with what its simulation reaches in ``runs``."""
    curves = {path: curve for path, curve in spec.curves().items() if is_over_velocity(curve)}
    if not curves:
        return []
    speeds: dict[str, list[Array]] = {path: [] for path in curves}
    for excitation in {run.record or run.name: run.excitation for run in runs}.values():
        for path, seen in _speeds(spec, excitation, curves).items():
            speeds[path] += seen
    return [_told(path, curve, np.concatenate(speeds[path])) for path, curve in curves.items()]


def is_over_velocity(curve: Characteristic) -> bool:
    """Whether a curve is a table of a force over velocity."""
    return curve.form == "table" and curve.curve.over[1] == VELOCITY


def _speeds(spec: NetworkSpec, excitation: Excitation, curves: Mapping[str, Characteristic]) -> dict[str, list[Array]]:
    moving = _velocities(spec, excitation)
    still = np.zeros(excitation.samples)
    found: dict[str, list[Array]] = {}
    for path in curves:
        edges = [edge for edge in topology_of(spec).edges if edge.branch.numbers == path.rpartition(".")[0]]
        found[path] = [moving.get(edge.lower, still) - moving.get(edge.upper, still) for edge in edges]
    return found


def _velocities(spec: NetworkSpec, excitation: Excitation) -> dict[str, Array]:
    """The velocity (n,) m/s of every node that moves."""
    network = compile_network(spec)
    if not isinstance(network, CompiledSystem):
        return {node: drive.velocity for node, drive in excitation.motions.items()}
    rows = network.prepare(excitation)
    solved = network.solve(rows)
    known = {node: rows.excitation.motions[node].velocity for node in network.outputs}
    return known | {
        node: np.gradient(motion, excitation.dt) for node, motion in zip(solved.unknown, solved.motion[0], strict=True)
    }


def _told(path: str, curve: Characteristic, speeds: Array) -> VelocityCurve:
    low, high = np.quantile(speeds[np.isfinite(speeds)], [RARE, 1.0 - RARE])
    numbers = [value.number for value in curve.values]
    ends = [value.interval or (value.number, value.number) for value in curve.values]
    return VelocityCurve(
        path,
        tuple(curve.at),
        tuple(numbers),
        tuple(end[0] for end in ends),
        tuple(end[1] for end in ends),
        (float(low), float(high)),
    )
