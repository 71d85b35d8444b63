"""Runs that measure several forces, one force at a time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dashpot.data.dataset import Dataset
from dashpot.data.excitation import channel_at
from dashpot.data.run import Run


def one_force_each(dataset: Dataset) -> Dataset:
    """The dataset with a run ``v0@wheel_left`` for every force ``force@wheel_left`` of the run ``v0``.

    Its ``force`` and ``displacement`` are those at that node; the other channels stay. A run whose only force is called
    ``force`` stays as it is.
    """
    return replace(dataset, runs=tuple(part for run in dataset.runs for part in _parts(run)))


def _parts(run: Run) -> Iterator[Run]:
    ends = [name.partition("@")[2] for name in run.channels if name.startswith("force@")]
    measured = [end for end in ends if channel_at("displacement", end) in run.channels]
    if "force" in run.channels or not measured:
        yield run
        return
    for end in measured:
        own = {quantity: run.channels[channel_at(quantity, end)] for quantity in ("displacement", "force")}
        sensors = {
            quantity: run.sensors[name] for quantity in own if (name := channel_at(quantity, end)) in run.sensors
        }
        yield replace(
            run,
            name=f"{run.name}@{end}",
            group=f"{run.group}@{end}",
            repeats=f"{run.repeats}@{end}" if run.repeats else None,
            channels={**run.channels, **own},
            sensors={**run.sensors, **sensors},
            end=end,
        )
