"""The parameters of one model over all specimens, in the coordinates in which they are compared."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.campaign.declaration import CampaignSpec, Job, Measured
from dashpot.campaign.job import Outcome

Array = NDArray[np.float64]

RMSE = "rmse"
APART = 1e-6  # of a variance, so that numbers that a fit cannot tell apart have a covariance that can be inverted
RMSE_ERROR = 0.01  # of an error of a model, relative
MOST_WORDS = 3  # specimens for each word of a property, at least, for a dependence on it
DECIDED = 1e-9  # of the largest singular value of the properties, scaled alike


@dataclass(frozen=True, eq=False)
class Numbers:
    """What n specimens have for p numbers: ``at`` (n, p), logarithms where ``log`` (p,) says so, in SI.

    ``errors`` (n, p, p) are the covariances of their errors. ``design`` (n, q) says what the mean of each specimen
    depends on: a one, then the ``effects`` of its properties, counted from their means.
    """

    specimens: tuple[str, ...]
    paths: tuple[str, ...]
    units: tuple[str, ...]
    log: NDArray[np.bool_]
    at: Array
    errors: Array
    design: Array
    effects: tuple[str, ...] = ()

    def value(self, which: int, at: float) -> float:
        """The number in SI at a coordinate."""
        return float(np.exp(at) if self.log[which] else at)


def models_of(outcomes: Mapping[Job, Outcome], model: str) -> dict[str, Outcome]:
    """Specimen -> what the first of its jobs found for a model with all its numbers free."""
    found: dict[str, Outcome] = {}
    for job, outcome in outcomes.items():
        for each in outcome["models"]:
            if each["name"] == model and not job.held:
                found.setdefault(job.specimen, each)
    return found


def numbers_of(fits: Mapping[str, Outcome]) -> Numbers:
    """The parameters that all specimens have, without dependence on anything."""
    every = [set(fit["numbers"]) for fit in fits.values()]
    first: Outcome = next(iter(fits.values()), {"numbers": {}})
    paths = tuple(path for path in first["numbers"] if all(path in known for known in every))
    log = np.array([first["numbers"][path]["log"] for path in paths], dtype=bool)
    values = np.array([[fit["numbers"][path]["value"] for path in paths] for fit in fits.values()])
    values = values.reshape(len(fits), len(paths))
    at = np.where(log, np.log(np.where(log, values, 1.0)), values)
    errors = np.array([_covariance(fit, paths) for fit in fits.values()]).reshape(len(fits), len(paths), len(paths))
    units = tuple(first["numbers"][path]["unit"] for path in paths)
    return Numbers(tuple(fits), paths, units, log, at, errors, np.ones((len(fits), 1)))


def errors_of_model(fits: Mapping[str, Outcome]) -> Numbers:
    """The error of the model on each specimen, as a number like the others."""
    at = np.log([[max(fit["rmse"]["train"], 1e-300)] for fit in fits.values()])
    errors = np.full((len(fits), 1, 1), RMSE_ERROR**2)
    return Numbers(tuple(fits), (RMSE,), ("N",), np.array([True]), at, errors, np.ones((len(fits), 1)))


def depending(numbers: Numbers, campaign: CampaignSpec) -> tuple[Numbers, list[str]]:
    """The same with means that depend on the properties the campaign asks for; why on some they cannot."""
    rows = {one.name: one for one in campaign.specimens}
    chosen = [rows[name] for name in numbers.specimens]
    columns, effects, remarks = [np.ones(len(chosen))], [], []
    for name in campaign.dependence:
        found, reason = _columns(name, chosen)
        for effect, column in found.items():
            if _adds(columns, column):
                columns.append(column)
                effects.append(effect)
            else:
                reason = f"the effect of '{effect}' is collinear with the properties before it"
        remarks += [reason] if reason else []
    if len(columns) + 2 > len(chosen):
        return numbers, [f"{len(chosen)} specimens are too few for the effects of {', '.join(effects)}"] * bool(effects)
    return replace(numbers, design=np.column_stack(columns), effects=tuple(effects)), remarks


def _columns(name: str, chosen: Sequence[Measured]) -> tuple[dict[str, Array], str]:
    values = [one.properties.get(name) for one in chosen]
    if any(value is None for value in values):
        return {}, f"'{name}' is not known of every specimen, so that nothing depends on it"
    if all(isinstance(value, float) for value in values):
        column = np.array(values, dtype=float)
        same = np.ptp(column) == 0.0
        return ({}, f"'{name}' is the same for all specimens") if same else ({name: column - column.mean()}, "")
    words = sorted({str(value) for value in values})
    if len(words) == 1 or MOST_WORDS * len(words) > len(chosen):
        return {}, f"'{name}' has {len(words)} words for {len(chosen)} specimens, so that nothing depends on it"
    shares = {word: np.array([float(str(value) == word) for value in values]) for word in words}
    return {f"{name}: {word} against {words[0]}": shares[word] - shares[word].mean() for word in words[1:]}, ""


def _adds(columns: Sequence[Array], column: Array) -> bool:
    block = np.column_stack([each / np.linalg.norm(each) for each in (*columns, column)])
    singular = np.linalg.svd(block, compute_uv=False)
    return len(block) >= block.shape[1] and bool(singular[-1] > DECIDED * singular[0])


def _covariance(fit: Outcome, paths: Sequence[str]) -> Array:
    order = list(fit["numbers"])
    errors = np.array([fit["numbers"][path]["error"] for path in paths])
    places = [order.index(path) for path in paths]
    correlation = np.array(fit["correlation"] or np.eye(len(order))).reshape(len(order), len(order))
    return (correlation[np.ix_(places, places)] + APART * np.eye(len(paths))) * np.outer(errors, errors)
