"""All checks of triage in order, each on what the ones before it left."""

from __future__ import annotations

from dataclasses import dataclass, replace

from dashpot.assess.triage.actuator import actuator_harmonics
from dashpot.assess.triage.dropouts import lost_samples
from dashpot.assess.triage.duplicates import duplicate_runs
from dashpot.assess.triage.fault import Fault, mended
from dashpot.assess.triage.likeness import odd_one
from dashpot.assess.triage.scale import wrong_scale
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run


@dataclass(frozen=True, eq=False)
class Triage:
    """``dataset`` without the runs at fault, or with their force mended; ``faults`` and ``remarks`` say why."""

    dataset: Dataset
    faults: tuple[Fault, ...]
    remarks: tuple[str, ...]


def examine(dataset: Dataset) -> Triage:
    """Look for faults of the measurement. A dataset never loses its last run."""
    read = [Fault(run, found.fault, found.message, found.hint) for run, found in dataset.faults]
    faults = duplicate_runs(dataset.runs)
    faults += [fault for run in dataset.runs if (fault := lost_samples(run))]
    bad = {fault.run for fault in faults}
    sound = [run for run in dataset.runs if run.name not in bad] or list(dataset.runs)
    runs, scaled = _mend_scales(sound)
    remarks = tuple(remark for run in runs if (remark := actuator_harmonics(run)))
    return Triage(replace(dataset, runs=tuple(runs)), (*read, *faults, *scaled), remarks)


def _mend_scales(runs: list[Run]) -> tuple[list[Run], list[Fault]]:
    """The runs with the force of odd ones multiplied, one after the other."""
    faults: list[Fault] = []
    for _ in range(len(runs) // 2):
        odd = odd_one(runs)
        fault = wrong_scale(odd) if odd else None
        if fault is None or fault.factor is None:
            break
        faults.append(fault)
        runs = [mended(run, fault.factor) if run.name == fault.run else run for run in runs]
    return runs, faults
