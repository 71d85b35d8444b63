"""What a rig does to a specimen with any number of ends: known motions, known forces, and the settings of the run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive, drive_from_samples
from dashpot.data.history import NOTHING
from dashpot.data.run import Run
from dashpot.text.problem import InputError, Place

Array = NDArray[np.float64]

# what drives a specimen or is its answer; of every other channel a run has a mean
MOVING = ("time", "displacement", "velocity", "acceleration", "force")
# the setting that every run of a dataset has: its number there, from 0, as it was measured
ORDER = "order"

_known: WeakKeyDictionary[Run, Excitation] = WeakKeyDictionary()


def channel_at(quantity: str, node: str) -> str:
    """The name of a channel: ``force@wheel_left``, or ``force`` alone in a network with two ends."""
    return f"{quantity}@{node}" if node else quantity


@dataclass(frozen=True, eq=False)
class Excitation:
    """Motions (Drive) and loads (n,) in N by the name of the node, and the settings of the test procedure, in SI.

    The node of a network with two ends has the name "". ``channels`` (n,) in SI are all further ones that were measured
    (temperature, pressure ...). Among the settings are their means, as ``mean_of`` names them, the ``order`` of a run
    in its dataset, and the deflection that was ``reached`` before it.
    ``name`` is that of the run, ``source`` its file, ``units`` are those in which settings were told.
    """

    motions: Mapping[str, Drive]
    loads: Mapping[str, Array] = field(default_factory=dict)
    settings: Mapping[str, float] = field(default_factory=dict)
    dt: float = 0.0
    samples: int = 0
    name: str = ""
    source: str = ""
    units: Mapping[str, str] = field(default_factory=dict)
    channels: Mapping[str, Array] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """The means of the channels join the settings, where these do not tell them."""
        unknown = {name: each for name, each in self.channels.items() if mean_of(name) not in self.settings}
        if unknown:
            object.__setattr__(self, "settings", {**self.settings, **_means(unknown)})

    @classmethod
    def of_drive(cls, drive: Drive) -> Excitation:
        """The excitation of a network with two ends."""
        return cls({"": drive}, dt=drive.dt, samples=drive.samples)

    @classmethod
    def of_run(cls, run: Run) -> Excitation:
        """The measured motions of a run, and the forces at nodes whose motion is not measured; made once for each."""
        if run not in _known:
            _known[run] = cls._of_run(run)
        return _known[run]

    @classmethod
    def _of_run(cls, run: Run) -> Excitation:
        motions = {
            _node(name): drive_from_samples(
                run.sample_time, samples, force=run.channels.get(channel_at("force", _node(name)))
            )
            for name, samples in run.channels.items()
            if name.partition("@")[0] == "displacement"
        }
        loads = {
            _node(name): np.array(samples)
            for name, samples in run.channels.items()
            if name.partition("@")[0] == "force" and _node(name) not in motions
        }
        return cls(
            motions,
            loads,
            settings_of(run),
            run.sample_time,
            run.time.size,
            run.record,
            run.source,
            run.units,
            further_channels(run),
        )

    def at(self, driven: Sequence[str], loaded: Sequence[str]) -> Excitation:
        """The excitation of a network with these nodes; a single motion without a name is that of its only driven node.

        Raises InputError for a node whose motion or load is not there.
        """
        motions = dict(self.motions)
        if len(driven) == 1 and driven[0] not in motions and "" in motions:
            motions = {driven[0]: motions[""]}
        for quantity, known, nodes in (("displacement", motions, driven), ("force", self.loads, loaded)):
            for node in nodes:
                if node not in known:
                    raise InputError.at(
                        Place(self.source or None),
                        f"run '{self.name}' has no channel "
                        f"'{channel_at(quantity, node)}', which the network needs; it has motions of "
                        f"{_names(self.motions)}",
                        "declare it under 'channels'",
                    )
        return replace(self, motions=motions)


def settings_of(run: Run) -> dict[str, float]:
    """The settings of a run, its ``order`` in the dataset, its history, and the means of its further channels."""
    return {ORDER: float(run.order), **NOTHING, **run.history, **run.settings, **_means(further_channels(run))}


def further_channels(run: Run) -> dict[str, Array]:
    """What was measured (n,) beside motions and forces, in SI."""
    return {name: samples for name, samples in run.channels.items() if name.partition("@")[0] not in MOVING}


def mean_of(channel: str) -> str:
    """The name of the mean of a channel among the settings."""
    return f"mean of {channel}"


def _means(channels: Mapping[str, Array]) -> dict[str, float]:
    return {mean_of(name): float(np.mean(samples)) for name, samples in channels.items()}


def _node(channel: str) -> str:
    return channel.partition("@")[2]


def _names(nodes: Iterable[str]) -> str:
    return ", ".join(f"'{node}'" for node in nodes) or "no node"
