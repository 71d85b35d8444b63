"""Creep after a preload was set."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {"stiffness": "N/m", "shortest": "s", "decades": "1"}
PLACES = 4
LASTS = 10.0  # times the length of a run


class Creep(Cause):
    """The force falls with the logarithm of the time since the preload was set at the begin of the run."""

    word = "creep"
    kind = "specimen"
    about = "creep"
    shows = "the mean force falls with the logarithm of time after each change of preload, in proportion to it"
    confused_with = {
        "relaxation": "a dwell of some minutes: relaxation comes to an end within the run, creep does not",
        "drift": "a dwell after a step up and one after a step down: creep changes its sign, drift does not",
        "softening": "a dwell at rest: creep goes on, warming does not",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A fall per decade of time that begins at one of some times: of every change of deflection, or of the preload
        alone with which the run begins.
        """
        begins = tuple(np.geomspace(2.0 * view.dt, 0.2 * view.duration, PLACES))
        end = LASTS * view.duration
        yield added_branch(
            "creep",
            "creep",
            begins,
            lambda slope, begin: {"stiffness": slope, "shortest": begin, "decades": min(np.log10(end / begin), 6.0)},
            UNITS,
            fixed=("decades",),
        )
        yield added_branch(
            "preload_creep",
            "creep",
            begins,
            lambda slope, begin: {"stiffness": slope, "shortest": begin},
            UNITS,
        )
