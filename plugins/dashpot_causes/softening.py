"""Stiffness that falls while the specimen warms up."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, added_branch, branch_lines, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot_causes.session import MOVED, kept_of_runs_before, left_of_runs_before, room_of

Array = NDArray[np.float64]
Place = Mapping[str, float]
UNITS = {
    "stiffness": "N/m",
    "speed": "m/s",
    "time": "s",
    "exponent": "1",
    "kept": "1",
}
SPEEDS = (0.3, 3.0)  # of the largest speed
TIMES = (0.1, 0.4, 1.6)  # of the length of a run
KEPT = (0.1, 0.3, 0.9)  # of the warmth at the next run


class Softening(Cause):
    """A part of the stiffness that warmth takes away, and warmth comes from the motion."""

    word = "softening"
    kind = "specimen"
    about = "softening by warming up"
    shows = "stiffness and loss fall slowly over the run, more so at large amplitude and frequency, and recover at rest"
    confused_with = {
        "bedding_in": "repeat the run after a rest: warmth is gone, bedding-in is not",
        "creep": "a dwell at rest: creep goes on, warming does not",
        "gain": "repeat the run after a rest: a gain does not fade over the run",
        "amplitude_softening": "the amplitude ladder up and down again: warming lags behind, amplitude does not",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A spring that its own motion softens, over speeds and times of warming; one with a free law of warmth; one
        of such a law that is still warm of the runs before.

        Another one softens with time, however it moves.
        """
        places = [{"speed": speed * view.speed, "time": time * view.duration} for speed, time in product(SPEEDS, TIMES)]
        free = [place | {"exponent": 1.0} for place in places]
        yield _softening(places)
        yield _softening(free, "softening with a free law of warmth")
        if any(view.settings(run).get(MOVED, 0.0) > 0.0 for run in view.runs):
            yield _still_warm([place | {"kept": kept} for place, kept in product(free, KEPT)])
        yield added_branch(
            "fading_spring",
            "softening",
            tuple(time * view.duration for time in TIMES),
            lambda k, time: {"stiffness": k, "time": time},
            UNITS,
        )


def _softening(places: Sequence[Place], form: str = "") -> Suspect:
    return added_branch(
        "softening",
        "softening",
        tuple(float(number) for number in range(len(places))),
        lambda k, number: {"stiffness": k, **places[int(number)]},
        UNITS,
        unknowns=len(places[0]),
        form=form,
    )


def _still_warm(places: Sequence[Place]) -> Suspect:
    """A softening spring with what is kept of the warmth of all runs before."""
    ends = room_of([place["time"] for place in places])

    def columns(view: View, run: str) -> Array:
        settings = view.settings(run)
        left = [left_of_runs_before(settings, MOVED, place["kept"]) for place in places]
        values = [{"stiffness": 1.0, **place, "before": before} for place, before in zip(places, left, strict=True)]
        return view.respond(run, "softening", values)

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        k, number = atoms[0]
        place = places[int(number)]
        values = {"stiffness": k, **place}
        lines = branch_lines(free_name(text, "softening"), "softening", values, UNITS, bounds={"time": ends})
        return add_branch(text, f"{lines}\n  before: {kept_of_runs_before(MOVED, 'm^2/s', place['kept'])}")

    cold = _softening(places, "softening from run to run")
    return replace(cold, columns=columns, extend=extend, unknowns=cold.unknowns + 1)
