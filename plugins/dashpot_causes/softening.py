"""Stiffness that falls while the specimen warms up."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import product

from dashpot.contract.cause import NOTHING, Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec
from dashpot_causes.session import MOVED

UNITS = {
    "stiffness": "N/m",
    "speed": "m/s",
    "time": "s",
    "exponent": "1",
    "kept": "1",
    "before": "m^2/s",
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
        that is still warm of the run before.

        Another one softens with time, however it moves.
        """
        places = [{"speed": speed * view.speed, "time": time * view.duration} for speed, time in product(SPEEDS, TIMES)]
        yield _softening(places)
        yield _softening([place | {"exponent": 1.0} for place in places], "softening with a free law of warmth")
        if any(view.settings(run).get(MOVED, 0.0) > 0.0 for run in view.runs):
            warm = [place | {"kept": kept} for place, kept in product(places, KEPT)]
            yield _softening(warm, "softening from run to run", {"before": MOVED})
        yield added_branch(
            "fading_spring",
            "softening",
            tuple(time * view.duration for time in TIMES),
            lambda k, time: {"stiffness": k, "time": time},
            UNITS,
        )


def _softening(places: Sequence[Mapping[str, float]], form: str = "", given: Mapping[str, str] = NOTHING) -> Suspect:
    return added_branch(
        "softening",
        "softening",
        tuple(float(number) for number in range(len(places))),
        lambda k, number: {"stiffness": k, **places[int(number)]},
        UNITS,
        unknowns=len(places[0]),
        form=form,
        given=given,
    )
