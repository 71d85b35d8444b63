"""All checks of triage in order, each on what the ones before it left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from dashpot.data.correction import Correction
from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.data.groups import group_repeats
from dashpot.data.history import REACHED, corrected_reach, knowing_better
from dashpot.data.run import Run
from dashpot.data.steady import STEADY
from dashpot.text.problem import Place, Problem
from dashpot.triage.actuator import actuator_remarks
from dashpot.triage.declared import moved_otherwise
from dashpot.triage.dropouts import lost_samples
from dashpot.triage.duplicates import duplicate_runs
from dashpot.triage.fault import RANGE, RECORD, Fault, corrected
from dashpot.triage.one_test import joined
from dashpot.triage.passivity import work_faults
from dashpot.triage.scale import wrong_scales
from dashpot.triage.telling import told_once


@dataclass(frozen=True, eq=False)
class Triage:
    """``dataset`` without the runs at fault, or with a channel corrected; ``faults`` and ``remarks`` say why.

    Its runs measure one force each. The first ``read`` faults were told by reading; ``measured`` runs were looked at.
    """

    dataset: Dataset
    faults: tuple[Fault, ...]
    remarks: tuple[str, ...]

    read: int = 0
    measured: int = 0

    @property
    def corrections(self) -> dict[str, Correction]:
        """The signs and units that were corrected, by run."""
        return {fault.run: fault.correction for fault in self.faults if fault.correction}

    @property
    def problems(self) -> tuple[Problem, ...]:
        """What was found here, beyond what reading has told: faults as errors, remarks as warnings.

        A fault that several runs have together is told once.
        """
        told = told_once(self.faults[self.read :], self.measured)
        found = [Problem(Place(), f"{each.runs}: {each.what}", each.cure) for each in told]
        return (*found, *(Problem(Place(), remark, severity="warning") for remark in self.remarks))

    @property
    def sentences(self) -> list[str]:
        """All faults for a list of warnings, those of reading among them, each once."""
        return [each.sentence for each in told_once(self.faults, self.measured)]


def examined(dataset: Dataset) -> Dataset:
    """The dataset as triage leaves it, which also tells what was found among its ``problems``."""
    triage = examine(dataset)
    return replace(triage.dataset, problems=(*dataset.problems, *triage.problems))


def examine(dataset: Dataset) -> Triage:
    """Look for faults of the measurement. A dataset never loses its last run."""
    read = [
        Fault(run, found.fault, found.message, found.hint, evidence_of=RANGE if found.fault == "clipping" else RECORD)
        for run, found in dataset.faults
    ]
    whole = one_force_each(dataset).runs
    measured = [
        run for run in whole if "force" in run.channels and "displacement" in run.channels and run.kind != STEADY
    ]
    accepted = {run.name for run in measured if "triage" in run.accept}
    copied = duplicate_runs(measured) + [fault for run in measured if (fault := lost_samples(run))]
    copied = [fault for fault in copied if fault.run not in accepted]
    runs = _without(measured, copied)
    turned, late = work_faults(runs)
    turned = [fault for fault in turned if fault.run not in accepted]
    runs = _without(runs, turned)
    # what gives energy back is no matter of comparison: a run that was turned for it is not turned back
    certain = accepted | {fault.run for fault in turned}
    scaled = [one for one in wrong_scales(runs) if one.run not in (certain if one.kind == "polarity" else accepted)]
    runs = _without(runs, scaled)
    faults = [*copied, *turned, *scaled]
    runs, one_test = joined(runs)
    kept = {run.name: run for run in runs} | {run.name: run for run in whole if run not in measured}
    left = group_repeats(_knowing_better([kept[run.name] for run in whole if run.name in kept], measured, faults))
    names = {run.name for run in runs}
    sound = [run for run in left if run.name in names]
    remarks = late + one_test + moved_otherwise(sound) + actuator_remarks(sound)
    if not left:
        left = list(whole)
        remarks.append("No run is without a fault, so all of them are used as they are: see what is said of each")
    return Triage(replace(dataset, runs=tuple(left)), (*read, *faults), tuple(remarks), len(read), len(measured))


def _knowing_better(runs: Sequence[Run], measured: Sequence[Run], faults: Sequence[Fault]) -> list[Run]:
    """The runs with what they know of those before them put right where a channel of these was corrected."""
    left, by_name = list(runs), {run.name: run for run in measured}
    factors = {
        fault.run: fault.factor for fault in faults if fault.factor is not None and fault.channel == "displacement"
    }
    for name, factor in factors.items():
        left = [knowing_better(run, by_name[name], factor) for run in left]
    reached = corrected_reach(measured, factors) if factors else {}
    return [
        replace(run, history={**run.history, REACHED: reached[run.name]}) if run.name in reached else run
        for run in left
    ]


def _without(runs: Sequence[Run], faults: Sequence[Fault]) -> list[Run]:
    """The runs without those that are left out, the others corrected."""
    of = {fault.run: fault for fault in faults}
    return [
        corrected(run, of[run.name]) if run.name in of else run
        for run in runs
        if run.name not in of or of[run.name].factor is not None
    ]
