"""What a finding will be worth on runs that took no part, told before any refit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from dashpot.assess.contest import Bench
from dashpot.assess.screen import Finding
from dashpot.assess.suspicion import Look, expected_gain
from dashpot.fit.scored import ScoredRun


def foreseen_gain(bench: Bench, held_out: Sequence[ScoredRun], finding: Finding, look: Look) -> float:
    """1 - RMSE after / RMSE before on held-out runs, if the finding is true and the model's numbers make room for it.

    Nothing but the motion of these runs and the size of their present error is used. What acts in single runs only, or
    inside a network, is foreseen for the training runs; so is everything where the sensors of these runs may err.
    """
    candidate = finding.candidate
    erring = any(bench.sensors.get(run.name) for run in held_out)
    if not held_out or erring or candidate.suspect.local or candidate.site is not None:
        return expected_gain(look.columns, finding)
    residual, tangents = replace(bench, runs=held_out, unseen=()).linearise(look.model)
    view, present, explained = bench.view(look.model), 0.0, 0.0
    strengths = np.zeros(len(candidate.suspect.grid))
    strengths[list(finding.chosen)] = finding.strengths
    for run in held_out:
        added = strengths @ np.atleast_2d(candidate.suspect.columns(view, run.name))[:, run.first :]
        change = added + finding.moves @ tangents[run.name]
        present += float(np.mean(residual[run.name] ** 2))
        explained += float(np.mean(change**2))
    return float(1.0 - np.sqrt(max(1.0 - explained / present, 0.0))) if present > 0.0 else 0.0
