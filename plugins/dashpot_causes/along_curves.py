"""Forces along the curve of a spring of the network: one that relaxes, and a damping in proportion to its slope."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import NOTHING, Atom, Suspect, View, branch_lines, free_name
from dashpot.data.drive import drive_from_path
from dashpot.kernel.spline import slopes
from dashpot.model.network import Branch, Characteristic, Group, NetworkSpec
from dashpot.model.patch import add_branch
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
UNITS = {"share": "1", "relaxation_time": "s", "time": "s"}
PLACES = 8
STEPS = 50
DIGITS = 8
LOSS = (1e-3, 10.0)  # tangent of the loss angle at the end of the driven band, from which to which it is searched


def relaxing(view: View, network: NetworkSpec, fastest: float) -> Iterator[Suspect]:
    """For each spring whose curve is bent a force that relaxes along it, over times from ``fastest`` (s) on."""
    times = np.geomspace(max(2.0 * fastest, 2.0 * view.dt), 0.3 * view.duration, PLACES)
    for spring in _bent_springs(network):
        law = _Relaxing(spring, tuple(times.tolist()))
        yield Suspect(
            f"along the curve of {spring.branch.name}",
            law.times,
            law.columns,
            law.extend,
            quantity="share of the curve",
            unit="1",
            admits=lambda found: _slower(found, fastest),
        )


def damped(view: View, network: NetworkSpec, straight: float) -> Iterator[Suspect]:
    """For each spring whose curve is bent a damping in proportion to its slope, by which the loss angle is the same at
    every preload.

    Bent is what has a least slope of less than ``straight`` times the largest one.
    """
    for spring in _bent_springs(network):
        turn = 1.0 / (2.0 * np.pi * view.highest_frequency)
        law = _Damped(spring, (LOSS[0] * turn, LOSS[1] * turn))
        steepness = spring.steepness(view)
        if not steepness.min() < straight * steepness.max():
            continue
        yield Suspect(
            f"damping in proportion to the slope of {spring.branch.name}",
            (0.0,),
            law.columns,
            law.extend,
            unknowns=0,
            quantity="damping over stiffness",
            unit="s",
        )


def _bent_springs(network: NetworkSpec) -> Iterator[_Spring]:
    for branch in () if network.joints else network.leaves():
        curve = branch.curves.get("stiffness") if branch.element.word == "spring" else None
        if curve and curve.form in ("polynomial", "table"):
            yield _Spring(branch, curve)


def _slower(found: Mapping[str, float], fastest: float) -> bool:
    return all(time > fastest for name, time in found.items() if name.startswith("relaxation_time"))


@dataclass(frozen=True)
class _Spring:
    branch: Branch
    curve: Characteristic

    def forces(self, view: View, run: str) -> Array:
        """The force (n,) of the spring alone in N along a run."""
        return self._along(view.displacement(run), view.velocity(run), view.step(run))

    def steepness(self, view: View) -> Array:
        """Slopes (STEPS,) in N/m from one end of the measured deflections to the other."""
        places, step = np.linspace(*view.reach, STEPS + 1, retstep=True)
        return np.diff(self._along(places, np.full_like(places, step), 1.0)) / step

    def _along(self, x: Array, v: Array, dt: float) -> Array:
        from dashpot.kernel.network import compile_network

        alone = compile_network(NetworkSpec("alone", Group("", "parallel", (self.branch,))))
        return np.atleast_1d(alone.along(drive_from_path(dt, x, v, np.gradient(v, dt)))())

    def beside(
        self,
        text: str,
        branch: str,
        element: str,
        numbers: Mapping[str, float],
        bounds: Mapping[str, tuple[float, float]] = NOTHING,
    ) -> str:
        """The network with a branch of an element that has the same curve as it is, and numbers."""
        lines = branch_lines(free_name(text, branch), element, numbers, UNITS, bounds=bounds)
        return add_branch(text, f"{lines}\n  stiffness: {self._written()}")

    def _written(self) -> str:
        law = self.curve.curve
        numbers = ", ".join(pretty(value.number, value.unit, DIGITS) for value in self.curve.values)
        if self.curve.form == "polynomial":
            return f"{{polynomial: [{numbers}]}}"
        at = ", ".join(pretty(place, law.over[1], DIGITS) for place in self.curve.at)
        return f"{{{law.over[0]}: [{at}], {law.value[0]}: [{numbers}]}}"


@dataclass(frozen=True)
class _Relaxing:
    spring: _Spring
    times: tuple[float, ...]

    def columns(self, view: View, run: str) -> Array:
        """The forces (m, n) that are left of the rises of the curve, straight from sample to sample."""
        from scipy.signal import lfilter

        rises = np.diff(self.spring.forces(view, run), prepend=np.nan)
        rises[0] = 0.0
        shares = view.step(run) / np.array(self.times)
        return np.array([lfilter([-np.expm1(-share) / share], [1.0, -np.exp(-share)], rises) for share in shares])

    def extend(self, text: str, atoms: Sequence[Atom]) -> str:
        """The network with the branch."""
        share, time = atoms[0]
        return self.spring.beside(text, "relaxation", "relaxing_spring", {"share": share, "relaxation_time": time})


@dataclass(frozen=True)
class _Damped:
    spring: _Spring
    times: tuple[float, float]

    def columns(self, view: View, run: str) -> Array:
        """The rate (1, n) in N/s at which the force of the spring changes."""
        return slopes(self.spring.forces(view, run)[None]) / view.step(run)

    def extend(self, text: str, atoms: Sequence[Atom]) -> str:
        """The network with the branch."""
        numbers = {"time": float(np.clip(atoms[0][0], *self.times))}
        return self.spring.beside(
            text, "preload_dependent_damping", "proportional_damper", numbers, {"time": self.times}
        )
