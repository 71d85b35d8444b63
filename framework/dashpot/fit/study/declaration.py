"""What a study file says."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from dashpot.fit.study.patterns import chosen
from dashpot.model.network import NetworkSpec, Slot


@dataclass(frozen=True)
class TakeStage:
    """Numbers are read from the data: the ``curves`` from the slow loop, or the correction of their ``ends``."""

    name: str
    take: Literal["curves", "ends"]


@dataclass(frozen=True)
class SearchStage:
    """Numbers are searched: those that ``free`` names and ``fixed`` does not, on dynamic, slow or all runs.

    budget: parameter vectors to be evaluated at most, by all ``starts`` together.
    """

    name: str
    free: tuple[str, ...]
    fixed: tuple[str, ...]
    runs: Literal["dynamic", "slow", "all"]
    optimizer: str
    options: Mapping[str, Any]
    budget: int
    starts: int = 1

    def frees(self, slot: Slot) -> bool:
        """Whether the stage may move a number."""
        return slot.value.searched and chosen(slot.path, self.free) and not chosen(slot.path, self.fixed)


Stage = TakeStage | SearchStage


@dataclass(frozen=True)
class ModelPlan:
    """A network with its stages; ``start_from`` names the model of the study whose numbers it takes over.

    runs: patterns of the runs that it is about; parts: branch -> the model of the study that the branch uses, as it was
    identified.
    """

    network: NetworkSpec
    stages: tuple[Stage, ...]
    start_from: str | None = None
    runs: tuple[str, ...] = ("*",)
    parts: Mapping[str, str] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The name of the network."""
        return self.network.name

    @property
    def needs(self) -> set[str]:
        """The models of the study that it starts from or has as parts."""
        return {*self.parts.values(), *([self.start_from] if self.start_from else [])}

    @property
    def budget(self) -> int:
        """The parameter vectors of all its stages."""
        return sum(stage.budget for stage in self.stages if isinstance(stage, SearchStage))


@dataclass(frozen=True)
class DataSource:
    """A dataset by path, or a virtual specimen by word and seed."""

    path: Path | None = None
    specimen: str = ""
    seed: int = 0


@dataclass(frozen=True)
class StudySpec:
    """A study: models in order, each with its stages.

    hold_out: patterns of the held-out runs, None where the seed chooses; weights: pattern -> weight of the runs that it
    names; amplitude: the one at which the report compares dynamic stiffness (m); bootstrap: how many resamplings of the
    runs, profiles: patterns of the parameters whose profile likelihood is computed.
    """

    name: str
    about: str
    data: DataSource
    models: tuple[ModelPlan, ...]
    seed: int = 0
    hold_out: tuple[str, ...] | None = None
    weights: Mapping[str, float] = field(default_factory=dict)
    amplitude: float | None = None
    bootstrap: int = 0
    profiles: tuple[str, ...] = ()
    text: str = field(default="", repr=False)

    def ready(self, done: Collection[str]) -> list[ModelPlan]:
        """The models that are not ``done`` and wait for none that is not."""
        return [plan for plan in self.models if plan.name not in done and plan.needs <= set(done)]

    @property
    def together(self) -> int:
        """How many models at most can be identified at the same time."""
        done: set[str] = set()
        most = 0
        while ready := self.ready(done):
            most = max(most, len(ready))
            done |= {plan.name for plan in ready}
        return most

    @property
    def budget(self) -> int:
        """The parameter vectors of all models."""
        return sum(model.budget for model in self.models)
