"""A force that relaxes along the curve of a spring of the network: quasi-linear viscoelasticity."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Suspect, View, branch_lines, free_name
from dashpot.data.drive import drive_from_path
from dashpot.model.network import Branch, Characteristic, Group, NetworkSpec
from dashpot.model.patch import add_branch
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
UNITS = {"share": "1", "relaxation_time": "s"}
PLACES = 8
DIGITS = 8


def along_curves(view: View, network: NetworkSpec, fastest: float) -> Iterator[Suspect]:
    """For each spring whose curve is bent a force that relaxes along it, over times from ``fastest`` (s) on."""
    if network.joints:
        return
    for branch in network.leaves():
        curve = branch.curves.get("stiffness") if branch.element.word == "spring" else None
        if curve and curve.form in ("polynomial", "table"):
            times = np.geomspace(max(2.0 * fastest, 2.0 * view.dt), 0.3 * view.duration, PLACES)
            spring = _Spring(branch, curve, tuple(times.tolist()))
            yield Suspect(
                f"along the curve of {branch.name}",
                spring.times,
                spring.columns,
                spring.extend,
                quantity="share of the curve",
                unit="1",
                admits=lambda found: _slower(found, fastest),
            )


def _slower(found: Mapping[str, float], fastest: float) -> bool:
    return all(time > fastest for name, time in found.items() if name.startswith("relaxation_time"))


@dataclass(frozen=True)
class _Spring:
    branch: Branch
    curve: Characteristic
    times: tuple[float, ...]

    def columns(self, view: View, run: str) -> Array:
        """The forces (m, n) that are left of the rises of the curve, straight from sample to sample."""
        from scipy.signal import lfilter

        from dashpot.kernel.network import compile_network

        alone = compile_network(NetworkSpec("alone", Group("", "parallel", (self.branch,))))
        x, v, dt = view.displacement(run), view.velocity(run), view.step(run)
        rises = np.diff(np.atleast_1d(alone.along(drive_from_path(dt, x, v, np.gradient(v, dt)))()), prepend=np.nan)
        rises[0] = 0.0
        shares = dt / np.array(self.times)
        return np.array([lfilter([-np.expm1(-share) / share], [1.0, -np.exp(-share)], rises) for share in shares])

    def extend(self, text: str, atoms: Sequence[Atom]) -> str:
        """The network with the branch, its curve as it is."""
        share, time = atoms[0]
        lines = branch_lines(
            free_name(text, "relaxation"), "relaxing_spring", {"share": share, "relaxation_time": time}, UNITS
        )
        return add_branch(text, f"{lines}\n  stiffness: {self._written()}")

    def _written(self) -> str:
        law = self.curve.curve
        numbers = ", ".join(pretty(value.number, value.unit, DIGITS) for value in self.curve.values)
        if self.curve.form == "polynomial":
            return f"{{polynomial: [{numbers}]}}"
        at = ", ".join(pretty(place, law.over[1], DIGITS) for place in self.curve.at)
        return f"{{{law.over[0]}: [{at}], {law.value[0]}: [{numbers}]}}"
