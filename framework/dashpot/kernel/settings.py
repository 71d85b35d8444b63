"""Parameters of a network that a run gives by its settings, or that depend on them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.data.excitation import ORDER
from dashpot.data.history import MOVED, NOTHING, name_of, runs_before
from dashpot.kernel.following import follows, keys_of, moved, told_to
from dashpot.model.network import NetworkSpec, Over, Slot, Value
from dashpot.text.problem import InputError, Place, Problem

Array = NDArray[np.float64]


def with_settings(spec: NetworkSpec, lanes: Array, settings: Mapping[str, float]) -> Array:
    """The lanes (lanes, slots) with the parameters that the run gives, and with those that depend on its settings.

    A number over a channel has its value at the mean. One over a setting that is not there stays what it is at the
    place where it is told.
    """
    return _with_settings(spec, lanes, settings, lambda slot: True)


def with_constants(spec: NetworkSpec, lanes: Array, settings: Mapping[str, float]) -> Array:
    """The same, but numbers that follow a channel along the run stay as they are: the laws move them."""
    return _with_settings(spec, lanes, settings, lambda slot: not follows(slot, spec))


def with_channel(spec: NetworkSpec, lanes: Array, settings: Mapping[str, float]) -> Array:
    """The same, but only the numbers of the force channel are those of the run."""
    return _with_settings(spec, lanes, settings, lambda slot: slot.path.startswith("measurement."))


def _with_settings(
    spec: NetworkSpec, lanes: Array, settings: Mapping[str, float], counts: Callable[[Slot], bool]
) -> Array:
    own = lanes
    for number, slot in spec.told_by_runs:
        over = slot.value.over
        if slot.value.setting in settings:
            found: Array | float = settings[slot.value.setting]
        elif over and told_to(over, settings) is not None and counts(slot):
            # the parameters of a dependence stand behind the number that depends
            inner = lanes[:, number + 1 : number + 1 + len(over.numbers)]
            found = _at(over, lanes[:, number], inner, settings, slot.value.sensible)
        else:
            continue
        own = lanes.copy() if own is lanes else own
        own[:, number] = found
    return own


def used_settings(spec: NetworkSpec, settings: Mapping[str, float], run: str = "") -> dict[str, float]:
    """What a network needs of the settings of a run. Raises InputError for one on which a number depends and that is
    not there.
    """
    problems = list(_missing(spec, settings, run))
    if problems:
        raise InputError(problems)
    needed = {key for slot in spec.slots() for key in _needed(slot.value, settings)}
    return {key: value for key, value in settings.items() if key in needed}


def _needed(value: Value, settings: Mapping[str, float]) -> Iterator[str]:
    yield value.setting
    if over := value.over:
        yield from keys_of(over)
        if over.way == "kept":
            yield from (name_of(over.word, earlier) for earlier in range(len(runs_before(settings, over.word))))


def at_settings(spec: NetworkSpec, settings: Mapping[str, float]) -> NetworkSpec:
    """The network with the parameters that it has at some settings, in SI; they depend on no setting any more.

    Raises InputError for a setting on which a number depends and that is not there, ValueError for one on which none
    depends.
    """
    used, slots = used_settings(spec, settings), spec.slots()
    if unknown := sorted(set(settings) - set(used)):
        raise ValueError(f"no parameter of '{spec.name}' depends on the setting '{unknown[0]}'")
    numbers = with_settings(spec, np.array([[slot.value.number for slot in slots]]), used)[0]
    frozen = {
        slot.path: replace(slot.value, number=number, over=None, setting="", interval=None)
        for slot, number in zip(slots, numbers.tolist(), strict=True)
        if slot.value.over or slot.value.setting in used
    }
    told = ", ".join(f"{key} {value:.6g}" for key, value in used.items())
    record = {**spec.identified.record, **({"at": f"{told} in SI"} if used else {})}
    return replace(spec.with_values(frozen), identified=replace(spec.identified, record=record))


def require_settings(spec: NetworkSpec, runs: Mapping[str, Mapping[str, float]]) -> None:
    """Raise InputError for all runs, by name, that lack a setting or a channel on which a number depends."""
    problems = [problem for run, settings in runs.items() for problem in _missing(spec, settings, run)]
    if problems:
        raise InputError(problems)


def _missing(spec: NetworkSpec, settings: Mapping[str, float], run: str) -> Iterator[Problem]:
    # outside of a dataset, on a rig or in another program, nothing is first or last, and nothing was before
    told = {ORDER, *NOTHING}
    for slot in spec.slots():
        over = slot.value.over
        if over and over.way == "kept" and (over.channel or over.word != MOVED):
            yield _not_of_the_runs_before(slot, over)
        elif over and told.isdisjoint(keys_of(over)) and settings.keys().isdisjoint(keys_of(over)):
            told.add(keys_of(over)[0])
            yield _problem(slot, over, run)


def _not_of_the_runs_before(slot: Slot, over: Over) -> Problem:
    return Problem(
        slot.value.node.place if slot.value.node else Place(),
        f"'{slot.path}' over '{over.word}': expected a setting that adds up over the runs before",
        f"write '{MOVED}', or 'slope' in place of 'kept'",
    )


def _problem(slot: Slot, over: Over, run: str) -> Problem:
    what, how = ("channel", "channels") if over.channel else ("setting", "settings")
    place = slot.value.node.place if slot.value.node else Place()
    if not run:
        how = f"`--at {over.word}=VALUE` of `dashpot export`, `{over.word}=...` in `jit` and `dynamic_stiffness`"
        return Problem(
            place, f"'{slot.path}' depends on the {what} '{over.word}', which is not given", f"give it: {how}"
        )
    which = f"run '{run}'"
    return Problem(
        place,
        f"'{slot.path}' depends on the {what} '{over.word}', which {which} does not have",
        f"add '{over.word}' to the {how} of the run in the dataset file, or leave the run out",
    )


def _at(over: Over, base: Array, numbers: Array, settings: Mapping[str, float], sensible: tuple[float, float]) -> Array:
    """The number (lanes,) at the settings of a run."""
    if over.way == "kept":
        before = np.array(runs_before(settings, over.word))
        return np.clip(base + numbers ** np.arange(before.size) @ before, *sensible)
    return np.asarray(moved(over, base, list(numbers.T), told_to(over, settings), sensible))
