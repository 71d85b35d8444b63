"""A damper that stands on something soft."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View
from dashpot.model.network import Branch, NetworkSpec
from dashpot.model.patch import branch_names, replace_branch, set_entry
from dashpot.text.quantity import pretty
from dashpot_causes.relaxation import FASTEST

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
    "travel": "m",
}
PLAIN = ("exponent", "reference", "compression_opened", "rebound_opened")
# of 1/w at the end of the band: a lag so short that the force changes in proportion to it, and some longer ones
LAGS = (1e-2, *(0.0625 * 2.0**step for step in range(7)))
# of the travel of a spring that stiffens: over what a linear one would be pressed by the damping at the highest speed
RATIOS = (1.0, 3.0)
SHORTEST = 1.01e-5  # s, the least lag that a file may ask for
STRAIGHT = 1e3  # m/s, the knee of a valve that has none
REFERENCE = 0.1  # m/s
SMALL = 1e-2  # of the travel of a spring that stiffens: its force grows by as much
TRAVELS = (1e-5, 1.0)  # m, from the least to the largest that a file may ask for


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
        """Each dashpot of the network on springs that let it lag by some times; of one that has a spring, how that
        stiffens.
        """
        outermost = set(branch_names(network.text)) if network.document and not network.joints else set()
        branches = [branch for branch in network.leaves() if branch.name in outermost and not branch.scale]
        lags = np.array(LAGS) / (2.0 * np.pi * view.highest_frequency)
        rigid = [_Damper(branch, dashpot, lags) for branch in branches if (dashpot := _dashpot_of(branch))]
        if rigid:
            yield _form("a spring in series with a damper", rigid, "compliance", "m/N")
        linear = [(one.branch, one.dashpot.damping) for one in rigid if one.branch.element.word == "damper"]
        if linear:
            stiffening = [
                _Damper(branch, _stiffening(damping, ratio * view.speed), lags[1::2])
                for (branch, damping), ratio in product(linear, RATIOS)
            ]
            yield _form("a spring that stiffens in series with a damper", stiffening, "compliance", "m/N", unknowns=1)
        slowest = FASTEST / (2.0 * np.pi * view.highest_frequency)
        sprung = [_Sprung(branch) for branch in branches if _is_sprung(branch, slowest)]
        if sprung:
            yield _form("the spring in series with a damper stiffens", sprung, "inverse travel", "1/m")


def _form(
    name: str, laws: Sequence[_Damper] | Sequence[_Sprung], quantity: str, unit: str, unknowns: int = 0
) -> Suspect:
    """The places of a form are those of one law after the other."""
    owners = [law for law in laws for _ in range(law.places)]

    def columns(view: View, run: str) -> Array:
        return np.concatenate([law.columns(view, run) for law in laws])

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        for strength, number in atoms:
            text = owners[int(number)].extend(text, strength)
        return text

    grid = tuple(map(float, range(len(owners))))
    return Suspect(name, grid, columns, extend, unknowns=unknowns, quantity=quantity, unit=unit)


@dataclass(frozen=True)
class _Dashpot:
    """What stands for a dashpot with a spring: the element, its numbers over the stiffness, and a usual damping."""

    element: str
    values: Callable[[float], Numbers]
    damping: float


@dataclass(frozen=True, eq=False)
class _Damper:
    """A dashpot between both ends, and the lags (places,) in s that springs give it."""

    branch: Branch
    dashpot: _Dashpot
    lags: Array

    @property
    def places(self) -> int:
        """How many springs are tried."""
        return self.lags.size

    def columns(self, view: View, run: str) -> Array:
        """The changes of the force (places, n) over the compliances."""
        stiffness = self.dashpot.damping / self.lags
        rigid = {key: value.number for key, value in self.branch.values.items()}
        rigid |= {key: curve.values[0].number for key, curve in self.branch.curves.items()}
        soft = view.respond(run, self.dashpot.element, [self.dashpot.values(each) for each in stiffness.tolist()])
        changes = (soft - view.respond(run, self.branch.element.word, [rigid])) * stiffness[:, None]
        # a spring has no memory yet at the first sample
        changes[:, 0] = changes[:, 1]
        return changes

    def extend(self, text: str, compliance: float) -> str:
        """The network with the dashpot on a spring."""
        lag = max(compliance * self.dashpot.damping, SHORTEST)
        numbers = self.dashpot.values(self.dashpot.damping / lag)
        shown = {key: pretty(number, UNITS[key], 6) for key, number in numbers.items()}
        entries = [f"{key}: {number if key in PLAIN else f'{{start: {number}}}'}" for key, number in shown.items()]
        entry = f"{{element: {self.dashpot.element}, {', '.join(entries)}}}"
        return replace_branch(text, self.branch.name, entry)


@dataclass(frozen=True)
class _Sprung:
    """A dashpot on a spring."""

    branch: Branch
    places: ClassVar[int] = 1

    def columns(self, view: View, run: str) -> Array:
        """The change of the force (1, n) over one by the travel at which the spring is blocked, which is far away."""
        numbers = {key: value.number for key, value in self.branch.values.items()}
        stretch = min(numbers["relaxation_time"] * view.speed, view.stroke)
        near, far = stretch / SMALL, stretch / SMALL**2
        springs = [{**numbers, "travel": travel} for travel in (near, far)]
        stiffer, straight = view.respond(run, "stiffening_maxwell", springs)
        return np.atleast_2d(stiffer - straight) / (1.0 / near - 1.0 / far)

    def extend(self, text: str, inverse: float) -> str:
        """The network with a spring that stiffens; its branch has to be one with a spring."""
        travel = float(np.clip(1.0 / max(inverse, 1.0 / TRAVELS[1]), *TRAVELS))
        text = set_entry(text, self.branch.name, "travel", f"{{start: {pretty(travel, UNITS['travel'], 6)}}}")
        return set_entry(text, self.branch.name, "element", "stiffening_maxwell")


def _is_sprung(branch: Branch, slowest: float) -> bool:
    """Whether a branch is a linear spring and a dashpot that relax faster than ``slowest`` in s."""
    return branch.element.word == "maxwell" and branch.values["relaxation_time"].number < slowest


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


def _stiffening(damping: float, speed: float) -> _Dashpot:
    """On a spring that is blocked where a linear one would be at a ``speed``."""

    def values(k: float) -> Numbers:
        return {"stiffness": k, "relaxation_time": damping / k, "travel": damping / k * speed}

    return _Dashpot("stiffening_maxwell", values, damping)


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
