"""Specimens to be named, with the evidence: unlike the others, badly described, with an effect that the others do not
have, or with a fault of the measurement."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from dashpot.campaign.job import Outcome
from dashpot.campaign.numbers import Numbers
from dashpot.campaign.unlike import BOTH, FORCE, SEVERAL, TRAVEL, Unlike
from dashpot.text.quantity import pretty

NAMED = 0.95  # probability from which a specimen is named
NOTABLE = 3.0  # standard deviations
MOST_NOTABLE = 4
MINORITY = 0.5
KINDS = {
    FORCE: "wrong gain of the force",
    TRAVEL: "wrong gain of the travel",
    BOTH: "wrong gain of the force or the travel",
}
DAMAGED, MISFIT, FAULT = "damaged, or of another make", "damaged or mounted otherwise", "fault of the measurement"


@dataclass(frozen=True)
class Named:
    """A specimen that does not belong to the others: the ``kind`` that is most likely, and what speaks for it."""

    specimen: str
    model: str
    kind: str
    probability: float
    evidence: tuple[str, ...]


def named_by_numbers(model: str, numbers: Numbers, found: Unlike) -> Iterator[Named]:
    """The specimens whose numbers are unlike those of the others."""
    for i, specimen in enumerate(numbers.specimens):
        if found.outside[i] >= NAMED:
            way = found.ways[int(np.argmax(found.probability[i]))]
            kind = KINDS.get(way, DAMAGED)
            yield Named(specimen, model, kind, float(found.outside[i]), tuple(_evidence(numbers, found, i, way)))


def named_by_error(model: str, numbers: Numbers, found: Unlike) -> Iterator[Named]:
    """The specimens that a model describes worse than it describes the others."""
    for i, specimen in enumerate(numbers.specimens):
        if found.outside[i] >= NAMED and found.shifts[i, 0] > 0.0:
            error, ratio = pretty(float(np.exp(numbers.at[i, 0])), "N", 3), float(np.exp(found.shifts[i, 0]))
            told = f"the RMSE of the model is {error}, {ratio:.3g} times that of the others"
            yield Named(specimen, model, MISFIT, float(found.outside[i]), (told,))


def named_by_causes(found: Sequence[Mapping[str, Any]]) -> Iterator[Named]:
    """The specimens with an effect that most of the others do not have; ``found`` as of ``causes_found``.

    What half of the specimens have or more is how they are made, and a matter of the model.
    """
    for row in found:
        sure = row["certain"]
        if row["class"] == "specimen" and len(sure) < MINORITY * len(row["probability"]):
            for specimen, evidence in sure.items():
                place = f" at {row['place']}" if row["place"] else ""
                told = f"{row['title']}{place}, in {len(sure)} of {len(row['probability'])} specimens: {evidence}"
                yield Named(specimen, row["model"], MISFIT, row["probability"][specimen], (told,))


def named_by_faults(remarks: Mapping[str, Sequence[str]], outcomes: Sequence[tuple[str, Outcome]]) -> Iterator[Named]:
    """The specimens whose measurement has a fault: runs corrected or set aside, errors that a diagnosis found."""
    causes: dict[str, dict[str, float]] = {}
    for specimen, outcome in outcomes:
        for cause in outcome.get("causes", ()):
            if cause["class"] == "measurement" and cause["accepted"] and cause["probability"] >= NAMED:
                told = f"{cause['title']}: {cause['evidence']}"
                causes.setdefault(specimen, {})[told] = cause["probability"]
    for specimen in dict.fromkeys([*remarks, *causes]):
        evidence = dict.fromkeys([*remarks.get(specimen, ()), *causes.get(specimen, {})])
        if evidence:
            sure = 1.0 if remarks.get(specimen) else max(causes[specimen].values())
            yield Named(specimen, "", FAULT, sure, tuple(evidence))


def _evidence(numbers: Numbers, found: Unlike, which: int, way: str) -> Iterator[str]:
    if way in KINDS:
        likely = ", ".join(
            f"{other} {found.probability[which][k]:.2g}"
            for k, other in enumerate(found.ways)
            if found.probability[which][k] > 0.05
        )
        yield f"all parameters changed together as with a {KINDS[way]} (probabilities: {likely})"
    order = np.argsort(-np.abs(found.distances[which]))
    far = [k for k in order if abs(found.distances[which, k]) >= NOTABLE][:MOST_NOTABLE] or [order[0]]
    for k in far:
        yield _moved(numbers, int(k), which, float(found.shifts[which, k]), float(found.distances[which, k]))
    if way == SEVERAL and len(far) == 1:
        yield "several parameters together are outside of the population"


def _moved(numbers: Numbers, which: int, specimen: int, shift: float, distance: float) -> str:
    at = numbers.value(which, float(numbers.at[specimen, which]))
    expected = numbers.value(which, float(numbers.at[specimen, which]) - shift)
    unit = numbers.units[which]
    return (
        f"{numbers.paths[which]} is {pretty(at, unit, 3)} where {pretty(expected, unit, 3)} is expected "
        f"({distance:+.2g} standard deviations)"
    )
