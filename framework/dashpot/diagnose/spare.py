"""Branches of the diagnosed network that may go: without them, all else refitted, nothing is predicted worse."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from dashpot.diagnose.look import Look, look_at
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.score import NUMBER_ODDS, Scores, nats
from dashpot.diagnose.term import Model
from dashpot.model.network import Branch, NetworkSpec
from dashpot.text.problem import InputError


def spare_branches(refitter: Refitter, look: Look, model: Model) -> list[str]:
    """The parallel branches of the base that may go together from a fitted model, by backward elimination.

    The last one first. One may go where the removal costs less of the predictive likelihood than the prior odds of its
    numbers.
    """
    present, found = _minus_log_likelihood(refitter, look, model), []
    for branch in reversed(_branches(model.base)):
        if len(model.fitted.root.members) == 1:
            break  # a network has a branch
        searched = sum(path.startswith(f"{branch}.") for path in model.coordinates.paths)
        with suppress(InputError):  # another branch asks for it
            less = refitter.refit_without(model, branch, look.noise)
            cost = _minus_log_likelihood(refitter, look, less)
            if searched and cost - present < -searched * np.log(NUMBER_ODDS):
                model, present = less, cost
                found.append(branch)
    return found[::-1]


def _branches(network: NetworkSpec) -> Sequence[str]:
    """The branches of a network with two ends, if there is more than one; those in groups stay."""
    members = [member.name for member in network.root.members if isinstance(member, Branch)]
    return members if len(network.root.members) > 1 and not network.joints else []


def _minus_log_likelihood(refitter: Refitter, look: Look, model: Model) -> float:
    seen = look_at(refitter, replace(model, terms=(), owned=()), (), look.folds, look.noise)
    return float(nats(Scores(seen).exact(), seen.samples))
