"""What a test procedure promises: named runs, each with the prescribed motion of the nodes that the rig drives."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive, drive_from_path
from dashpot.data.excitation import Excitation

Array = NDArray[np.float64]

PORT = ""
"""The driven node of a network that has a single one."""


@dataclass(frozen=True, eq=False)
class PrescribedPath:
    """The motion of a node, its rates known in closed form: (n,) in m, m/s and m/s^2.

    Examples:
        >>> time = np.arange(0.0, 1.0, 0.01)
        >>> path = dp.PrescribedPath(1e-3 * time, np.full(100, 1e-3), np.zeros(100))
        >>> path.displacement.shape
        (100,)
    """

    displacement: Array
    velocity: Array
    acceleration: Array

    def drive(self, sample_time: float) -> Drive:
        """The motion as a drive of a network."""
        return drive_from_path(sample_time, self.displacement, self.velocity, self.acceleration)


@dataclass(frozen=True, eq=False)
class PlannedRun:
    """A run before it is measured.

    kind: one of the kinds of a dataset; sample_time: s; motion: driven node -> path, `PORT` where there is one driven
    end; settings: numbers in SI, among them ``added_mass`` (kg on each wheel); notes: words.

    Examples:
        >>> planned = dp.PlannedRun("ramp", "transient", 0.01, {"": path})
        >>> planned.samples, planned.excitation().name
        (100, 'ramp')
    """

    name: str
    kind: str
    sample_time: float
    motion: Mapping[str, PrescribedPath]
    settings: Mapping[str, float] = field(default_factory=dict)
    notes: Mapping[str, str] = field(default_factory=dict)

    @property
    def samples(self) -> int:
        """How many samples the run has."""
        return len(next(iter(self.motion.values())).displacement)

    @property
    def time(self) -> Array:
        """The instants (n,) in s."""
        return np.arange(self.samples, dtype=float) * self.sample_time

    def excitation(self) -> Excitation:
        """What the rig does to the specimen."""
        drives = {node: path.drive(self.sample_time) for node, path in self.motion.items()}
        return Excitation(drives, {}, self.settings, self.sample_time, self.samples, self.name)


class Rig(ABC):
    """A test procedure. Keyword arguments of the constructor, with types, units and defaults, are its options.

    Examples:
        >>> class Ramp(dp.Rig):
        ...     '''One slow ramp.'''
        ...     word = "ramp"
        ...     def runs(self):
        ...         return [planned]
        >>> [run.name for run in Ramp().runs()]
        ['ramp']
    """

    word: ClassVar[str]
    """The name of the procedure in files and on the command line."""

    @abstractmethod
    def runs(self) -> Sequence[PlannedRun]:
        """All runs, in the order in which they are measured; their names differ."""
