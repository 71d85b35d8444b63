"""A cause in the engineer's words: its size, how sure it is, what may stand in its place, and whose fault it is."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from dashpot.report.grids import cause_name, cause_title, is_determined, is_likely, size_of
from dashpot.report.readable import listed

Json = Mapping[str, Any]

NOTHING: Mapping[str, str] = MappingProxyType({})
SIDES = {"specimen": "missing in the model", "measurement": "a fault of the measurement"}
PROBABLY = "probably "
RARE = 0.1  # as surely as an accepted cause is at work, with nine in ten, what is less likely than this is not
MOST_BEFORE_OF = 2  # words of a name that a size may follow


def likely_causes(diagnosis: Json) -> list[Json]:
    """The causes that the data support, in their order: the accepted ones, and those that are probable."""
    return [cause for cause in diagnosis["causes"] if is_likely(cause)]


def may_be(cause: Json) -> bool:
    """Whether a term of the written network may be what it is called: else it makes up for something unknown."""
    chance = cause.get("presence", cause.get("probability"))
    return chance is None or bool(chance >= RARE) or is_likely(cause)


def cause_phrase(cause: Json) -> str:
    """The cause with its first parameter: what, how much, how sure; no number that says nothing."""
    parameters = cause.get("parameters") or {}
    branches = {name.rpartition(".")[0] for name in parameters}
    if len(branches) > 1:  # "": the numbers of the first branch that it adds; else it changes numbers that were there
        return f"{cause_title(cause)} in {len(branches)} branches" if "" in branches else cause_title(cause)
    first: Json = next(iter(parameters.values()), {})
    if not first.get("value") or not is_determined(first) or "[" in next(iter(parameters)):
        return cause_title(cause)
    size = size_of(first)
    quantity_name = next(iter(parameters)).rpartition(".")[2].replace("_", " ")
    return " ".join(filter(None, [_with_size(cause_name(cause), quantity_name, size), cause.get("place")]))


def _with_size(name: str, quantity_name: str, size: str) -> str:
    """A short name "of 41 N"; a longer one ends in a word of which this is no size: "damping that fades (time 3 s)"."""
    words = re.sub(r"\(.*\)", "", name.removeprefix("a ").removeprefix("an ")).split()
    if len(words) <= MOST_BEFORE_OF:
        return f"{name} of {size}"
    told = size if quantity_name in words else f"{quantity_name} {size}"
    return f"{name[:-1]}; {told})" if name.endswith(")") else f"{name} ({told})"


def named(causes: Sequence[Json]) -> str:
    """Causes in a sentence, and whether each belongs to the model or to the measurement."""
    groups: dict[str, list[Json]] = {"specimen": [], "": [], "measurement": []}
    for cause in causes:
        groups[_side(cause)].append(cause)
    told = [
        f"{listed([as_sure_as_it_is(cause) for cause in groups[side]])}, {SIDES[side]}"
        if side
        else listed([probably(cause, or_rivals(cause, SIDES)) for cause in groups[side]])
        for side in groups
        if groups[side]
    ]
    return "; and ".join(told)


def _side(cause: Json) -> str:
    """Whether a cause is of the specimen or of the measurement; nothing where that differs from its rivals."""
    mine = "measurement" if cause.get("class") == "measurement" else "specimen"
    sides = _sides(cause)
    rivals = {sides.get(word) for word in cause.get("indistinguishable_from") or ()}
    # what older files do not tell is no fault of the measurement
    return mine if rivals <= ({mine} if mine == "measurement" else {mine, None}) else ""


def _sides(cause: Json) -> dict[str, str | None]:
    return {rival["cause"]: rival["class"] for rival in cause.get("rivals") or ()}


def as_sure_as_it_is(cause: Json) -> str:
    """A cause with its rivals, which have other parameters, and as probable where it is no more than that."""
    return probably(cause, or_rivals(cause) if cause.get("indistinguishable_from") else cause_phrase(cause))


def or_rivals(cause: Json, marks: Mapping[str, str] = NOTHING) -> str:
    """A cause, or what may stand in its place, each with what ``marks`` say of the side that it is on."""
    sides = _sides(cause)
    rivals = [{"cause": word, "class": sides.get(word)} for word in cause.get("indistinguishable_from") or ()]
    told = [(cause_title(each), marks.get(each.get("class") or "")) for each in (cause, *rivals)]
    return (", or " if marks else " or ").join(", ".join(filter(None, texts)) for texts in told)


def probably(cause: Json, words: str) -> str:
    """What is said of a cause, as probable where it is not accepted."""
    return words if cause.get("accepted") else f"{PROBABLY}{words}"
