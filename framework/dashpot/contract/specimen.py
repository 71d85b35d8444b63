"""The base class of virtual test specimens."""

from __future__ import annotations

from abc import ABC, abstractmethod
from pathlib import Path
from typing import ClassVar


class Specimen(ABC):
    """Something that can be measured without a test rig, because its truth is a program.

    A specimen shares no code with the models that are fitted to it. ``demo`` offers it to ``dashpot demo``, which
    compares the shipped networks ``networks`` on its dataset and then diagnoses the one named ``suspect``.

    Examples:
        >>> tire = dp.load_registry().specimens["test_tire"]
        >>> issubclass(tire, dp.Specimen), tire.suspect
        (True, 'kelvin_voigt')
    """

    word: ClassVar[str] = ""
    about: ClassVar[str] = ""
    demo: ClassVar[bool] = False
    networks: ClassVar[tuple[str, ...]] = ()
    suspect: ClassVar[str] = ""

    @abstractmethod
    def measure(self, folder: Path, seed: int) -> Path:
        """Write ``dataset.yaml`` and the measured files into ``folder`` unless they are there; return its path.

        The same seed gives the same bytes.
        """
