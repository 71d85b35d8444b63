"""The settings and further channels of runs on which a parameter may depend."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import View
from dashpot.text.inserting import plain_or_quoted
from dashpot.text.quantity import base_unit_of, in_unit
from dashpot_causes.session import ORDER, is_condition, order_of

Array = NDArray[np.float64]

# what says how the specimen was moved, and not in which state it was
OF_THE_MOTION = {"amplitude", "preload", "start", "stop", "frequency", "warm_up", "added_mass"}
# units of channels that answer to the test, as a second load cell does: no state of the specimen either
MECHANICAL = ("N", "m", "m/s", "m/s^2")
MEAN = "mean of "
DIGITS = 10
MOST_PLACES = 5  # of a table
NEAREST = 0.1  # of how far all of them go: places of a table over a channel


@dataclass(frozen=True)
class Setting:
    """A setting by the name under which runs have it, with its mean over them and how far it goes, all in SI.

    Its value in a run may be one (n,) for each sample, that of a channel. ``unit`` is the one in which runs tell it.
    """

    name: str
    middle: float
    spread: float
    values: Mapping[str, float | Array]
    unit: str = ""

    @classmethod
    def of(cls, name: str, values: Mapping[str, float | Array], unit: str = "") -> Setting:
        """The setting with its values by run."""
        middle = float(f"{np.mean([np.mean(each) for each in values.values()]):.{DIGITS}g}")
        ends = [(np.min(each), np.max(each)) for each in values.values()]
        return cls(name, middle, float(np.max(ends) - np.min(ends)), values, unit)

    @property
    def title(self) -> str:
        """What it is called."""
        return f"the channel {self.name.removeprefix(MEAN)}" if self.of_channel else self.name

    @property
    def of_channel(self) -> bool:
        """Whether it was measured along the runs."""
        return self.name.startswith(MEAN)

    def share(self, run: str) -> float | Array:
        """How far a run, or each of its samples (n,), is from the middle, over the spread."""
        return (self.values[run] - self.middle) / self.spread

    @cached_property
    def places(self) -> tuple[float, ...]:
        """The places of a table over the setting: its values, or where there are many, a few of them.

        At each there is a run: a factor that no run tells could be anything. Each place over a channel that moves
        stands for as many samples, unless it would be as good as the one before.
        """
        if any(np.ndim(each) for each in self.values.values()):
            samples = np.concatenate([np.ravel(each) for each in self.values.values()])
            return _apart(_rounded(np.quantile(samples, (np.arange(MOST_PLACES) + 0.5) / MOST_PLACES)))
        values = sorted(set(_rounded(np.array([*self.values.values()]))))
        if len(values) <= MOST_PLACES:
            return tuple(values)
        return tuple(values[round(at)] for at in np.linspace(0, len(values) - 1, MOST_PLACES))

    def over(self, slope: float) -> str:
        """The dependence as it stands in a file, with a slope to be found."""
        return f"{self._word}, at: {self._told(self.middle)}, slope: {{start: {slope:.{DIGITS}g}}}"

    def rate(self, change: float) -> str:
        """The dependence as an exponential, with a rate to be found: that whose ends differ by a ``change``.

        That is the change from the least to the largest setting, over the number in the middle of them.
        """
        rate = 2.0 * math.asinh(0.5 * change) / self.spread
        return f"{self._word}, at: {self._told(self.middle)}, rate: {{start: {rate:.{DIGITS}g}}}"

    def table(self, factors: Sequence[float], reference: int) -> str:
        """The dependence as a table, with factors to be found at all places but one."""
        texts = ["1" if k == reference else f"{{start: {factor:.5g}}}" for k, factor in enumerate(factors)]
        at = ", ".join(map(self._told, self.places))
        return f"{self._word}, at: [{at}], factor: [{', '.join(texts)}]"

    def _told(self, value: float) -> str:
        return in_unit(value, self.unit, DIGITS)

    @property
    def _word(self) -> str:
        kind = "channel" if self.of_channel else "setting"
        return f"{kind}: {plain_or_quoted(self.name.removeprefix(MEAN))}"


def _rounded(values: Array) -> list[float]:
    return [float(f"{value:.{DIGITS}g}") for value in values]


def _apart(places: Sequence[float]) -> tuple[float, ...]:
    """Growing places without those that are hardly farther than the last one that stays."""
    kept = list(places[:1])
    for place in places[1:]:
        if place - kept[-1] > NEAREST * (places[-1] - places[0]):
            kept.append(place)
    return tuple(kept)


def settings_of(view: View) -> Iterator[Setting]:
    """All of them that are others in some runs, or within runs."""
    found = {run: view.settings(run) for run in view.runs}
    common = set.intersection(*(set(each) for each in found.values())) if found else set()
    for name in sorted(filter(is_condition, common - OF_THE_MOTION)):
        if _answers(name, view.unit_of(name)) or (name == "speed" and _moves_so(view, found)):
            continue
        values = {run: _value(view, run, name, each[name]) for run, each in found.items()}
        setting = Setting.of(name, values, view.unit_of(name))
        if setting.spread > 1e-9 * abs(setting.middle):
            yield setting


def session_of(view: View) -> Setting | None:
    """The order in which the runs were made, as a setting; none where other conditions foretell it."""
    places = order_of(view)
    return Setting.of(ORDER, {run: view.settings(run)[ORDER] for run in places}) if places else None


def _value(view: View, run: str, name: str, number: float) -> float | Array:
    """That of a setting in a run; the samples of a channel that moves."""
    signal = view.channels(run).get(name.removeprefix(MEAN)) if name.startswith(MEAN) else None
    return number if signal is None or not np.ptp(signal) else signal


def _answers(name: str, unit: str) -> bool:
    """Whether a channel in a ``unit`` is another force or motion of the specimen."""
    mechanical = {base_unit_of(f"1 {known}") for known in MECHANICAL}
    return name.startswith(MEAN) and bool(unit) and base_unit_of(f"1 {unit}") in mechanical


def _moves_so(view: View, settings: Mapping[str, Mapping[str, float]]) -> bool:
    """Whether the speed of each run is that of its motion, to a factor of two; a rolling tire has another one."""
    largest = {run: float(np.max(np.abs(view.velocity(run)))) for run in settings}
    return all(0.5 * largest[run] <= abs(each["speed"]) <= 2.0 * largest[run] for run, each in settings.items())
