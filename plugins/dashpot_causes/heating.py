"""Stiffness and damping that fall by the heat of the damping."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, added_branch, branch_lines, free_name
from dashpot.model.network import Branch, NetworkSpec
from dashpot.model.patch import add_branch
from dashpot_causes.session import MOVED, goes_by_heat, kept_of_runs_before, left_of_runs_before, room_of
from dashpot_causes.setting_dependence import changed, numbers_of
from dashpot_causes.settings import session_of

Array = NDArray[np.float64]
UNITS = {"stiffness": "N/m", "damping": "N*s/m", "power": "W", "time": "s", "ratio": "1", "share": "1"}
WARMTHS = (0.3, 1.0, 3.0)  # of the fastest run in the end, in powers of two of the damping
TIMES = (0.1, 0.4, 1.6)  # of the length of a run
SPRINGS = (0.0, 1.0)  # stiffness over damping and angular frequency at the end of the band
KEPT = (0.1, 0.5, 0.9)  # of the heat at the next run
HARDLY = 0.03  # of the stiffness: the force at the end of the band of a dashpot beside a spring that softens


class Heating(Cause):
    """A part of damping and stiffness that the heat of dissipated power takes away, and cooling gives back; within a
    run, or from run to run as they were measured one after the other.
    """

    word = "heating"
    kind = "specimen"
    about = "softening by dissipated heat"
    shows = (
        "loss falls over the run, faster where more power is dissipated, then stays; at rest it recovers. Or stiffness "
        "and loss are less after runs that dissipated more"
    )
    confused_with = {
        "softening": "two runs of one speed and other damping: heat follows the power, not the speed",
        "fading_damping": "a rest between two runs: what was warm recovers, what faded for good does not",
        "session_change": "the runs in another order: heat follows the work of the runs before, and goes at rest",
        "drift": "a fast run after a slow one: a drift does not know how fast the specimen was moved",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A dashpot, alone or beside a spring, that warms up and cools, over powers and times; one that is still warm
        of the runs before, over powers and shares; parameters of such a one over the order of the runs.
        """
        mean_square = max(float(np.mean(np.square(view.velocity(run)))) for run in view.runs)
        band = 2.0 * np.pi * view.highest_frequency
        anew = [
            {"power": mean_square / warmth, "time": part * view.duration} for warmth, part in product(WARMTHS, TIMES)
        ]
        # heat that cools by the same law in a run and in a rest of its length
        warm = [
            {"power": mean_square / warmth, "time": -2.0 * view.duration / float(np.log(kept)), "kept": kept}
            for warmth, kept in product(WARMTHS, KEPT)
        ]
        for share in SPRINGS:
            yield _heated(anew, share, band)
            if any(view.settings(run).get(MOVED, 0.0) > 0.0 for run in view.runs):
                yield _still_warm(warm, share, band)
        numbers = [number for number in numbers_of(network) if _is_still_warm(number.branch)]
        if numbers and (session := session_of(view)):
            yield replace(changed(session, numbers), form="numbers of what is warm from run to run")


def _is_still_warm(branch: Branch) -> bool:
    return branch.element.word == "self_heating" and goes_by_heat(branch)


def _heated(places: Sequence[Mapping[str, float]], share: float, band: float) -> Suspect:
    """A dashpot that warms up, alone or beside a spring, told of a damping of 1 N*s/m; ``band`` is its end in rad/s."""
    stiffness = share * band
    return added_branch(
        "self_heating",
        "heating",
        tuple(float(number) for number in range(len(places))),
        lambda damping, number: _values(damping, places[int(number)], stiffness),
        UNITS,
        unknowns=4 if stiffness else 2,
        admits=lambda numbers: numbers["damping"] * band > HARDLY * _lost(numbers),
        form="a dashpot and a spring that warm up" if stiffness else "a dashpot that warms up",
    )


def _lost(numbers: Mapping[str, float]) -> float:
    """The stiffness in N/m that goes with the first of the heat, in parts of the damping that does: the spring falls
    `ratio` times as fast.
    """
    return numbers.get("ratio", 1.0) * numbers.get("stiffness", 0.0)


def _values(damping: float, place: Mapping[str, float], stiffness: float) -> dict[str, float]:
    found = {"damping": damping, "power": damping * place["power"], "time": place["time"]}
    return found | ({"stiffness": damping * stiffness, "ratio": 1.0} if stiffness else {})


def _still_warm(places: Sequence[Mapping[str, float]], share: float, band: float) -> Suspect:
    """The same with what is kept of the heat of the runs before."""
    cold, stiffness = _heated(places, share, band), share * band
    ends = room_of([place["time"] for place in places])

    def columns(view: View, run: str) -> Array:
        settings = view.settings(run)
        left = [left_of_runs_before(settings, MOVED, place["kept"]) for place in places]
        values = [
            _values(1.0, place, stiffness) | {"before": before, "share": place["kept"]}
            for place, before in zip(places, left, strict=True)
        ]
        return view.respond(run, "self_heating", values)

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        damping, number = atoms[0]
        place = places[int(number)]
        values = _values(damping, place, stiffness) | {"share": place["kept"]}
        lines = branch_lines(free_name(text, "heating"), "self_heating", values, UNITS, bounds={"time": ends})
        return add_branch(text, f"{lines}\n  before: {kept_of_runs_before(MOVED, 'm^2/s', place['kept'])}")

    form = f"{cold.form}, from run to run"
    return replace(cold, form=form, columns=columns, extend=extend, unknowns=cold.unknowns + 2)
