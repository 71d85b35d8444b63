"""What is asked of the diagnoses of measured sets, as facts about their outcomes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from itertools import groupby
from typing import Any

from real.trial import Outcome

ALIKE = 1e-6  # of the RMSE
NEAR = 1.1  # times the explainable error
ADMITS = ("unexplained", "partly_explained")
# what the shipped bases do of themselves, as the causes are called
OWN = {
    "kelvin_voigt": {"viscous_damping", "stiffness_curve"},
    "tire_model_1": {"viscous_damping", "stiffness_curve", "relaxation", "amplitude_softening", "friction"},
}
OF_BASES = frozenset().union(*OWN.values())


def unlike(outcome: Outcome) -> dict[str, tuple[float, float | None]]:
    """The errors that were told and are not those of the files, each with what the files say."""
    return {
        name: (told, outcome.files.get(name))
        for name, told in outcome.told.items()
        if name not in outcome.files or abs(told - outcome.files[name]) > ALIKE * told
    }


def accused(outcome: Outcome, known: Iterable[str] = ()) -> list[str]:
    """The faults of the measurement that are in the files, however sure, and that their owners do not know of."""
    told = [*outcome.causes, *outcome.resembled]
    named = [cause["cause"] for cause in told if cause["class"] == "measurement"]
    return [word for word in [*named, *(fault["kind"] for fault in outcome.faults)] if word not in known]


def names(outcome: Outcome) -> frozenset[str]:
    """What the specimen was said to do: the accepted causes, of a dependence what something depends on.

    What depends on it is told by branches, of which several may be the same law, numbered as they were found.
    """
    told = [cause for cause in outcome.causes if cause["class"] == "specimen"]
    return frozenset(_name(cause) for cause in told if cause["standing"] == "accepted")


def _name(cause: Mapping[str, Any]) -> str:
    if cause["cause"] != "setting_dependence":
        return str(cause["cause"])
    return f"dependence on {cause['title'].rpartition(' on ')[2]}"


def near(outcome: Outcome) -> bool:
    """Whether the error of the written file on held-out runs comes near what a general model explains there."""
    error = outcome.files.get("after.held_out")
    return error is not None and outcome.explainable is not None and error <= NEAR * outcome.explainable


def admitted(outcome: Outcome) -> bool:
    """Whether the verdict says that something is still missing."""
    return outcome.verdict in ADMITS


def near_or_admitted(outcome: Outcome) -> bool:
    """Whether the written file comes near what a general model explains, or the verdict says that it does not."""
    return near(outcome) or admitted(outcome)


def naming(outcomes: Iterable[Outcome]) -> list[Outcome]:
    """The outcomes of those sets and bases of which some repetition names something."""
    found = list(outcomes)
    places = {(one.set, one.base) for one in found if names(one)}
    return [one for one in found if (one.set, one.base) in places]


def naming_beyond_bases(outcomes: Iterable[Outcome]) -> list[Outcome]:
    """The outcomes of those sets of which some repetition names what no base does of itself."""
    found = list(outcomes)
    places = {one.set for one in found if names(one) - OF_BASES}
    return [one for one in found if one.set in places]


def same_names(outcomes: Iterable[Outcome]) -> dict[tuple[str, str], tuple[int, int]]:
    """By set and base, how many of the repetitions name what most of them name, and how many there are.

    A single diagnosis repeats nothing and is left out.
    """
    key = lambda one: (one.set, one.base)  # noqa: E731
    found = {}
    for place, group in groupby(sorted(outcomes, key=key), key):
        said = [None if one.verdict == "failed" else names(one) for one in group]
        counts = Counter(one for one in said if one is not None)
        if len(said) > 1:
            found[place] = (max(counts.values(), default=0), len(said))
    return found


def same_beyond_bases(outcomes: Iterable[Outcome]) -> dict[str, tuple[int, int]]:
    """By set, how many repetitions from all bases agree in what no base does of itself, and how many there are."""
    key = lambda one: one.set  # noqa: E731
    found = {}
    for place, group in groupby(sorted(outcomes, key=key), key):
        said = [None if one.verdict == "failed" else names(one) - OF_BASES for one in group]
        counts = Counter(one for one in said if one is not None)
        found[place] = (max(counts.values(), default=0), len(said))
    return found


def share(counts: Mapping[object, tuple[int, int]]) -> float:
    """How many of all, as a share."""
    return sum(some for some, _ in counts.values()) / max(sum(most for _, most in counts.values()), 1)
