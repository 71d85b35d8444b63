"""Parameters of the network that are others under other settings, or that follow a measured channel along a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from weakref import ref

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, free_name
from dashpot.kernel.following import moved
from dashpot.kernel.settings import with_settings
from dashpot.model.network import Branch, NetworkSpec, Value
from dashpot.model.patch import add_branch, make_dependent
from dashpot.text.inserting import plain_or_quoted
from dashpot.text.problem import InputError
from dashpot.text.quantity import base_unit_of, in_unit
from dashpot_causes.factors import at_all_places, factors_of
from dashpot_causes.session import is_condition

Array = NDArray[np.float64]
# what says how the specimen was moved, and not in which state it was
OF_THE_MOTION = {"amplitude", "preload", "start", "stop", "frequency", "warm_up", "added_mass"}
# kinds of channels that answer to the test, as a second load cell does: no state of the specimen either
MECHANICAL = {base_unit_of(f"1 {unit}") for unit in ("N", "m", "m/s", "m/s^2")}
MEAN = "mean of "
NUDGE = 1e-3
DIGITS = 10
MOST_PLACES = 5  # of a table
NEAREST = 0.1  # of how far all of them go: places of a table over a channel
RUNS_KEPT = 2  # all forms ask for the same changes of a run, one after the other; runs may be seen at once


class SettingDependence(Cause):
    """A parameter of the network, or a force of its own, follows pressure, current, temperature or another setting."""

    word = "setting_dependence"
    kind = "specimen"
    about = "dependence on a setting or on a measured channel"
    shows = (
        "the residual depends on the setting: alike in runs of one setting, opposite in those of another; or it goes "
        "along with the channel"
    )
    changes_numbers = True
    confused_with = {
        "gain": "the same setting once more: a gain of single runs does not come back with it",
        "drift": "settings in another order: drift follows the clock",
        "offset": "the same setting once more: a zero that was lost does not come back with it",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Each parameter of each branch along a straight line over each setting, or with a factor at each of its
        values; a stiffness over it, where the spring has a curve; and a force.
        """
        settings = list(_settings(view))
        numbers = list(numbers_of(network)) if settings else []
        for setting in settings:
            if numbers:
                yield changed(setting, numbers)
            if len(setting.places) > 2:
                yield from (tabulated(setting, number) for number in numbers)
            if has_curved_spring(network):
                yield stiffness_over(setting)
            yield _force(setting)


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


class Changes:
    """What the numbers of a branch with ``keys`` do to the force, as kept for the last runs of a view."""

    def __init__(self, network: NetworkSpec, branch: Branch) -> None:
        self._network, self._branch = network, branch
        self._values = {**{key: curve.values[0] for key, curve in branch.curves.items()}, **branch.values}
        self.keys = [key for key, value in self._values.items() if self._may_depend(key, value)]
        self._view: Callable[[], View | None] = lambda: None
        self._kept: dict[str, Mapping[str, Array]] = {}

    def numbers(self) -> Iterator[Number]:
        """Each of them."""
        return (Number(self._branch, key, self._values[key], self) for key in self.keys)

    def column(self, view: View, run: str, key: str, share: float | Array) -> Array:
        """The change of the force (n,) with a number, when it changes by a ``share`` (n,) of the size at which a
        dependence is told.
        """
        memory = bool(self._branch.element.declares.states)
        if (memory and np.ndim(share)) or any(np.ndim(number) for number in self._along(view, run).values()):
            return self._moved(view, run, key, share)
        return share * self._whole(view, run)[key]

    def _moved(self, view: View, run: str, key: str, share: float | Array) -> Array:
        """The derivative of the force where numbers move along the run: a memory knows how they have moved."""
        known, value = self._along(view, run), self._values[key]
        ways = (side * NUDGE * abs(value.number) * share for side in (-1.0, 1.0))
        ends = [np.clip(known[key] + way, *value.sensible) for way in ways]
        less, more = view.respond(run, self._branch.element.word, [{**known, key: end} for end in ends])
        return (more - less) / (2.0 * NUDGE) * np.sign(value.number)

    def _along(self, view: View, run: str) -> dict[str, float | Array]:
        """All numbers of the branch, as they are in a run or, where they follow a channel, at each sample (n,)."""
        found: dict[str, float | Array] = dict(self._in(view.settings(run)))
        channels = view.channels(run)
        for key, value in self._values.items():
            if value.over and value.over.channel and value.over.word in channels:
                numbers = [each.number for each in value.over.numbers]
                found[key] = moved(value.over, value.number, numbers, channels[value.over.word], value.sensible)
        return found

    def _whole(self, view: View, run: str) -> Mapping[str, Array]:
        """The change of the force (n,) with each, when it changes by all of the size at which a dependence is told."""
        if self._view() is not view:
            self._view, self._kept = ref(view), {}
        found = self._kept.get(run)
        if found is None:
            found = self._columns(view, run)
            self._kept = dict([*self._kept.items(), (run, found)][-RUNS_KEPT:])
        return found

    def _may_depend(self, key: str, value: Value) -> bool:
        found = value.number and not value.setting
        return bool(found) and (value.over is not None or _stands(self._network, self._branch, key))

    def _columns(self, view: View, run: str) -> Mapping[str, Array]:
        known = self._in(view.settings(run))
        ends = {key: self._ends(key, known[key]) for key in self.keys}
        sets = [{**known, key: end} for key in self.keys for end in ends[key]]
        forces = view.respond(run, self._branch.element.word, sets)
        return {
            key: (more - less) / (ends[key][1] - ends[key][0]) * self._values[key].number
            for key, less, more in zip(self.keys, forces[::2], forces[1::2], strict=True)
        }

    def _ends(self, key: str, number: float) -> list[float]:
        """A little less and more than a number, on the same side of zero."""
        value = self._values[key]
        near = number + NUDGE * (abs(number) or abs(value.number)) * np.array([-1.0, 1.0])
        return np.clip(near, *value.sensible).tolist()

    def _in(self, told: Mapping[str, float]) -> dict[str, float]:
        """All numbers of the branch, as they are in a run with some settings."""
        slots = self._network.slots()
        values = with_settings(self._network, np.array([[slot.value.number for slot in slots]]), told)[0].tolist()
        found = {slot.path: value for slot, value in zip(slots, values, strict=True)}
        return {key: found[f"{self._branch.numbers}.{key}"] for key in self._values}


@dataclass(frozen=True)
class Number:
    """A number of a branch."""

    branch: Branch
    key: str
    value: Value
    changes: Changes

    @property
    def path(self) -> str:
        """Where it stands in the network."""
        return f"{self.branch.name}.{self.key}"

    def column(self, view: View, run: str, share: float | Array = 1.0) -> Array:
        """The change of the force (n,) when the number changes by a ``share`` (n,) of the size at which its dependence
        is told.
        """
        return self.changes.column(view, run, self.key, share)


def _settings(view: View) -> Iterator[Setting]:
    found = {run: view.settings(run) for run in view.runs}
    common = set.intersection(*(set(each) for each in found.values())) if found else set()
    for name in sorted(filter(is_condition, common - OF_THE_MOTION)):
        if _answers(name, view.unit_of(name)) or (name == "speed" and _moves_so(view, found)):
            continue
        values = {run: _value(view, run, name, each[name]) for run, each in found.items()}
        setting = Setting.of(name, values, view.unit_of(name))
        if setting.spread > 1e-9 * abs(setting.middle):
            yield setting


def _value(view: View, run: str, name: str, number: float) -> float | Array:
    """That of a setting in a run; the samples of a channel that moves."""
    signal = view.channels(run).get(name.removeprefix(MEAN)) if name.startswith(MEAN) else None
    return number if signal is None or not np.ptp(signal) else signal


def _answers(name: str, unit: str) -> bool:
    """Whether a channel in a ``unit`` is another force or motion of the specimen."""
    return name.startswith(MEAN) and bool(unit) and base_unit_of(f"1 {unit}") in MECHANICAL


def _moves_so(view: View, settings: Mapping[str, Mapping[str, float]]) -> bool:
    """Whether the speed of each run is that of its motion, to a factor of two; a rolling tire has another one."""
    largest = {run: float(np.max(np.abs(view.velocity(run)))) for run in settings}
    return all(0.5 * largest[run] <= abs(each["speed"]) <= 2.0 * largest[run] for run, each in settings.items())


def numbers_of(network: NetworkSpec) -> Iterator[Number]:
    """The parameters of a network with two ends that may be written as dependent on a setting.

    One that depends on another may be written so in place of that.
    """
    if network.document is None or network.joints:
        return
    for branch in network.leaves():
        if not branch.scale and all(curve.form == "constant" for curve in branch.curves.values()):
            yield from Changes(network, branch).numbers()


def _stands(network: NetworkSpec, branch: Branch, key: str) -> bool:
    try:
        make_dependent(network.text, branch.name, key, "setting: s, at: 0, slope: 0")
    except InputError:
        return False
    return True


def changed(setting: Setting, numbers: Sequence[Number]) -> Suspect:
    """One or two of the parameters along a straight line over the setting."""

    def columns(view: View, run: str) -> Array:
        return np.array([number.column(view, run, setting.share(run)) for number in numbers])

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        for strength, place in atoms:
            number = numbers[int(place)]
            slope = strength * number.value.number / setting.spread
            text = make_dependent(text, number.branch.name, number.key, setting.over(slope))
        return text

    grid = tuple(map(float, range(len(numbers))))
    return Suspect(
        f"a number over {setting.title}",
        grid,
        columns,
        extend,
        sign=0,
        unknowns=0,
        most=2,
        quantity="change over the settings",
        unit="1",
        of=tuple(f"{number.path} over {setting.title}" for number in numbers),
    )


def tabulated(setting: Setting, number: Number) -> Suspect:
    """A parameter with a factor at each place of a table over the setting."""
    places = setting.places

    def columns(view: View, run: str) -> Array:
        shares = (np.interp(setting.values[run], places, one) for one in np.eye(len(places)))
        return np.array([number.column(view, run, share) for share in shares])

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        factors, reference = factors_of([strength for strength, _ in at_all_places(places, atoms)])
        return make_dependent(text, number.branch.name, number.key, setting.table(factors.tolist(), reference))

    return Suspect(
        f"{number.path} in a table over {setting.title}",
        places,
        columns,
        extend,
        joint=True,
        sign=0,
        unknowns=0,
        quantity="change of the factor",
        unit="1",
        of=(f"{number.path} over {setting.title}",) * len(places),
    )


def has_curved_spring(network: NetworkSpec) -> bool:
    """Whether a spring of a network with two ends has a curve, none of whose numbers may depend on a setting."""
    return not network.joints and any(
        curve.form != "constant" and curve.curve.over[1] == "m"
        for branch in network.leaves()
        for curve in branch.curves.values()
    )


def stiffness_over(setting: Setting) -> Suspect:
    """A stiffness beside the network that rises or falls along a straight line over the setting."""

    def columns(view: View, run: str) -> Array:
        return setting.share(run) * view.displacement(run)[None]

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        entry = f"stiffness: {{fixed: 0 N/m, over: {{{setting.over(atoms[0][0] / setting.spread)}}}}}"
        name = free_name(text, "setting_stiffness")
        return add_branch(text, f"{name}:\n  element: signed_spring\n  {entry}")

    return Suspect(
        f"a stiffness over {setting.title}",
        (0.0,),
        columns,
        extend,
        sign=0,
        unknowns=0,
        quantity="change over the settings",
        unit="N/m",
        of=(f"stiffness over {setting.title}",),
    )


def _force(setting: Setting) -> Suspect:
    def columns(view: View, run: str) -> Array:
        return np.ones((1, view.displacement(run).size)) * setting.share(run)

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        slope = atoms[0][0] / setting.spread
        entry = f"force: {{fixed: 0 N, over: {{{setting.over(slope)}}}}}"
        return add_branch(text, f"{free_name(text, 'setting_force')}:\n  element: constant_force\n  {entry}")

    return Suspect(
        f"a force over {setting.title}",
        (0.0,),
        columns,
        extend,
        sign=0,
        unknowns=0,
        quantity="change over the settings",
        unit="N",
        of=(f"force over {setting.title}",),
    )
