"""A dataset that shows itself."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from functools import cached_property
from inspect import signature
from typing import TYPE_CHECKING, Any

import numpy as np

from dashpot.compare.signals import signal_evidence
from dashpot.data.arrays import dataset_of_arrays, join
from dashpot.data.channel import unit_of_channel
from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.data.order_tracking import DynamicStiffness, harmonics_of
from dashpot.data.run import Run
from dashpot.data.tracking import track
from dashpot.notebook.cell import cell
from dashpot.notebook.frames import Samples, samples_of_frame, samples_of_xarray
from dashpot.notebook.listing import Listing, frame
from dashpot.notebook.plots import plot
from dashpot.notebook.printed import Printed
from dashpot.notebook.promoted import promoted
from dashpot.report.parts import Column, Grid, Notice
from dashpot.text.digits import rig_unit
from dashpot.text.problem import InputError, nearest
from dashpot.text.quantity import pretty

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from pandas import DataFrame
    from plotly.graph_objects import Figure as PlotlyFigure
    from xarray import Dataset as XarrayDataset

PLOTS = ("stiffness", "loops")


class Data(Printed, Dataset):
    """Measured runs. In a notebook they show what was run and which channels were measured.

    Examples:
        >>> data = dp.load_dataset("mount")
        >>> [run.name for run in data.runs][:3]
        ['a0p5_p2_up', 'a0p5_p2_up_b', 'a1_p2_up']
        >>> data.table().rows[1]["remark"]
        'repeats a0p5_p2_up'
        >>> data.problems
        ()
        >>> time = np.arange(0.0, 4.0, 1e-3)
        >>> x = 1e-3 * np.sin(2.0 * np.pi * 5.0 * time)
        >>> sine = dp.Data.from_arrays(time, x, 2e5 * x, name="sine", settings={"amplitude": "1 mm"})
        >>> sine.runs[0].kind, sine.runs[0].settings
        ('harmonic', {'amplitude': 0.001})
        >>> both = dp.Data.join([data, sine], name="mount and sine")
        >>> dp.Data.from_pandas(both.to_pandas()).digest == both.digest
        False
        >>> bool(np.isclose(np.median(sine.dynamic_stiffness()["sine"].storage), 2e5))
        True
    """

    @classmethod
    def from_arrays(
        cls,
        time: ArrayLike | None = None,
        displacement: ArrayLike | None = None,
        force: ArrayLike | None = None,
        *,
        name: str = "run",
        kind: str | None = None,
        settings: Mapping[str, float | str] | None = None,
        repeats: str | None = None,
        held_out: bool | None = None,
        channels: Mapping[str, ArrayLike] | None = None,
        units: Mapping[str, str] | None = None,
        sampling: float | str | None = None,
        sensors: Mapping[str, Mapping[str, float | str]] | None = None,
        accept: Iterable[str] | None = None,
        **more: float | str,
    ) -> Data:
        """One run out of arrays (n,): time in s, displacement in m and force in N, compression positive; copied.

        ``units`` by channel, where they are others: ``{"displacement": "mm"}``. Without ``time`` the ``sampling`` rate
        in Hz is needed. ``channels`` are further ones by name, as ``temperature`` or ``force@wheel_left``. The other
        arguments are keys of a run in a dataset file; without ``kind`` it is found from the motion, as by
        `dashpot import`. Any ``more`` are settings, ``amplitude="1 mm"``; TypeError for one that is called nearly as an
        argument is. The samples go through what those of files go through: InputError for holes, clipping, wrong
        units, a clock that runs backwards and the like. Several runs become one dataset with ``join``.
        """
        samples = {"time": time, "displacement": displacement, "force": force, **(channels or {})}
        keys = {
            "name": name,
            "kind": kind,
            "settings": {**(settings or {}), **_refuse_slips(more)} or settings,
            "repeats": repeats,
            "held_out": held_out,
            "sampling": sampling,
            "sensors": sensors,
            "accept": None if accept is None else list(accept),
        }
        given = {channel: values for channel, values in samples.items() if values is not None}
        return promoted(cls, dataset_of_arrays(given, units or {}, keys))

    @classmethod
    def from_pandas(
        cls,
        frame: DataFrame,
        columns: Mapping[str, Hashable] | None = None,
        *,
        by: Hashable = "run",
        name: str = "run",
        units: Mapping[str, str] | None = None,
        runs: Mapping[str, Mapping[str, Any]] | None = None,
        **common: Any,
    ) -> Data:
        """The runs of a frame; a column ``by``, where there is one, names the run of each row.

        ``columns`` says the label of each channel, ``{"displacement": "Weg [mm]"}``; without it those count that are
        called as a channel is. A unit at the end of a label, in brackets, is that of the column. ``common`` and, by the
        name of a run, ``runs`` are further arguments of ``from_arrays``. A run with a fault is set aside and told of in
        ``problems``; InputError when none is left.
        """
        return cls._of_samples(samples_of_frame(frame, columns, by, name), name, units or {}, common, runs or {})

    @classmethod
    def from_xarray(
        cls,
        dataset: XarrayDataset,
        columns: Mapping[str, Hashable] | None = None,
        *,
        by: str = "run",
        name: str = "run",
        units: Mapping[str, str] | None = None,
        runs: Mapping[str, Mapping[str, Any]] | None = None,
        **common: Any,
    ) -> Data:
        """The runs of a dataset of xarray, along its dimension ``by`` where it has one; else as ``from_pandas``.

        Units stand in the attribute ``units`` of a variable. NaN at the end of a run, which fills it up to the length
        of the longest, is left out.
        """
        return cls._of_samples(samples_of_xarray(dataset, columns, by, name), name, units or {}, common, runs or {})

    @classmethod
    def join(cls, parts: Iterable[Dataset], name: str = "joined") -> Data:
        """The runs of several datasets in one, in their order; a run may repeat one of another part.

        InputError for two runs of one name, and for the repeat of a run that is none of them.
        """
        return promoted(cls, join(parts, name))

    @classmethod
    def _of_samples(
        cls,
        samples: Iterable[Samples],
        name: str,
        units: Mapping[str, str],
        common: Mapping[str, Any],
        runs: Mapping[str, Mapping[str, Any]],
    ) -> Data:
        sound, aside = list[Data](), dict[str, InputError]()
        for each in samples:
            keys = {**common, **runs.get(each.run, {})}
            stated = {**each.units, **units}
            try:
                sound.append(cls.from_arrays(channels=each.columns, name=each.run, units=stated, **keys))
            except InputError as error:
                aside[each.run] = error
        return promoted(cls, join(sound, name, aside))

    def dynamic_stiffness(self) -> dict[str, DynamicStiffness]:
        """Dynamic stiffness and harmonics over time, by run, of the sweeps and harmonic runs; others are left out.

        Each has ``frequency`` in Hz, ``amplitude`` and ``preload`` in m, ``storage`` and ``loss``, K' and K'' in N/m,
        ``magnitude`` in N/m and ``loss_angle`` in rad, all (m,) over windows of about four periods, with the standard
        deviation ``confidence`` (m,) of K' and of K''.
        """
        runs = one_force_each(self).runs
        return {run.name: harmonics_of(run.force, found) for run in runs if (found := track(run)) is not None}

    @property
    def groups(self) -> list[str]:
        """The group of every run, which it shares with its repeats: for cross-validation by groups."""
        return [run.cluster for run in self.runs]

    @property
    def _line(self) -> str:
        """The name, and how many runs."""
        return f"{self.name}, {len(self.runs)} run{'s' * (len(self.runs) != 1)}"

    def __str__(self) -> str:
        return "\n".join([super().__str__(), *map(str, self.problems)])

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


def _refuse_slips(more: Mapping[str, float | str]) -> Mapping[str, float | str]:
    """Settings by name, none of which is an argument with a slip of the pen."""
    *arguments, _ = signature(Data.from_arrays).parameters
    for word in more:
        if hint := nearest(word, arguments):
            raise TypeError(f"from_arrays: there is no argument '{word}', {hint} A setting goes into settings={{...}}")
    return more


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
