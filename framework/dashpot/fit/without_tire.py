"""The masses of a network identified once more without what lies between the rig and them: the tire.

Where the motion of a wheel is measured, the wheel itself can be driven by it. The network then begins at the wheel; the
force on it is the one that the platform measures, since the tire passes it on. No error of the tire model is left, and
a mass that comes out otherwise than with the tire tells of one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.data.excitation import channel_at
from dashpot.data.run import Run
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import refine
from dashpot.fit.scored import score_run
from dashpot.fit.thinned import thinned_objective
from dashpot.fit.uncertainty import assess_uncertainty
from dashpot.kernel.network import compile_network
from dashpot.model.network import MASSES, NetworkSpec
from dashpot.model.topology import COMPLIANCE

STEPS = 12


@dataclass(frozen=True)
class MassWithoutTire:
    """A mass in kg at a ``node`` with its 95 % ``interval``; ``rmse`` of the forces in N at which it was found."""

    node: str
    mass: float
    interval: tuple[float, float]
    rmse: float


def masses_without_tire(fitted: NetworkSpec, runs: Sequence[Run], jobs: int = 1) -> list[MassWithoutTire]:
    """The searched masses of an identified network, found again from the measured motion of the wheels.

    All free parameters move, from where they were identified. Empty where nothing between rig and wheels can be left
    out, where a run does not have the motion of every wheel, or where no mass is searched.
    """
    wheels = wheels_behind(fitted)
    records = list({run.record: run for run in runs}.values())
    if not wheels or not all(
        channel_at("displacement", wheel) in run.channels for run in records for wheel in wheels.values()
    ):
        return []
    parts = one_force_each(Dataset("wheels", tuple(_at_wheels(run, wheels) for run in records))).runs
    scored = [score_run(run) for run in parts]
    spec = with_ranges(cut_off(fitted, wheels), natural_sizes(scored))
    objective, coordinates = Objective(compile_network(spec), scored, jobs), search_coordinates(spec)
    places = {path: number for number, path in enumerate(coordinates.paths) if _is_mass(spec, path)}
    if not places:
        return []
    start, sparse = coordinates.start, thinned_objective(objective)
    if sparse:
        start = refine(sparse, coordinates, start, steps=STEPS).point
    found = refine(objective, coordinates, start, steps=STEPS)
    known = assess_uncertainty(objective, coordinates, found.point)
    return [
        MassWithoutTire(
            path.rpartition(".")[0],
            coordinates.number(number, found.point[number]),
            known.intervals[number],
            found.loss,
        )
        for path, number in places.items()
    ]


def wheels_behind(spec: NetworkSpec) -> dict[str, str]:
    """Driven node -> the one node with a mass to which all its branches lead; empty where a node has no such."""
    found: dict[str, str] = {}
    for name in (name for name, joint in spec.joints.items() if joint.hold == "driven"):
        others = {
            ends.upper if ends.lower == name else ends.lower
            for ends in spec.ends.values()
            if name in (ends.lower, ends.upper)
        }
        if len(others) != 1 or not spec.joints[next(iter(others))].masses:
            return {}
        found[name] = others.pop()
    return found if len(set(found.values())) == len(found) else {}


def cut_off(spec: NetworkSpec, wheels: Mapping[str, str]) -> NetworkSpec:
    """The network without the driven nodes, their branches and a fixture below them; the wheels are driven instead."""
    ends = {name: pair for name, pair in spec.ends.items() if not {pair.lower, pair.upper} & set(wheels)}
    members = tuple(member for member in spec.root.members if member.name in ends)
    joints = {
        name: replace(joint, hold="driven") if name in wheels.values() else joint
        for name, joint in spec.joints.items()
        if name not in wheels
    }
    measurement = {key: value for key, value in spec.measurement.items() if key != COMPLIANCE}
    return replace(spec, root=replace(spec.root, members=members), measurement=measurement, joints=joints, ends=ends)


def _at_wheels(run: Run, wheels: Mapping[str, str]) -> Run:
    """The run with motion and force of each wheel; it is a record of its own again."""
    channels: dict[str, np.ndarray] = {}
    for platform, wheel in wheels.items():
        channels[channel_at("displacement", wheel)] = run.channels[channel_at("displacement", wheel)]
        channels[channel_at("force", wheel)] = run.channels[channel_at("force", platform)]
    return replace(run, name=run.record, group=run.cluster, repeats=None, channels=channels, end="")


def _is_mass(spec: NetworkSpec, path: str) -> bool:
    node, _, key = path.rpartition(".")
    return node in spec.joints and key in MASSES
