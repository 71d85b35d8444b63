"""What a joint file says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from dashpot.model.network import NetworkSpec
from dashpot.text.problem import Place

FORMAT = "dashpot-joint/1"


@dataclass(frozen=True)
class Specimen:
    """A specimen: its network, and the file or folder of its dataset."""

    name: str
    network: NetworkSpec
    data: Path


@dataclass(frozen=True)
class Tie:
    """A number that is the same in several specimens: the path in each, by the name of the specimen."""

    paths: Mapping[str, str]
    place: Place = field(default_factory=Place, compare=False)

    @property
    def title(self) -> str:
        """The number as it is told: by its path, with those of the other specimens where they differ."""
        return " = ".join(dict.fromkeys(self.paths.values()))


@dataclass(frozen=True)
class JointSpec:
    """Specimens and the parameters that they share."""

    name: str
    about: str
    specimens: tuple[Specimen, ...]
    ties: tuple[Tie, ...]
    seed: int = 0
