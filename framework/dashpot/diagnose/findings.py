"""What a diagnosis found, as files: the extended network and the corrected dataset.

The files come first: every error, gain and plot that is told is that of the extended network and the corrected dataset
as they are written, read again and simulated.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import dashpot
from dashpot.compare.explainable import Explainable, explainable_error
from dashpot.compare.misfit import Misfit, describe_misfit
from dashpot.contract.cause import Cause
from dashpot.data.correction import Correction, corrected_text
from dashpot.diagnose.channel import Accused
from dashpot.diagnose.data_sheet import error_admitted
from dashpot.diagnose.front import FORM_ERROR
from dashpot.diagnose.leftover import Leftover
from dashpot.diagnose.look import give_back_memory
from dashpot.diagnose.named import about_of, standing_of
from dashpot.diagnose.next_run import NextRun
from dashpot.diagnose.polish import left_out_error
from dashpot.diagnose.pursuit import Pursuit
from dashpot.diagnose.single_runs import departure_in_words, floor_of_corrected
from dashpot.diagnose.table_rows import groups_of
from dashpot.diagnose.term import Term
from dashpot.fit.api import Setting, measure_errors
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.kept_curves import kept_curves
from dashpot.fit.objective import as_simulated
from dashpot.fit.result import Errors, FitResult
from dashpot.fit.scored import ScoredRun
from dashpot.fit.seen_range import seen_range
from dashpot.model.element import Element
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import fill_numbers, rename
from dashpot.model.reading import parse_network
from dashpot.text.name import joined_name
from dashpot.triage.examine import Triage

Array = NDArray[np.float64]

ALONE = 2.0  # times the error of the worst training run
CORRECTED, TRIAGED = "dataset.yaml", "dataset.triage.yaml"  # with all faults put right, with those of triage alone
NEAR_FLOOR = 2.0  # times the noise floor: beyond it the RMSE of a model is more than noise
# how the head of a file calls a term, by its standing
IN_FILES = {"accepted": "cause", "probable": "probable cause", "resembles": "resembles"}


@dataclass(frozen=True, eq=False)
class Removal:
    """The network without one cause, all else fitted again."""

    name: tuple[str, str]
    network: NetworkSpec


@dataclass(frozen=True, eq=False)
class Findings:
    """Everything that was found, the files that are written of it, and what they give when they are read again.

    ``corrected`` are the training runs with the faults of single runs put right. By those that are ``apart`` nothing
    was decided, and to them nothing fitted: what is left is of these alone.
    """

    setting: Setting
    triage: Triage
    fit: FitResult
    pursuit: Pursuit
    accused: tuple[Accused, ...]
    apart: tuple[str, ...]
    corrected: Mapping[str, ScoredRun]
    final: NetworkSpec
    removals: tuple[Removal, ...]
    leftover: Leftover
    next_runs: Mapping[tuple[str, str], NextRun]
    causes: Mapping[str, type[Cause]]
    relevance: float
    seed: int
    jobs: int = 1

    @property
    def model(self) -> NetworkSpec:
        """The network that was diagnosed."""
        return self.fit.declared

    @property
    def elements(self) -> dict[str, type[Element]]:
        """The laws that the networks use, by their word."""
        return {leaf.element.word: leaf.element for leaf in [*self.model.leaves(), *self.final.leaves()]}

    # the files

    @property
    def extended_name(self) -> str | None:
        """File name of the network that goes with the result, None where that is the diagnosed one as it was fitted.

        Where nothing was added it is the network without the branches that may go, or fitted to corrected runs, or
        without the runs that are ``apart``, or with the curves of the slow loop refined to all runs.
        """
        words = list(dict.fromkeys(term.word for term in self.pursuit.best.model.causes))
        words = words or ["reduced"] * bool(self.spare) or ["corrected"] * bool(self.accused)
        words = words or ["others"] * bool(self.apart) or ["refined"] * self._refined
        return f"{joined_name(self.model.name, words)}.yaml" if words else None

    @cached_property
    def _refined(self) -> bool:
        """Whether curves that the fit keeps as the slow loop gives them follow the runs better when they are free."""
        if not kept_curves(self.fit.fitted):
            return False
        free = measure_errors(self.final, self.after_setting, self.jobs)
        return free.train < (1.0 - self.relevance) * self.before.train

    @property
    def spare(self) -> tuple[str, ...]:
        """The branches of the diagnosed network that the final one does without."""
        return tuple(one.branch for one in self.pursuit.best.model.gone)

    def probability(self, name: tuple[str, str]) -> float:
        """How sure a cause is, beside the structure that stays unexplained."""
        return self.pursuit.probability(name, self.unexplained)

    def presence(self, term: Term) -> float:
        """How sure it is that something is in the place of a cause; of a fault of the measurement, that it is this."""
        found = self.pursuit.probability if term.cause.kind == "measurement" else self.pursuit.presence
        return found(term.name, self.unexplained)

    @cached_property
    def unexplained(self) -> float:
        """The share of the square of the residual on training runs that is structure of unknown cause.

        Near the noise it is what the tests find, or what is missed of runs left out beyond what an explained model may;
        farther from it, all that is no noise: any law takes up a part of that by chance.
        """
        known = self._floor if self._floor and not self._near_floor else (1.0 + FORM_ERROR) * self._attainable
        left = 0.0 if self.apart else self.leftover.share
        return max(left, 1.0 - min(known / self._unseen, 1.0) ** 2)

    @property
    def fitted_name(self) -> str:
        """File name of the diagnosed network with its fitted parameters."""
        return f"{self.model.name}.yaml"

    @property
    def fitted_text(self) -> str:
        """The diagnosed network with its fitted parameters."""
        return self.fit.identified_text

    @cached_property
    def extended_text(self) -> str | None:
        """The extended network with its numbers, comments of the original intact."""
        if self.extended_name is None:
            return None
        record = {
            "data": self.setting.dataset.digest[:16],
            "seed": str(self.seed),
            "version": dashpot.__version__,
            "predecessor": self.model.name,
        }
        sure = {self._title(term): standing_of(self.presence(term)) for term in self.pursuit.best.model.causes}
        without = f"fitted without {', '.join(self.apart)}" if self.apart else "its curves refined to all runs"
        plain = "fitted to corrected runs" if self.accused else without
        what = "extended by a diagnosis" if sure else "without what may go" if self.spare else plain
        told = [f"{IN_FILES[standing]}: {title}" for title, standing in sure.items()]
        head = [f"{self.model.name}, {what}.", *told]
        seen = seen_range(self.model, self._deciding)
        text = fill_numbers(self.pursuit.best.model.declared, self.final, record, seen)
        return rename(text, self.extended_name.removesuffix(".yaml"), [*head, f"predecessor: {self.model.name}"])

    def _title(self, term: Term) -> str:
        about = about_of(self.pursuit.best.model, term.name, self.final)
        return f"{about} {term.site.words}" if term.site else about

    @property
    def corrections(self) -> dict[str, Correction]:
        """What puts runs right, by run: what triage found, and the faults that runs were accused of."""
        found = self.triage.corrections
        for one in self.accused:
            known = found.get(one.run)
            found[one.run] = known.then(one.correction) if known else one.correction
        return found

    @property
    def set_aside(self) -> dict[str, str]:
        """The runs that triage set aside, with the reason."""
        kept = {run.record for run in self.setting.dataset.runs}
        return {
            fault.run: fault.evidence for fault in self.triage.faults if fault.factor is None and fault.run not in kept
        }

    @property
    def corrected_name(self) -> str | None:
        """File name of the corrected dataset, that of the error after.

        None where no run was corrected or set aside, or there is no file.
        """
        return CORRECTED if (self.corrections or self.set_aside) and self.setting.dataset.document else None

    @property
    def triaged_name(self) -> str | None:
        """File name of the dataset with what triage found and nothing else, that of the error before.

        None where triage found nothing, or there is no file.
        """
        if not (self.triage.corrections or self.set_aside):
            return None
        return TRIAGED if self.accused and self.corrected_name else self.corrected_name

    def datasets(self, folder: Path) -> dict[str, str]:
        """The texts of the corrected datasets by file name, to be written into a folder."""
        written = {self.triaged_name: self.triage.corrections, self.corrected_name: self.corrections}
        return {
            name: corrected_text(self.setting.dataset, corrections, self.set_aside, folder)
            for name, corrections in written.items()
            if name
        }

    # what the files say

    @cached_property
    def written(self) -> NetworkSpec:
        """The final network as it is written, read again."""
        text = self.extended_text
        return parse_network(text, self.elements) if text else self.written_before

    @cached_property
    def written_before(self) -> NetworkSpec:
        """The diagnosed network as it is written, read again."""
        return parse_network(self.fitted_text, self.elements)

    @cached_property
    def after_setting(self) -> Setting:
        """The runs as the corrected dataset has them; of held-out runs nothing but what triage was certain of."""
        return replace(self.setting, scored={**self.setting.scored, **self.corrected})

    @cached_property
    def before(self) -> Errors:
        """The errors of the diagnosed network."""
        return measure_errors(self.written_before, self.setting, self.jobs)

    @cached_property
    def after(self) -> Errors:
        """The errors of the final files."""
        return measure_errors(self.written, self.after_setting, self.jobs)

    @cached_property
    def left_out(self) -> float | None:
        """The error in N of the written network on training runs left out in turn; None where they cannot be."""
        runs = self._deciding
        groups = groups_of(runs, {run.name: run.cluster for run in self.setting.dataset.runs})
        free = self.pursuit.best.model.coordinates if self.extended_name else search_coordinates(self.fit.fitted)
        return left_out_error(self._chosen, free, runs, groups, self.jobs)

    @property
    def _chosen(self) -> NetworkSpec:
        """The network that is written: the final one, or the one that was diagnosed as it was fitted."""
        return self.final if self.extended_name else self.fit.fitted

    @property
    def _deciding(self) -> list[ScoredRun]:
        """The training runs to which that network was fitted."""
        return [run for run in self.corrected.values() if run.name not in self.apart]

    @cached_property
    def _trained(self) -> float:
        """The RMSE in N of the network that is written on the training runs to which it was fitted."""
        errors = measure_errors(self._chosen, self.after_setting, self.jobs).per_run
        deciding = [name for name in self.setting.split.train if name not in self.apart]
        return float(np.sqrt(np.mean([errors[name] ** 2 for name in deciding])))

    @property
    def _unseen(self) -> float:
        """The RMSE in N on training runs left out in turn, or on all where they cannot be."""
        return max(self._trained, self.left_out or 0.0)

    @cached_property
    def _admitted(self) -> float:
        """The RMSE in N that the data sheet of the force channel admits; 0 where there is none."""
        sheets = {run.name: run.sensors.get("force", {}) for run in self.setting.dataset.runs}
        return error_admitted(sheets, self.pursuit.look.view, self._deciding)

    @property
    def _predicting(self) -> float:
        """The RMSE in N on a run that the model predicts as well as it follows others, channel errors admitted."""
        return float(np.hypot(self._trained, self._admitted))

    @property
    def _attainable(self) -> float:
        """The RMSE in N that another model is known to come to on training runs left out in turn.

        A model that is near the noise has to predict them as well as it follows those that it was fitted to, but for
        what the data sheet of the channel admits; what is farther from it, as well as a general model of the past
        motion.
        """
        known = self._predicting if self._near_floor else self.explainable.left_out
        return np.inf if known is None else max(known, self._floor)

    @property
    def _floor(self) -> float:
        """The RMSE in N below which no model is known to get, 0 where none is known.

        That by which repeats differ, which holds what changes from one test to the next as well: where a general model
        leaves less of runs left out, that.
        """
        known = self.setting.floor.value or 0.0
        return min(known, self.explainable.left_out or known)

    @property
    def _near_floor(self) -> bool:
        return self._trained <= NEAR_FLOOR * max(self._floor, self._admitted)

    @property
    def _leaves_noise(self) -> bool:
        """Whether what is left of runs that took no part in the fit is near the noise as well."""
        return self._unseen <= NEAR_FLOOR * max(self._floor, self._admitted)

    @property
    def _beyond_noise(self) -> bool:
        """Whether the error is far more than what repeated runs differ by, or the data sheet admits."""
        return self.setting.floor.source == "repeats" and not self._near_floor

    @property
    def _at_floor(self) -> bool:
        """Whether the error is within the noise floor; of the other runs, where what is left follows a single one."""
        alone = self.leftover.run
        floor = floor_of_corrected(self.setting, self.accused, alone).value if alone else self._floor
        return self._trained <= (1.0 + self.relevance) * (floor or 0.0)

    @cached_property
    def explainable(self) -> Explainable:
        """What a general model of the past motion leaves, taught by the runs as the corrected dataset has them.

        Trees are grown only where the model is far from what repeats differ by.
        """
        far = self._trained > NEAR_FLOOR * (self.setting.floor.value or 0.0)
        found = explainable_error(self.after_setting, self.seed, far)
        give_back_memory()  # of the trees
        return found

    @property
    def fails_held_out(self) -> bool:
        """Whether held-out runs are predicted far worse than training runs, and than a general model predicts them.

        That model is taught by the same runs. This is judged when all else is decided: it changes what is told of the
        files, never the files.
        """
        theirs, mine = self.explainable.held_out, self.after.held_out
        if theirs is None or mine is None:
            return False
        return mine > (1.0 + FORM_ERROR) * max(theirs, self._predicting, self._floor)

    @property
    def remarks(self) -> list[str]:
        """What the report says of the data and the search; a fault that only a held-out run has stands here alone."""
        errors = self.after.per_run
        worst = max(errors[run.name] for run in self._deciding)
        alone = [
            f"The held-out run '{run}' has an RMSE of {errors[run]:.3g} N, those that were fitted {worst:.3g} N at "
            "most: it has a fault, or was made under conditions that these do not have. It decided nothing."
            for run in self.setting.split.held_out
            if errors[run] > ALONE * worst
        ]
        names = ", ".join(f"'{name}'" for name in self.spare)
        spare = [
            f"Of the diagnosed network {names} may go, and the written one does without: all else refitted, nothing is "
            "predicted worse."
        ]
        departs = [departure_in_words(self.apart, self.leftover)] if self.apart else []
        return [*self.triage.remarks, *departs, *spare * bool(self.spare), *alone, *self._on_held_out()]

    def _on_held_out(self) -> list[str]:
        theirs, mine = self.explainable.held_out, self.after.held_out
        if not self.fails_held_out:
            return []
        return [
            f"On held-out runs the files leave {mine:.3g} N, a general model of the past motion {theirs:.3g} N: what "
            "was found in the training runs does not hold there."
        ]

    def residuals(self, network: NetworkSpec, setting: Setting) -> dict[str, Array]:
        """Measured minus simulated force (n,) of every run, warm-up included."""
        runs = list(setting.scored.values())
        objective = as_simulated(network, runs, self.jobs)
        forces = objective.forces(objective.network.start)
        return {run.name: run.force - force[0] for run, force in zip(runs, forces, strict=True)}

    @cached_property
    def misfit(self) -> tuple[Misfit, ...]:
        """What the diagnosed network gets wrong on the training runs."""
        runs = [run for run in self.setting.dataset.runs if run.name in self.setting.split.train]
        return tuple(describe_misfit(runs, self.residuals(self.written_before, self.setting)))
