"""Damping that fades for good within a run."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {"damping": "N*s/m", "time": "s", "work": "J"}
TIMES = (0.1, 0.3, 1.0, 3.0)  # of the length of a run
LOSSES = (0.3, 1.0, 3.0, 10.0)  # exponent of the loss in the run in which most is moved, if nothing were lost


class FadingDamping(Cause):
    """A part of the damping that is lost with time, or with the work that it has taken up."""

    word = "fading_damping"
    kind = "specimen"
    about = "damping that fades"
    shows = "loss stiffness falls over the run, storage stiffness does not; every run begins anew"
    confused_with = {
        "heating": "a rest between two runs: what was warm recovers, what faded for good does not",
        "viscous_damping": "the beginning and the end of one long run apart: the loss is another one",
        "softening": "a spring softens in storage stiffness, a damper that fades in loss",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A dashpot that fades over times; one that fades with work over losses."""
        yield added_branch(
            "fading_damper",
            "fading_damping",
            tuple(share * view.duration for share in TIMES),
            lambda damping, time: {"damping": damping, "time": time},
            UNITS,
            form="with time",
        )
        moved = max(float(np.sum(np.square(view.velocity(run)))) * view.step(run) for run in view.runs)
        yield added_branch(
            "worn_damper",
            "fading_damping",
            LOSSES,
            lambda damping, loss: {"damping": damping, "work": damping * moved / loss},
            UNITS,
            form="with work",
        )
