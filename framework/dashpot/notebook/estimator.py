"""A model as an estimator of scikit-learn: cross-validation and grid search by its tools, over runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.objective import Objective
from dashpot.fit.scored import weighted
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.notebook.verbs import fit as fit_model

try:
    from sklearn.base import BaseEstimator, RegressorMixin
except ImportError:
    raise ImportError(
        "expected scikit-learn for an estimator, it is not installed: pip install 'dashpot[boosting]'"
    ) from None


class Estimator(RegressorMixin, BaseEstimator):
    """A model with ``fit``, ``predict`` and ``score`` as scikit-learn knows them. A sample is a whole run, X a list of
    runs; y is not used, since a run holds its force.

    ``model`` is a network, its file or its shipped name; the other arguments are those of ``dp.fit``. All runs handed
    to ``fit`` are trained on: the tools of scikit-learn decide on the hold-out; with ``groups=data.groups`` a run
    and its repeats stay together. ImportError without scikit-learn.

    Examples:
        >>> from sklearn.model_selection import GroupKFold, cross_val_score
        >>> scores = cross_val_score(dp.Estimator("mount.yaml"), data.runs, groups=data.groups, cv=GroupKFold(2))
        >>> scores.shape, bool(scores.min() > 0.9)
        ((2,), True)
    """

    def __init__(
        self,
        model: NetworkSpec | str | Path,
        *,
        optimizer: str | None = None,
        options: Mapping[str, Any] | None = None,
        seed: int = 0,
    ) -> None:
        self.model, self.optimizer, self.options, self.seed = model, optimizer, options, seed

    def fit(self, X: Sequence[Run] | Dataset, y: None = None) -> Estimator:  # noqa: N803
        """Identify the model on these runs; ``fit_`` is the result, see ``dp.fit``."""
        runs = tuple(replace(run, held_out=False) for run in _runs(X))
        self.fit_ = fit_model(
            self.model, Dataset("runs", runs), optimizer=self.optimizer, options=self.options, seed=self.seed
        )
        return self

    def predict(self, X: Sequence[Run] | Dataset) -> list[NDArray[np.float64]]:  # noqa: N803
        """The force (n,) in N of each run."""
        return list(self.fit_.predict(Dataset("runs", _runs(X))).values())

    def score(self, X: Sequence[Run] | Dataset, y: None = None) -> float:  # noqa: N803
        """The coefficient of determination R^2: 1 minus the squares of the residuals over those about the mean of each
        run, both after the warm-up, summed over all runs."""
        scored = weighted(_runs(X))
        network = compile_network(self.fit_.fitted)
        misfit = Objective(network, scored).misfits(network.start)
        spread = sum(float(np.var(run.force[run.first :]) * run.samples) for run in scored)
        return 1.0 - float(np.sum(misfit**2)) / spread


def _runs(runs: Sequence[Run] | Dataset) -> tuple[Run, ...]:
    return runs.runs if isinstance(runs, Dataset) else tuple(runs)
