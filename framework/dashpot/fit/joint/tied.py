"""The coordinates of several specimens, those that are shared once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.expr.node import symbol
from dashpot.fit.coordinates import Coordinates
from dashpot.fit.joint.declaration import Tie
from dashpot.model.derived import Derived, Rule
from dashpot.text.problem import InputError

Array = NDArray[np.float64]

ANYWHERE = (-np.inf, np.inf)


@dataclass(frozen=True, eq=False)
class Common:
    """Coordinates (p,) over the slots of all specimens; ``places`` are those of the coordinates of each specimen."""

    coordinates: Coordinates
    places: Mapping[str, NDArray[np.int64]]


def common_coordinates(own: Mapping[str, Coordinates], ties: Sequence[Tie], errors: Mapping[str, Array]) -> Common:
    """The coordinates of all specimens by name, shared ones once, with the starts of ``own``.

    A shared number starts at the mean over the specimens, weighed by the squared standard ``errors`` (p,) of each in
    natural steps. Raises InputError where the bounds of a shared number leave nothing in common.
    """
    leaders = {(name, path): _leader(tie) for tie in ties for name, path in tie.paths.items()}
    index: dict[tuple[str, str], int] = {}
    places: dict[str, list[int]] = {name: [] for name in own}
    for name, coordinates in own.items():
        for path in coordinates.paths:
            leader = leaders.get((name, path), (name, path))
            places[name].append(index.setdefault(leader, len(index)))
    titles = {_leader(tie): tie.title for tie in ties}
    found = _stacked(own, places, [titles.get(key, f"{key[0]}: {key[1]}") for key in index])
    found = _between(found, own, places, ties)
    ruled = replace(found, derived=Derived(tuple(_rules(own, leaders))))
    start = _starts(own, places, errors, ruled)
    base = ruled.to_values(start)[0]
    return Common(replace(ruled, base=base), {name: np.array(each, dtype=np.int64) for name, each in places.items()})


def _leader(tie: Tie) -> tuple[str, str]:
    return next(iter(tie.paths.items()))


def _offsets(own: Mapping[str, Coordinates]) -> dict[str, int]:
    ends = np.cumsum([0, *(coordinates.base.size for coordinates in own.values())])
    return dict(zip(own, ends[:-1].tolist(), strict=True))


def _stacked(own: Mapping[str, Coordinates], places: Mapping[str, Sequence[int]], paths: Sequence[str]) -> Coordinates:
    """All coordinates, each as the first specimen has it."""
    size, offsets = len(paths), _offsets(own)
    which, log = np.zeros(size, dtype=np.int64), np.zeros(size, dtype=bool)
    low, high, unit = np.zeros((3, size))
    rising: dict[tuple[int, ...], None] = {}
    for name in reversed(list(own)):
        each, at = own[name], list(places[name])
        which[at], log[at] = each.which + offsets[name], each.log
        low[at], high[at], unit[at] = each.low, each.high, each.unit
        rising |= {tuple(at[knot] for knot in knots): None for knots in each.rising}
    base = np.concatenate([each.base for each in own.values()])
    return Coordinates(tuple(paths), which, log, low, high, unit, base, tuple(rising))


def _between(
    found: Coordinates, own: Mapping[str, Coordinates], places: Mapping[str, Sequence[int]], ties: Sequence[Tie]
) -> Coordinates:
    """The coordinates with bounds that all specimens keep."""
    low, high = found.low.copy(), found.high.copy()
    for name, each in own.items():
        at = list(places[name])
        low[at], high[at] = np.maximum(low[at], each.low), np.minimum(high[at], each.high)
    for tie in ties:
        k = found.paths.index(tie.title)
        if not low[k] < high[k]:
            raise InputError.at(
                tie.place,
                f"the bounds of {tie.title} have nothing in common in these specimens",
                "widen the bounds in the network files",
            )
    return replace(found, low=low, high=high)


def _rules(own: Mapping[str, Coordinates], leaders: Mapping[tuple[str, str], tuple[str, str]]) -> list[Rule]:
    """Shared numbers follow from that of the first specimen; then come the expressions of each network."""
    offsets = _offsets(own)
    slots = {
        (name, path): int(slot) + offsets[name]
        for name, each in own.items()
        for path, slot in zip(each.paths, each.which, strict=True)
    }
    tied = [
        Rule(slots[pair], symbol("shared"), {"shared": slots[leader]}, ANYWHERE)
        for pair, leader in leaders.items()
        if pair != leader
    ]
    own_rules = [
        replace(
            rule,
            slot=rule.slot + offsets[name],
            names={word: slot + offsets[name] for word, slot in rule.names.items()},
        )
        for name, each in own.items()
        for rule in each.derived.rules
    ]
    return tied + own_rules


def _starts(
    own: Mapping[str, Coordinates],
    places: Mapping[str, Sequence[int]],
    errors: Mapping[str, Array],
    found: Coordinates,
) -> Array:
    weight, total = np.zeros((2, len(found.paths)))
    for name, each in own.items():
        known = 1.0 / np.maximum(np.where(np.isfinite(errors[name]), errors[name], 1e6), 1e-12) ** 2
        np.add.at(weight, list(places[name]), known)
        np.add.at(total, list(places[name]), known * each.start)
    return np.clip(total / weight, found.low, found.high)
