"""A dataset that shows itself."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from dashpot.compare.signals import signal_evidence
from dashpot.data.channel import unit_of_channel
from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.data.run import Run
from dashpot.notebook.cell import cell
from dashpot.notebook.listing import Listing, frame
from dashpot.notebook.plots import plot
from dashpot.report.parts import Column, Grid, Notice
from dashpot.report.readable import rig_unit
from dashpot.text.quantity import pretty

if TYPE_CHECKING:
    from pandas import DataFrame
    from plotly.graph_objects import Figure as PlotlyFigure

PLOTS = ("stiffness", "loops")


class Data(Dataset):
    """Measured runs. In a notebook they show what was run and which channels were measured.

    Examples:
        >>> data = dp.load_dataset("mount")
        >>> [run.name for run in data.runs][:3]
        ['a0p5_p2_up', 'a0p5_p2_up_b', 'a1_p2_up']
        >>> data.table().rows[1]["remark"]
        'repeats a0p5_p2_up'
        >>> data.problems
        ()
    """

    def table(self) -> Listing:
        """The runs: kind, settings, length, and which are repeats or held out."""
        columns = [
            Column("run", "run"),
            Column("kind", "kind"),
            Column("settings", "settings"),
            Column("duration", "length", "s", 4),
            Column("sampling", "sampling", "Hz", 4),
            Column("remark", "remark"),
        ]
        rows = [_run_row(run) for run in self.runs]
        used = [column for column in columns if any(row[column.key] is not None for row in rows)]
        return Listing("Runs", used, rows, csv_name="runs.csv")

    def channels(self) -> Listing:
        """The channels with the smallest and largest value over all runs."""
        columns = [
            Column("channel", "channel"),
            Column("runs", "runs", "", 3),
            Column("low", "smallest", "", 4),
            Column("high", "largest", "", 4),
            Column("unit", "unit"),
        ]
        names = list(dict.fromkeys(name for run in self.runs for name in run.channels))
        return Listing("Channels", columns, [self._channel_row(name) for name in names], csv_name="channels.csv")

    def to_pandas(self) -> DataFrame:
        """All samples below one another, in SI: run, time and every channel."""
        names = list(dict.fromkeys(name for run in self.runs for name in run.channels))
        columns: dict[str, Any] = {
            "run": np.concatenate([np.full(run.time.size, run.name, dtype=object) for run in self.runs]),
            "time (s)": np.concatenate([run.time for run in self.runs]),
        }
        for name in names:
            gap = [run.channels.get(name, np.full(run.time.size, np.nan)) for run in self.runs]
            columns[_heading(name)] = np.concatenate(gap)
        return frame(columns)

    def plot(self, what: str = "stiffness") -> PlotlyFigure:
        """Draw the measurement: ``stiffness`` (dynamic stiffness and loss angle) or ``loops``.

        ValueError for another name, and for a stiffness where nothing oscillates.
        """
        return plot(what, self._evidence, PLOTS)

    @cached_property
    def _evidence(self) -> dict[str, Any]:
        return signal_evidence(one_force_each(self).runs, {})

    def _channel_row(self, name: str) -> dict[str, Any]:
        found = [run.channels[name] for run in self.runs if name in run.channels]
        low, high = min(np.min(values) for values in found), max(np.max(values) for values in found)
        factor, unit = rig_unit(unit_of_channel(name) or "", max(abs(low), abs(high)))
        return {"channel": name, "runs": len(found), "low": low * factor, "high": high * factor, "unit": unit or None}

    def _repr_html_(self) -> str:
        problems = [Notice("warning", str(problem)) for problem in self.problems]
        runs: Grid = self.table()
        return cell(self.name, *problems, runs, self.channels())


def _run_row(run: Run) -> dict[str, Any]:
    return {
        "run": run.name,
        "kind": run.kind,
        "settings": ", ".join(_settings(run)) or None,
        "duration": float(run.time[-1]),
        "sampling": 1.0 / run.sample_time,
        "remark": f"repeats {run.repeats}" if run.repeats else "held out" if run.held_out else None,
    }


def _settings(run: Run) -> Iterator[str]:
    from dashpot.data.writing import UNITS

    for key, value in run.settings.items():
        yield f"{key.replace('_', ' ')} {pretty(value, UNITS.get(key, '1'))}".removesuffix(" 1")
    yield from (f"{key} {text}" for key, text in run.notes.items())


def _heading(name: str) -> str:
    unit = unit_of_channel(name)
    return f"{name} ({unit})" if unit else name
