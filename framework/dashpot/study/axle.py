"""What the runs of an axle tell beside the fit of its models: contact forces, slow curves, wheels without their tires.

An *axle* is a network whose driven nodes, the platforms, each lead to one node with a mass, the wheel.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.axle_curves import AxleCurves, SlowAxle, SlowCurve, axle_curves, behind_tire, slow_curve
from dashpot.data.drive import drive_from_samples
from dashpot.data.excitation import Excitation, channel_at
from dashpot.data.phase import NotOscillatingError
from dashpot.data.run import Run
from dashpot.data.wheel_mass import WheelMass, WheelRun, wheel_mass
from dashpot.fit.without_tire import wheels_behind
from dashpot.kernel.api import solve
from dashpot.kernel.network import compile_network
from dashpot.model.network import Branch, Group, NetworkSpec

Array = NDArray[np.float64]

TOGETHER = 0.9  # correlation of two motions from which they are in phase, or against each other
TIRE_SPEED = 1e-3  # m/s at which the curve of a tire model is taken
RUN_UP = 5e-3  # m, first guess of the deflection of a tire


@dataclass(frozen=True, eq=False)
class Axle:
    """A network with ``wheels`` (platform -> wheel) and its measured ``runs``, each force by itself."""

    network: NetworkSpec
    wheels: Mapping[str, str]
    runs: tuple[Run, ...]

    @property
    def records(self) -> list[Run]:
        """One run of each record."""
        return list({run.record: run for run in self.runs}.values())

    def added_mass(self, run: Run, wheel: str) -> float:
        """What the settings of a run have put on a wheel, kg."""
        masses = self.network.joints[wheel].masses.values()
        return float(sum(run.settings.get(value.setting, 0.0) for value in masses if value.setting))


def axle_of(network: NetworkSpec, runs: Sequence[Run]) -> Axle | None:
    """The axle that a network describes; None for another network."""
    wheels = wheels_behind(network)
    return Axle(network, wheels, tuple(runs)) if wheels else None


def contact_responses(axle: Axle, curves: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """The curves of dynamic stiffness of sweeps as amplitudes of the wheel contact force over frequency.

    Each has ``run``, ``wheel``, ``added_mass`` kg, ``frequency`` (n,) Hz, ``measured`` (n,) N and ``simulated[model]``
    (n,) N.
    """
    runs = {run.name: run for run in axle.runs}
    found = []
    for curve in curves:
        run = runs.get(curve["run"])
        if run is None or run.end not in axle.wheels or np.size(curve["frequency"]) < 2:
            continue
        wheel = axle.wheels[run.end]
        found.append(
            {
                "run": run.record,
                "wheel": wheel,
                "added_mass": axle.added_mass(run, wheel),
                "frequency": curve["frequency"],
                "measured": curve["measured"]["force"],
                "simulated": {label: response["force"] for label, response in curve["simulated"].items()},
            }
        )
    return found


def wheel_masses(axle: Axle) -> dict[str, dict[str, WheelMass]]:
    """Wheel -> its mass without any model, the damper ``rigid`` or ``elastic`` in its fixing; see ``wheel_mass``."""
    found: dict[str, dict[str, WheelMass]] = {}
    for platform, wheel in axle.wheels.items():
        motion, force = channel_at("displacement", wheel), channel_at("force", platform)
        runs = [
            WheelRun(run.channels[motion], run.channels[force], run.sample_time, axle.added_mass(run, wheel))
            for run in axle.records
            if run.kind == "sweep" and motion in run.channels
        ]
        try:
            found[wheel] = {"rigid": wheel_mass(runs), "elastic": wheel_mass(runs, elastic=True)} if runs else {}
        except (ValueError, NotOscillatingError):
            found[wheel] = {}
    return {wheel: masses for wheel, masses in found.items() if masses}


def measured_curves(axle: Axle) -> AxleCurves | None:
    """Springs, friction and anti-roll bar from the measured slow runs; None where there is none in phase."""
    return _curves([(run, _measured(axle, run)) for run in _slow(axle)])


def simulated_curves(axle: Axle, network: NetworkSpec) -> AxleCurves | None:
    """The same from the same runs as an identified network answers them."""
    compiled = compile_network(network)
    answers = []
    for run in _slow(axle):
        found = solve(compiled, Excitation.of_run(run))
        wheels = tuple(found.motion[wheel] for wheel in axle.wheels.values())
        forces = tuple(found.force[platform] for platform in axle.wheels)
        answers.append((run, SlowAxle(wheels, forces, run.sample_time)))  # type: ignore[arg-type]
    return _curves(answers)


def _slow(axle: Axle) -> list[Run]:
    slow = [run for run in axle.records if run.kind == "quasi_static"]
    return slow if len(axle.wheels) == 2 else []


def _curves(answers: Sequence[tuple[Run, SlowAxle]]) -> AxleCurves | None:
    in_phase = [slow for _, slow in answers if _together(slow) > TOGETHER]
    against = [slow for _, slow in answers if _together(slow) < -TOGETHER]
    return axle_curves(in_phase[0], against[0] if against else None) if in_phase else None


def _together(slow: SlowAxle) -> float:
    return float(np.corrcoef(*slow.wheels)[0, 1])


def _measured(axle: Axle, run: Run) -> SlowAxle:
    """The wheels as they were measured; where they were not, as the tires of the network let them be."""
    forces = tuple(run.channels[channel_at("force", platform)] for platform in axle.wheels)
    if all(channel_at("displacement", wheel) in run.channels for wheel in axle.wheels.values()):
        wheels = tuple(run.channels[channel_at("displacement", wheel)] for wheel in axle.wheels.values())
    else:
        wheels = tuple(
            behind_tire(
                run.channels[channel_at("displacement", platform)],
                force,
                tire_curve(axle.network, platform, float(force.max())),
            )
            for platform, force in zip(axle.wheels, forces, strict=True)
        )
    return SlowAxle(wheels, forces, run.sample_time)  # type: ignore[arg-type]


def tire_curve(network: NetworkSpec, platform: str, force: float) -> SlowCurve:
    """The slow curve, up to a force in N, of what stands between a platform and its wheel in a network."""
    names = {name for name, ends in network.ends.items() if platform in (ends.lower, ends.upper)}
    members = tuple(_with_own_numbers(member) for member in network.root.members if member.name in names)
    tire = compile_network(replace(network, root=replace(network.root, members=members), joints={}, ends={}))
    depth = RUN_UP
    while True:
        step = depth / 400.0
        path = np.interp(np.arange(1601) % 800, [0.0, 400.0, 800.0], [0.0, depth, 0.0])
        drive = drive_from_samples(step / TIRE_SPEED, path, smooth=False)
        [answer] = solve(tire, Excitation.of_drive(drive)).force.values()
        if answer.max() > 1.05 * force or depth > 1.0:
            return slow_curve(path, answer, step / TIRE_SPEED)
        depth *= 1.5


def _with_own_numbers(member: Branch | Group) -> Branch | Group:
    """A part that stands alone: where it shares the parameters of another one, it has copies of them."""
    if isinstance(member, Group):
        return replace(member, members=tuple(_with_own_numbers(inner) for inner in member.members))
    return replace(member, shares="")
