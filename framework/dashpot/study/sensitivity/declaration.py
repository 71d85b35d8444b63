"""What a sensitivity study says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from dashpot.contract.bench import Bench
from dashpot.contract.metric import Metric
from dashpot.model.network import NetworkSpec

FORMAT = "dashpot-sensitivity/1"


@dataclass(frozen=True)
class Variation:
    """Parameters that change together, by their ``paths``: to one of the ``values`` in SI each, all in ``unit``.

    Where they are ``relative``, the values are factors of what the network has, without a unit.
    """

    name: str
    paths: tuple[str, ...]
    values: tuple[float, ...]
    relative: bool
    unit: str = ""


@dataclass(frozen=True)
class Scatter:
    """How parameters differ from specimen to specimen, all of the ``paths`` by the same draw.

    By a normal factor of mean 1 and standard ``deviation``, or evenly ``between`` two values in SI, in ``unit``.
    """

    paths: tuple[str, ...]
    deviation: float | None = None
    between: tuple[float, float] | None = None
    unit: str = ""


@dataclass(frozen=True, eq=False)
class SensitivitySpec:
    """A network on a bench, the metrics of the test, and what is varied.

    Metrics are computed ``over`` the values of one variation, at first with nothing else changed, then for each value
    of each of the others in ``vary``, and for ``draws`` specimens that differ by the ``scatter``. limits: word of a
    metric -> what a specimen must at least have, in the metric's unit.
    """

    name: str
    about: str
    network: NetworkSpec
    bench: Bench
    metrics: tuple[type[Metric], ...]
    over: Variation
    vary: tuple[Variation, ...] = ()
    scatter: tuple[Scatter, ...] = ()
    draws: int = 0
    seed: int = 0
    limits: Mapping[str, float] = field(default_factory=dict)

    @property
    def lanes(self) -> int:
        """How many parameter vectors are simulated."""
        others = sum(len(each.values) for each in self.vary)
        return len(self.over.values) * (1 + others + (self.draws if self.scatter else 0))
