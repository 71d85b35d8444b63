"""What a campaign file says."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import dashpot
from dashpot.model.network import NetworkSpec
from dashpot.text.name import shortened

Verb = Literal["fit", "compare", "diagnose"]
VERBS: tuple[Verb, ...] = ("fit", "compare", "diagnose")


@dataclass(frozen=True)
class Measured:
    """A specimen: its name, the path or address of its dataset, and its properties, numbers or words."""

    name: str
    data: str
    properties: Mapping[str, float | str] = field(default_factory=dict)

    @property
    def address(self) -> str:
        """Where the data are for a worker, which may have been started in another folder."""
        return self.data if "://" in self.data else os.path.abspath(self.data)


@dataclass(frozen=True)
class Job:
    """One piece of work: a verb with some models on one specimen. ``held``: numbers (SI, by path) that are given."""

    specimen: str
    data: str
    verb: Verb
    models: tuple[str, ...]
    held: Mapping[str, float] = field(default_factory=dict, hash=False)

    @property
    def name(self) -> str:
        """The name of its folder and of its record."""
        about = () if self.verb == "compare" else self.models
        return shortened("-".join([self.specimen, self.verb, *about, *(["shared"] if self.held else [])]))


@dataclass(frozen=True)
class CampaignSpec:
    """Specimens, the models and verbs for each of them, and what is asked of the population.

    shared: patterns of the parameters that all specimens have in common; dependence: the properties that numbers may
    depend on; batch: the property that control charts go along; memory: bytes that a job may take; reports: whether
    every job writes a report.
    """

    name: str
    about: str
    specimens: tuple[Measured, ...]
    models: tuple[NetworkSpec, ...]
    verbs: tuple[Verb, ...]
    seed: int = 0
    shared: tuple[str, ...] = ()
    dependence: tuple[str, ...] = ()
    batch: str = ""
    memory: float | None = None
    reports: bool = True

    @property
    def jobs(self) -> list[Job]:
        """Every job, specimen by specimen."""
        names = tuple(model.name for model in self.models)
        found = []
        for one in self.specimens:
            for verb in self.verbs:
                for models in [names] if verb == "compare" else [(name,) for name in names]:
                    found.append(Job(one.name, one.address, verb, models))
        return found

    @property
    def fingerprint(self) -> str:
        """What the result of a job depends on beside its data."""
        networks = [text for model in self.models for text in model.texts]
        parts = [dashpot.__version__, str(self.seed), str(self.reports), *networks]
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()
