"""The specimens of one model as a population, in numbers that can be written down."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.campaign.alike import groups_alike
from dashpot.campaign.charts import control_charts
from dashpot.campaign.declaration import CampaignSpec
from dashpot.campaign.named import NAMED
from dashpot.campaign.numbers import Numbers
from dashpot.campaign.unlike import Unlike, detectable, unlike

FEWEST = 3  # specimens that make a population


@dataclass(frozen=True, eq=False)
class Population:
    """What is told of the specimens together: ``judged`` has means, scatter and who does not belong to it.

    ``groups`` (n,) are those that are alike, 0 for a specimen that belongs to none; ``remarks`` say what cannot be
    told.
    """

    numbers: Numbers
    judged: Unlike
    groups: NDArray[np.int64]
    charts: Sequence[dict[str, Any]]
    remarks: Sequence[str]

    def place_of(self, specimen: str) -> dict[str, Any]:
        """The probability that a specimen is unlike the others, and its group; None where it is not known."""
        which = self.numbers.specimens.index(specimen)
        return {"unlike": float(self.judged.outside[which]), "group": int(self.groups[which]) or None}

    def as_dict(self) -> dict[str, Any]:
        """Means, scatter, correlation, dependences, groups and charts. A number on a logarithmic scale has scatter and
        effects as shares of itself."""
        mixed, numbers = self.judged.population, self.numbers
        size = np.sqrt(mixed.between.diagonal())
        ratio = mixed.between / np.outer(size, size)
        return {
            "specimens": list(numbers.specimens),
            "numbers": [self._number(k) for k in range(len(numbers.paths))],
            "correlation": np.clip(ratio, -1.0, 1.0).tolist(),
            "dependence": [
                self._effect(k, row) for row in range(len(numbers.effects)) for k in range(len(numbers.paths))
            ],
            "tested": self.judged.tested,
            "detectable": self._detectable(),
            "ways": list(self.judged.ways),
            "probability": self.judged.probability.tolist(),
            "groups": self.groups.tolist(),
            "charts": list(self.charts),
            "remarks": list(self.remarks),
        }

    def _detectable(self) -> float | None:
        found = detectable(self.judged, NAMED) if self.judged.tested else np.inf
        return found if np.isfinite(found) else None

    def _number(self, which: int) -> dict[str, Any]:
        mixed, numbers = self.judged.population, self.numbers
        mean, width = mixed.means[0, which], mixed.widths[0, which]
        return {
            "parameter": numbers.paths[which],
            "unit": numbers.units[which],
            "relative": bool(numbers.log[which]),
            "mean": numbers.value(which, mean),
            "interval": [numbers.value(which, mean - width), numbers.value(which, mean + width)],
            "scatter": float(np.sqrt(mixed.between[which, which])),
            "scatter_interval": mixed.scatter[which].tolist(),
            "error": float(np.median(np.sqrt(numbers.errors[:, which, which]))),
        }

    def _effect(self, which: int, row: int) -> dict[str, Any]:
        mixed, numbers = self.judged.population, self.numbers
        slope, width = mixed.means[1 + row, which], mixed.widths[1 + row, which]
        ends = [slope, slope - width, slope + width]
        effect, low, high = np.expm1(ends) if numbers.log[which] else ends
        return {
            "parameter": numbers.paths[which],
            "unit": numbers.units[which],
            "relative": bool(numbers.log[which]),
            "property": numbers.effects[row],
            "effect": float(effect),
            "interval": [float(low), float(high)],
            "certain": bool(abs(slope) > width),
        }


def population_of(
    numbers: Numbers, remarks: Sequence[str], campaign: CampaignSpec, apart: Collection[str] = ()
) -> Population:
    """The population of numbers over a campaign's batches.

    Specimens that are unlike it count in nothing else, nor do those that are ``apart`` for another reason, as long as
    enough others are left.
    """
    left = len(numbers.specimens) - len(set(apart).intersection(numbers.specimens))
    apart = apart if left >= FEWEST + len(numbers.effects) else ()
    judged = unlike(numbers, apart)
    if not judged.tested:
        found = f"{len(numbers.specimens)} specimens are too few to hold each against the others"
        remarks = [*remarks, f"{found}: {judged.needed} are needed"]
    else:
        remarks = [*remarks, _least(detectable(judged, NAMED))]
    sound = (judged.outside < NAMED) & np.array([name not in apart for name in numbers.specimens])
    groups = np.zeros(len(sound), dtype=np.int64)
    groups[sound] = groups_alike(judged.population.deviations[sound], judged.population.between, campaign.seed)
    batch_of = {one.name: one.properties.get(campaign.batch) for one in campaign.specimens}
    batches = [
        None if (batch := batch_of[name]) is None else f"{batch:g}" if isinstance(batch, float) else batch
        for name in numbers.specimens
    ]
    charts = control_charts(numbers, judged.population.means, batches, sound)
    return Population(numbers, judged, groups, charts, remarks)


def _least(deviations: float) -> str:
    """From where on one parameter makes an outlier."""
    if not np.isfinite(deviations):
        return "The specimens are too few to name one for a single parameter"
    return f"A specimen is an outlier where one parameter is about {deviations:.2g} standard deviations off, or more"
