"""Parameters of the network that are others under other settings, or that follow a measured channel along a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar
from weakref import ref

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, free_name
from dashpot.kernel.following import moved
from dashpot.kernel.settings import with_settings
from dashpot.model.network import Branch, NetworkSpec, Value
from dashpot.model.patch import add_branch, make_dependent
from dashpot.text.problem import InputError
from dashpot_causes.factors import at_all_places, factors_of
from dashpot_causes.settings import Setting, settings_of

Array = NDArray[np.float64]
NUDGE = 1e-3
Made = TypeVar("Made")
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
        """Each parameter of each branch along a straight line or an exponential over each setting, or with a factor at
        each of its values; a stiffness over it, where the spring has a curve; and a force.
        """
        settings = list(settings_of(view))
        numbers = list(numbers_of(network)) if settings else []
        for setting in settings:
            if numbers:
                yield changed(setting, numbers)
            if len(setting.places) > 2:
                if numbers:
                    yield _exponential(setting, numbers)
                yield from (tabulated(setting, number) for number in numbers)
            if has_curved_spring(network):
                yield stiffness_over(setting)
            yield _force(setting)


class Changes:
    """What the numbers of a branch with ``keys`` do to the force."""

    def __init__(self, network: NetworkSpec, branch: Branch) -> None:
        self._network, self._branch = network, branch
        self._values = {**{key: curve.values[0] for key, curve in branch.curves.items()}, **branch.values}
        self.keys = [key for key, value in self._values.items() if self._may_depend(key, value)]
        self._view: Callable[[], View | None] = lambda: None
        self._kept: dict[tuple[str, str], Any] = {}

    def numbers(self) -> Iterator[Number]:
        """Each of them."""
        return (Number(self._branch, key, self._values[key], self) for key in self.keys)

    def column(self, view: View, run: str, key: str, share: float | Array) -> Array:
        """The change of the force (n,) with a number, when it changes by a ``share`` (n,) of the size at which a
        dependence is told.
        """
        memory = bool(self._branch.element.declares.states)
        known = self._of_run(self._along, view, run)
        if (memory and np.ndim(share)) or any(np.ndim(number) for number in known.values()):
            return self._moved(view, run, key, share)
        return share * self._of_run(self._columns, view, run)[key]

    def _moved(self, view: View, run: str, key: str, share: float | Array) -> Array:
        """The derivative of the force where numbers move along the run: a memory knows how they have moved."""
        known, value = self._of_run(self._along, view, run), self._values[key]
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

    def _of_run(self, make: Callable[[View, str], Made], view: View, run: str) -> Made:
        """What is made of a run, as kept for the last ones of a view."""
        if self._view() is not view:
            self._view, self._kept = ref(view), {}
        key = make.__name__, run
        found = self._kept.get(key)
        if found is None:
            found = make(view, run)
            self._kept = dict([*self._kept.items(), (key, found)][-2 * RUNS_KEPT :])
        return found

    def _may_depend(self, key: str, value: Value) -> bool:
        found = value.number and not value.setting
        return bool(found) and (value.over is not None or _stands(self._network, self._branch, key))

    def _columns(self, view: View, run: str) -> Mapping[str, Array]:
        """The change of the force (n,) with each, when it changes by all of the size at which a dependence is told."""
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

    def over(change: float, number: Number) -> str:
        return setting.over(change * number.value.number / setting.spread)

    return _followed(f"a number over {setting.title}", setting, numbers, over)


def _exponential(setting: Setting, numbers: Sequence[Number]) -> Suspect:
    """The same along an exponential, which is the line to first order: what predicts better is known after a refit."""
    form = f"a number over {setting.title}, exponentially"
    return _followed(form, setting, numbers, lambda change, _: setting.rate(change))


def _followed(form: str, setting: Setting, numbers: Sequence[Number], over: Callable[[float, Number], str]) -> Suspect:
    """One or two of the parameters ``over`` a setting, by their change from its least to its largest value."""

    def columns(view: View, run: str) -> Array:
        return np.array([number.column(view, run, setting.share(run)) for number in numbers])

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        for change, place in atoms:
            number = numbers[int(place)]
            text = make_dependent(text, number.branch.name, number.key, over(change, number))
        return text

    grid = tuple(map(float, range(len(numbers))))
    return Suspect(
        form,
        grid,
        columns,
        extend,
        sign=0,
        unknowns=0,
        most=2,
        quantity="change over the settings",
        unit="1",
        of=tuple(f"{number.path} over {setting.title}" for number in numbers),
        dependent=tuple(number.path for number in numbers),
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
        dependent=(number.path,) * len(places),
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
