"""Stiffness and damping that fall by the heat of the damping."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import product

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec
from dashpot_causes.session import ORDER, order_of
from dashpot_causes.setting_dependence import Setting, changed, has_curved_spring, numbers_of, stiffness_over

UNITS = {"stiffness": "N/m", "damping": "N*s/m", "power": "W", "time": "s", "ratio": "1"}
WARMTHS = (0.3, 1.0, 3.0)  # of the fastest run in the end, in powers of two of the damping
TIMES = (0.1, 0.4, 1.6)  # of the length of a run
SPRINGS = (0.0, 1.0)  # stiffness over damping and angular frequency at the end of the band


class Heating(Cause):
    """A part of damping and stiffness that the heat of dissipated power takes away, and cooling gives back; within a
    run, or from run to run as they were measured one after the other.
    """

    word = "heating"
    kind = "specimen"
    about = "softening by dissipated heat"
    shows = (
        "loss falls over the run, faster where more power is dissipated, then stays; at rest it recovers. Or stiffness "
        "and loss fall from run to run"
    )
    confused_with = {
        "softening": "two runs of one speed and other damping: heat follows the power, not the speed",
        "fading_damping": "a rest between two runs: what was warm recovers, what faded for good does not",
        "drift": "a fast run after a slow one: a drift does not know how fast the specimen was moved",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A dashpot, alone or beside a spring, that warms up and cools, over powers and times; parameters of the
        network over the order of the runs.
        """
        mean_square = max(float(np.mean(np.square(view.velocity(run)))) for run in view.runs)
        band = 2.0 * np.pi * view.highest_frequency
        for share in SPRINGS:
            places = list(product(WARMTHS, [part * view.duration for part in TIMES]))

            def values(
                damping: float, number: float, share: float = share, places: list[tuple[float, float]] = places
            ) -> Mapping[str, float]:
                warmth, time = places[int(number)]
                found = {"damping": damping, "power": damping * mean_square / warmth, "time": time}
                return found | ({"stiffness": share * damping * band} if share else {})

            yield added_branch(
                "self_heating",
                "heating",
                tuple(float(number) for number in range(len(places))),
                values,
                UNITS,
                unknowns=3 if share else 2,
                form="a dashpot and a spring that warm up" if share else "a dashpot that warms up",
            )
        yield from _from_run_to_run(view, network)


def _from_run_to_run(view: View, network: NetworkSpec) -> Iterable[Suspect]:
    places, numbers = order_of(view), list(numbers_of(network))
    if not places:
        return
    order = Setting.of(ORDER, {run: view.settings(run)[ORDER] for run in places})
    if numbers:
        yield replace(changed(order, numbers), form="numbers from run to run", of=())
    if has_curved_spring(network):
        yield replace(stiffness_over(order), form="a stiffness from run to run", of=())
