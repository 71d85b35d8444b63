"""A look at measured runs before any model: what they are, whether they take up work, what repeats differ by."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.compare.explainable import Explainable, explainable_error
from dashpot.compare.metrics import metric_rows
from dashpot.compare.shapes import shapes_of
from dashpot.compare.signals import measured_signals
from dashpot.compare.strokes import Seen, see, work
from dashpot.contract.metric import Metric
from dashpot.data.alignment import NotRepeatsError
from dashpot.data.dataset import Dataset
from dashpot.data.repeats import compare_repeats
from dashpot.fit.api import Setting, prepare
from dashpot.fit.floor import false_repeats
from dashpot.fit.result import floor_of
from dashpot.triage.energy import runs_that_give_back
from dashpot.triage.examine import examine
from dashpot.triage.fault import Fault
from dashpot.triage.telling import told_once
from dashpot.triage.work import work_of_cycles

Array = NDArray[np.float64]

LINES = 400  # of a spectrum, evenly spaced over the logarithm of the frequency


@dataclass(frozen=True, eq=False)
class Look:
    """What was seen; ``seen`` are the runs with their motion, ``explainable`` what a general model leaves.

    ``faults`` are those that triage found, ``metrics`` rows of numbers that runs have. The runs are shown as they were
    measured, with their faults.
    """

    setting: Setting
    seen: tuple[Seen, ...]
    explainable: Explainable
    seed: int
    faults: tuple[Fault, ...] = ()
    metrics: tuple[Mapping[str, Any], ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """The result as in ``look.json``, in SI."""
        dataset = self.setting.dataset
        back = runs_that_give_back(dataset.runs)
        return {
            "format": "dashpot-look/1",
            "dataset": {
                "name": dataset.name,
                "digest": dataset.digest,
                "runs": [run.name for run in dataset.runs],
                "held_out": list(self.setting.split.held_out),
            },
            "noise_floor": floor_of(self.setting.floor),
            "explainable": self.explainable.as_dict(),
            "runs": [described(each, each.run.name in back) for each in self.seen],
            "metrics": list(self.metrics),
            "faults": [
                {"run": fault.run, "kind": fault.kind, "evidence": fault.evidence, "cure": fault.cure}
                for fault in self.faults
            ],
            "repeats": [{key: group[key] for key in ("runs", "rms")} for group in self.repeats()],
            "seed": self.seed,
        }

    def evidence(self) -> dict[str, Any]:
        """Arrays and texts for the report."""
        runs = self.setting.dataset.runs
        measured = {run.name: measured_signals(run) for run in runs}
        return {
            "loops": {"measured": measured, "simulated": {}},
            "shapes": shapes_of(runs),
            "spectra": [spectrum for each in self.seen for spectrum in spectra(each)],
            "repeats": self.repeats(),
            "warnings": [
                *(each.sentence for each in told_once(self.faults, len(self.seen))),
                *map(str, self.setting.dataset.problems),
                *false_repeats(self.setting.dataset),
            ],
        }

    def repeats(self) -> list[dict[str, Any]]:
        """Each group of repeated runs: their names, ``rms`` N, and ``departure`` (k, n) N of each from their mean.

        ``rms`` is what they differ by, small differences of the motion and constant ones taken out.
        """
        ordered = sorted(self.setting.dataset.runs, key=lambda run: run.group)
        groups = [list(runs) for _, runs in groupby(ordered, lambda run: run.group)]
        told = []
        for group in (group for group in groups if len(group) > 1):
            try:
                compared = compare_repeats([(run.displacement, run.force) for run in group], group[0].sample_time)
            except NotRepeatsError:
                continue
            departure = compared.departure - compared.departure.mean(axis=1, keepdims=True)
            rms = float(np.sqrt(np.sum(np.mean(departure**2, axis=1)) / (len(group) - 1)))
            told.append(
                {
                    "runs": [run.name for run in group],
                    "rms": rms,
                    "departure": compared.departure,
                    "sample_time": group[0].sample_time,
                }
            )
        return told


def look(dataset: Dataset, seed: int = 0, metrics: Iterable[type[Metric]] = ()) -> Look:
    """Look at the runs of a dataset before any model. The same seed holds out the same runs."""
    setting = prepare(dataset, seed)
    triage = examine(dataset)
    seen = tuple(see(run) for run in setting.dataset.runs)
    return Look(
        setting,
        seen,
        explainable_error(setting, seed),
        seed,
        triage.faults[triage.read :],
        tuple(metric_rows(metrics, setting.dataset.runs)),
    )


def described(seen: Seen, gives_back: bool) -> dict[str, Any]:
    """A run in numbers, SI: what it was moved by, its force, and what its closed cycles take up.

    ``energy_per_cycle`` in J is the mean over ``cycles`` between passages of the middle, which triage judges by; of a
    single loop that has none, that of the loop. Without closed cycles ``work`` in J, that of the whole run with its
    ends joined, stands alone. ``gives_back`` says that it gives back work beyond doubt, as triage tells it. Stiffness
    and loss are medians over cycles between reversals.
    """
    run, force = seen.run, seen.forces["measured"]
    values = seen.cycle_values["measured"]
    whole = work(seen.displacement[seen.first :], force[seen.first :])
    energy, cycles = _energy_of_cycles(seen)
    return {
        "run": run.name,
        "kind": run.kind,
        "settings": dict(run.settings),
        "repeats": run.repeats,
        "duration": float(run.time[-1]),
        "sampling": 1.0 / run.sample_time,
        "amplitude": seen.amplitude,
        "preload": seen.preload,
        "peak_speed": seen.peak_speed,
        "least_force": float(force.min()),
        "largest_force": float(force.max()),
        "cycles": cycles,
        "energy_per_cycle": energy,
        "work": whole,
        "stiffness": float(np.median(values.stiffness)) if values.time.size else None,
        "loss": float(np.median(values.loss)) if values.time.size else None,
        "gives_back": gives_back,
    }


def _energy_of_cycles(seen: Seen) -> tuple[float | None, int]:
    """The work in J that a closed cycle takes up, and how many there are."""
    between, loops = work_of_cycles(seen.run), seen.cycle_values["measured"].energy
    if between is not None:
        return between.mean, between.halves.size // 2
    return float(np.median(loops)) if loops.size else None, int(loops.size)


def spectra(seen: Seen) -> list[dict[str, Any]]:
    """Amplitude spectra of force (N) and displacement (m) over frequency (Hz), the largest line of each stretch."""
    signals: Mapping[str, Array] = {"force": seen.forces["measured"], "displacement": seen.displacement}
    count = seen.run.time.size
    window = np.hanning(count)
    frequency = np.fft.rfftfreq(count, seen.run.sample_time)[1:]
    edges = np.unique(np.searchsorted(frequency, np.geomspace(frequency[0], frequency[-1], LINES)))
    told = []
    for name, values in signals.items():
        lines = 2.0 / window.sum() * np.abs(np.fft.rfft((values - values.mean()) * window))[1:]
        largest = np.maximum.reduceat(lines, edges)
        told.append({"run": seen.name, "label": "measured", "of": name, "x": frequency[edges], "y": largest})
    return told
