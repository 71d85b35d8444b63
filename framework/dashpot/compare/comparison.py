"""Several networks on one dataset: the table of root mean square errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dashpot.compare.explainable import Explainable, explainable_error
from dashpot.compare.metrics import metric_rows
from dashpot.compare.provenance import history_of, provenance_of, warnings_of
from dashpot.compare.shapes import shapes_of
from dashpot.compare.signals import signal_evidence
from dashpot.contract.chain import make_optimizer
from dashpot.contract.metric import Metric
from dashpot.contract.registry import Registry
from dashpot.data.dataset import Dataset
from dashpot.fit.api import Progress, Setting, fit_each, prepare, require_training_runs, silent
from dashpot.fit.objective import as_simulated
from dashpot.fit.refine import Outcome
from dashpot.fit.result import FitResult, floor_of, parameters_of
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Comparison:
    """Fitted networks in the order given; ``failures`` tells of those that could not be fitted.

    ``explainable`` is the error that a general model leaves; None where none was asked for. ``metrics`` are told of
    every run that has them.
    """

    setting: Setting
    fits: tuple[FitResult, ...]
    failures: Mapping[str, str]
    seed: int
    explainable: Explainable | None = None
    metrics: tuple[type[Metric], ...] = ()

    @cached_property
    def simulated(self) -> dict[str, dict[str, Array]]:
        """The force (n,) in N of every model in every run, by name."""
        runs = list(self.setting.scored.values())
        found = {}
        for fit in self.fits:
            objective = as_simulated(fit.fitted, runs)
            forces = objective.forces(objective.network.start)
            found[fit.declared.name] = {run.name: force[0] for run, force in zip(runs, forces, strict=True)}
        return found

    def as_dict(self) -> dict[str, Any]:
        """The result as in ``compare.json``; errors in N, ``nrmse`` in units of the standard deviation of the force."""
        dataset = self.setting.dataset
        failed: list[dict[str, Any]] = [
            {"name": name, "parameters": {}, "rmse": None, "nrmse": None, "per_run": {}, "status": reason}
            for name, reason in self.failures.items()
        ]
        return {
            "format": "dashpot-comparison/1",
            "dataset": {
                "name": dataset.name,
                "digest": dataset.digest,
                "runs": [run.name for run in dataset.runs],
                "held_out": list(self.setting.split.held_out),
                "held_out_reason": self.setting.split.reason,
            },
            "noise_floor": floor_of(self.setting.floor),
            **({"explainable": self.explainable.as_dict()} if self.explainable else {}),
            "models": [self._model(fit) for fit in self.fits] + failed,
            "metrics": metric_rows(self.metrics, self.setting.dataset.runs, self.simulated if self.metrics else None),
            "seed": self.seed,
        }

    def evidence(self) -> dict[str, Any]:
        """Arrays and texts for the report: all models in loops and dynamic stiffness."""
        runs_shown, simulated = self.setting.dataset.runs, self.simulated
        residuals = {
            label: {run.name: run.force - forces[run.name] for run in runs_shown} for label, forces in simulated.items()
        }
        return {
            **signal_evidence(runs_shown, residuals),
            "shapes": shapes_of(runs_shown, simulated, self.setting.split.held_out),
            "history": {fit.declared.name: history_of(fit) for fit in self.fits},
            "warnings": warnings_of(self.setting, self.fits),
            "provenance": provenance_of(self.setting, self.seed),
        }

    def _model(self, fit: FitResult) -> dict[str, Any]:
        errors = {"train": fit.errors.train, "held_out": fit.errors.held_out, "all": fit.errors.all}
        spreads = {name: float(np.std(run.force[run.first :])) for name, run in self.setting.scored.items()}
        groups = {"train": self.setting.split.train, "held_out": self.setting.split.held_out, "all": tuple(spreads)}
        relative = {key: _relative(fit, spreads, names) for key, names in groups.items()}
        return {
            "name": fit.declared.name,
            "parameters": parameters_of(fit.fitted),
            "rmse": errors,
            "nrmse": relative,
            "per_run": dict(fit.errors.per_run),
            "identifiability": fit.identifiability,
            "status": "ok" if fit.ending == Outcome.CONVERGED.value else fit.ending,
        }


def compare(
    specs: Sequence[NetworkSpec],
    dataset: Dataset,
    *,
    optimizer: str | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 0,
    jobs: Jobs = 1,
    registry: Registry,
    progress: Progress | None = None,
) -> Comparison:
    """Identify every network on the training runs and judge it on all runs, beside the explainable error.

    A network that cannot be fitted is named with its reason; the others go on. Raises InputError where all runs are
    held out.
    """
    setting = prepare(dataset, seed)
    require_training_runs(setting)
    method = make_optimizer(optimizer, registry.optimizers, options) if optimizer else None
    found = fit_each(specs, setting, method, seed, jobs, progress or silent)
    failures = {spec.name: str(each) for spec, each in zip(specs, found, strict=True) if isinstance(each, InputError)}
    fits = tuple(each for each in found if isinstance(each, FitResult))
    return Comparison(setting, fits, failures, seed, explainable_error(setting, seed), tuple(registry.metrics.values()))


def comparison_of(fit: FitResult) -> Comparison:
    """A fit as the comparison of a single network."""
    return Comparison(prepare(fit.dataset, fit.seed), (fit,), {}, fit.seed)


def _relative(fit: FitResult, spreads: Mapping[str, float], names: Sequence[str]) -> float | None:
    # pooled like the errors: runs weigh the same
    if not names:
        return None
    return float(np.sqrt(np.mean([(fit.errors.per_run[name] / spreads[name]) ** 2 for name in names])))
