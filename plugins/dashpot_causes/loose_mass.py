"""A mass that is not held fast: it rattles in a clearance or slides."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from itertools import product

import numpy as np

from dashpot.contract.cause import NOTHING, Cause, Pair, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {"mass": "kg", "stiffness": "N/m", "gap": "m", "loss": "s/m", "limit": "N", "damping": "N*s/m"}
FREQUENCIES = (1.5, 4.0)  # of the contact, over the end of the driven band
GAPS = (0.02, 0.1, 0.4)  # of half the stroke
LIMITS = (0.1, 0.3, 0.8)  # of the force that would carry the mass along
SAMPLED = 0.1  # of the sampling rate: contacts that ring faster cannot be followed
LOSS = 0.3  # over the speed: of the contact
RATIO = 0.1  # damping ratio beside the slider


class LooseMass(Cause):
    """A mass behind play or behind a slider: it is left behind, struck or dragged along, and rings."""

    word = "loose_mass"
    kind = "specimen"
    about = "a mass that rattles or slides"
    shows = "short bursts of a high frequency after each reversal, above a level of acceleration only"
    confused_with = {
        "resonance": "a smaller amplitude: a resonance stays, a mass that sticks or is not reached shows nothing more",
        "clearance": "the same motion slower: play shows at any speed, a mass only where it is accelerated",
        "moving_mass": "a smaller amplitude: a mass that is held fast stays in proportion to the acceleration",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A mass in a clearance over plays and frequencies of the contact; a mass behind a slider over limits and
        frequencies.
        """
        fastest = SAMPLED / view.dt
        bands = sorted({min(share * view.highest_frequency, fastest) for share in FREQUENCIES})
        plays = [(share * 0.5 * view.stroke, band) for share, band in product(GAPS, bands)]
        yield _form(
            "rattles in a clearance",
            "rattling_mass",
            plays,
            _rattling(view.speed),
            3,
            {"gap": (0.0, 0.5 * view.stroke)},
        )
        swing = view.speed * 2.0 * np.pi * view.highest_frequency
        slides = [(share * swing, band) for share, band in product(LIMITS, bands)]
        yield _form("slides", "sliding_mass", slides, _sliding, 3)


def _rattling(speed: float) -> Callable[[float, float, float], Mapping[str, float]]:
    return lambda mass, gap, band: {"mass": mass, "stiffness": _stiffness(mass, band), "gap": gap, "loss": LOSS / speed}


def _sliding(mass: float, acceleration: float, band: float) -> Mapping[str, float]:
    stiffness = _stiffness(mass, band)
    return {
        "mass": mass,
        "stiffness": stiffness,
        "limit": mass * acceleration,
        "damping": 2.0 * RATIO * np.sqrt(stiffness * mass),
    }


def _stiffness(mass: float, band: float) -> float:
    return mass * (2.0 * np.pi * band) ** 2


def _form(
    form: str,
    element: str,
    places: list[Pair],
    values: Callable[[float, float, float], Mapping[str, float]],
    unknowns: int,
    bounds: Mapping[str, Pair] = NOTHING,
) -> Suspect:
    suspect = added_branch(
        element,
        "loose_mass",
        tuple(float(number) for number in range(len(places))),
        lambda mass, number: values(mass, *places[int(number)]),
        UNITS,
        unknowns=unknowns,
        bounds=bounds,
        form=form,
    )
    return replace(suspect, quantity="mass", unit="kg")
