"""A damper that stands on something soft."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View
from dashpot.model.network import Branch, NetworkSpec
from dashpot.model.patch import branch_names, replace_branch
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
Numbers = Mapping[str, float]
UNITS = {
    "stiffness": "N/m",
    "relaxation_time": "s",
    "force": "N",
    "exponent": "1",
    "reference": "m/s",
    "compression": "N*s/m",
    "rebound": "N*s/m",
    "compression_knee": "m/s",
    "rebound_knee": "m/s",
    "compression_opened": "N*s/m",
    "rebound_opened": "N*s/m",
}
PLAIN = ("exponent", "reference", "compression_opened", "rebound_opened")
NEAR = 1e-2  # of 1/w at the end of the band: a lag so short that the force changes in proportion to it
SHORTEST = 1.01e-5  # s, the least lag that a file may ask for
STRAIGHT = 1e3  # m/s, the knee of a valve that has none
REFERENCE = 0.1  # m/s


class CompliantDamper(Cause):
    """A dashpot of the network has a spring in series: oil, hoses, a rod in a soft mount."""

    word = "compliant_damper"
    kind = "specimen"
    about = "compliance in series with a damper"
    shows = "the loop of force over velocity opens; storage stiffness grows like (damping w)^2 over the compliance"
    confused_with = {
        "delay": "a spring alone on the same channels: a delay stays, as does its effect on the force of springs",
        "relaxation": "speeds far beyond: the damping beside a relaxing branch stays, that of a soft damper falls off",
        "moving_mass": "a second amplitude of a damper that is not linear: a mass stays the same",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Each dashpot of the network by itself, the force changing in proportion to a small compliance."""
        outermost = set(branch_names(network.text)) if network.document and not network.joints else set()
        found = [(branch, _dashpot_of(branch)) for branch in network.leaves() if branch.name in outermost]
        dampers = [_Damper(branch, dashpot) for branch, dashpot in found if dashpot and not branch.scale]
        if not dampers:
            return
        lag = NEAR / (2.0 * np.pi * view.highest_frequency)

        def columns(view: View, run: str) -> Array:
            return np.array([damper.column(view, run, lag) for damper in dampers])

        def extend(text: str, atoms: Sequence[Atom]) -> str:
            for compliance, place in atoms:
                text = dampers[int(place)].extend(text, compliance)
            return text

        yield Suspect(
            "a spring in series with a damper",
            tuple(map(float, range(len(dampers)))),
            columns,
            extend,
            unknowns=0,
            quantity="compliance",
            unit="m/N",
        )


@dataclass(frozen=True)
class _Dashpot:
    """What stands for a dashpot with a spring: the element, its numbers over the stiffness, and a usual damping."""

    element: str
    values: Callable[[float], Numbers]
    damping: float


@dataclass(frozen=True)
class _Damper:
    branch: Branch
    dashpot: _Dashpot

    def column(self, view: View, run: str, lag: float) -> Array:
        """The change of the force (n,) over the compliance."""
        stiffness = self.dashpot.damping / lag
        rigid = {key: value.number for key, value in self.branch.values.items()}
        rigid |= {key: curve.values[0].number for key, curve in self.branch.curves.items()}
        soft = view.respond(run, self.dashpot.element, [self.dashpot.values(stiffness)])[0]
        change = (soft - view.respond(run, self.branch.element.word, [rigid])[0]) * stiffness
        # a spring has no memory yet at the first sample
        change[0] = change[1]
        return change

    def extend(self, text: str, compliance: float) -> str:
        """The network with the dashpot on a spring."""
        lag = max(compliance * self.dashpot.damping, SHORTEST)
        numbers = self.dashpot.values(self.dashpot.damping / lag)
        shown = {key: pretty(number, UNITS[key], 6) for key, number in numbers.items()}
        entries = [f"{key}: {number if key in PLAIN else f'{{start: {number}}}'}" for key, number in shown.items()]
        entry = f"{{element: {self.dashpot.element}, {', '.join(entries)}}}"
        return replace_branch(text, self.branch.name, entry)


def _dashpot_of(branch: Branch) -> _Dashpot | None:
    """The dashpot that a branch is; None for another law, and for one that no element has with a spring."""
    numbers = {key: value.number for key, value in branch.values.items()}
    word = branch.element.word
    if word == "damper":
        curve = branch.curves["damping"]
        return _linear(curve.values[0].number) if curve.form == "constant" else None
    if word == "quadratic_damper":
        return _power(numbers["damping"] * REFERENCE**2, 2.0, REFERENCE)
    if word == "power_law_damper":
        return _power(numbers["force"], numbers["exponent"], numbers.get("reference", REFERENCE))
    if word == "asymmetric_damper" and {numbers.get(f"{side}_exponent", 1.0) for side in SIDES} == {1.0}:
        return _valve(numbers)
    return None


SIDES = ("compression", "rebound")


def _linear(damping: float) -> _Dashpot:
    return _Dashpot("maxwell", lambda k: {"stiffness": k, "relaxation_time": damping / k}, damping)


def _power(force: float, exponent: float, reference: float) -> _Dashpot:
    known = {"force": force, "exponent": exponent, "reference": reference}
    return _Dashpot("compliant_damper", lambda k: {"stiffness": k, **known}, force / reference)


def _valve(numbers: Numbers) -> _Dashpot:
    known = {side: numbers[side] for side in SIDES}
    for side in SIDES:
        digression = numbers.get(f"{side}_digression", 0.0)
        known[f"{side}_knee"] = 1.0 / digression if digression > 1.0 / STRAIGHT else STRAIGHT
        known[f"{side}_opened"] = 0.0 if digression > 1.0 / STRAIGHT else numbers[side]
    return _Dashpot("valve", lambda k: {"stiffness": k, **known}, max(numbers[side] for side in SIDES))
