"""Numbers that all specimens have in common."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from dashpot.campaign.declaration import Job
from dashpot.campaign.job import Outcome
from dashpot.campaign.numbers import models_of, numbers_of
from dashpot.fit.study.patterns import chosen

NORMAL = 1.959964


@dataclass(frozen=True)
class Shared:
    """The parameters in common, SI by path, with 95 % ``intervals``; ``specimens`` are those that they come from.

    ``probability`` is how often chance alone would make the specimens differ in them as much as they do.
    """

    values: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    probability: float
    specimens: tuple[str, ...]


def pooled(model: str, patterns: Sequence[str], outcomes: Mapping[Job, Outcome]) -> Shared | None:
    """The values of the parameters of a model that patterns name, from the fits of all specimens together.

    It is the generalised least squares estimate from the parameters of each specimen and their covariance: that of a
    fit of all runs at once where the losses are quadratic. The probability is that of Cochran's Q. None where
    the patterns name no number of the model.

    Source: Hedges and Olkin, Statistical methods for meta-analysis (1985), chapter 6.
    """
    from scipy.special import chdtrc

    fits = models_of(outcomes, model)
    numbers = numbers_of(fits)
    places = [k for k, path in enumerate(numbers.paths) if chosen(path, patterns)]
    if not places or not fits:
        return None
    at, known = numbers.at[:, places], np.linalg.inv(numbers.errors[:, places][:, :, places])
    covariance = np.linalg.inv(known.sum(axis=0))
    middle = covariance @ np.einsum("njk,nk->j", known, at)
    statistic = float(np.einsum("nj,njk,nk->", at - middle, known, at - middle))
    widths = NORMAL * np.sqrt(covariance.diagonal())
    paths = [numbers.paths[k] for k in places]
    value = {path: (k, middle[j], widths[j]) for j, (k, path) in enumerate(zip(places, paths, strict=True))}
    return Shared(
        {path: numbers.value(k, center) for path, (k, center, _) in value.items()},
        {
            path: (numbers.value(k, center - width), numbers.value(k, center + width))
            for path, (k, center, width) in value.items()
        },
        float(chdtrc((len(fits) - 1) * len(places), statistic)) if len(fits) > 1 else 1.0,
        tuple(fits),
    )
