"""Stress relaxation that the network lacks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec
from dashpot_causes.along_curves import relaxing

UNITS = {"stiffness": "N/m", "relaxation_time": "s"}
SPRINGPOT_UNITS = {"stiffness": "N/m", "order": "1", "reference": "Hz", "lowest": "Hz", "decades": "1", "dwell": "s"}
PLACES = 18
ORDERS = (0.1, 0.2, 0.35, 0.5)
WIDEST_ORDER = (0.03, 0.9)
LARGEST_ORDER = 0.55  # a dashpot has its share in more
MOST_DECADES = 8.0
DWELL = 30.0  # s
DWELLS = (0.1, 1e4)
SLOW, FAST = 0.1, 3.0  # over the length of a run, times the end of the band: the range of a springpot
MOST = 3
FASTEST = 0.5  # over the angular frequency at the end of the measured band: what relaxes faster is a dashpot


class Relaxation(Cause):
    """Maxwell branches of one or several relaxation times, or of very many: a springpot."""

    word = "relaxation"
    kind = "specimen"
    about = "relaxation (dynamic stiffening)"
    shows = "storage stiffness rises with frequency and loss stiffness has a broad maximum, alike at every amplitude"
    confused_with = {
        "friction": "an amplitude ladder at one frequency: friction softens with amplitude, relaxation does not",
        "delay": "a known steel spring on the same channels: a delay stays",
        "viscous_damping": "a sweep to higher frequency: the loss stiffness of relaxation falls off again",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Maxwell branches on a logarithmic grid of relaxation times; a springpot over the measured band; where the
        network has a spring with a curve, a force that relaxes along it.
        """
        grid = np.geomspace(2.0 * view.dt, 0.3 * view.duration, PLACES)
        fastest = FASTEST / (2.0 * np.pi * view.highest_frequency)

        def relaxes(found: Mapping[str, float]) -> bool:
            return all(time > fastest for name, time in found.items() if name.startswith("relaxation_time"))

        yield added_branch(
            "maxwell",
            "relaxation",
            tuple(grid),
            lambda k, time: {"stiffness": k, "relaxation_time": time},
            UNITS,
            most=MOST,
            admits=relaxes,
        )
        lowest = SLOW / view.duration
        decades = float(np.log10(FAST * view.highest_frequency / lowest))
        if decades > 1.0:
            yield _springpot(lowest, min(decades, MOST_DECADES))
        yield from relaxing(view, network, fastest)


def _springpot(lowest: float, decades: float) -> Suspect:
    known = {"reference": lowest * 10.0 ** (0.5 * decades), "lowest": lowest, "decades": decades}
    return added_branch(
        "springpot",
        "relaxation",
        ORDERS,
        lambda stiffness, order: {"stiffness": stiffness, "order": order, **known, "dwell": DWELL},
        SPRINGPOT_UNITS,
        fixed=tuple(known),
        unknowns=2,
        bounds={"order": WIDEST_ORDER, "dwell": DWELLS},
        admits=lambda found: found["order"] < LARGEST_ORDER,
    )
