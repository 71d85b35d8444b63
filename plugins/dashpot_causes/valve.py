"""Damping whose slope falls at a knee: a valve that opens."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from itertools import product

import numpy as np

from dashpot.contract.cause import Cause, Pair, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

SIDES = ("compression", "rebound")
UNITS = {
    **{
        side + key: unit
        for side in SIDES
        for key, unit in (("", "N*s/m"), ("_knee", "m/s"), ("_opened", "N*s/m"), ("_digression", "s/m"))
    },
    "stiffness": "N/m",
    "sharpness": "1",
}
KNEES = (0.02, 0.06, 0.2, 0.6)  # of the largest speed
RATIOS = (0.5, 1.0, 2.0)  # damping in compression over that in rebound
TIMES = (0.02, 0.1, 0.5)  # of 1/w at the end of the band: the lag of the force
SHARP = 4.0  # how sharply a blow-off opens
KNEE, SHARPEST = (1e-8, 1e3), 1e8  # m/s and s/m: the ranges of the elements
SERIES: dict[str, Pair] = {"stiffness": (1.0, 1e10)}
OPENS = 0.015  # of the largest speed, at least: a force that is flat beyond a lower knee is dry friction's


class Valve(Cause):
    """A dashpot that is steep at low speed and flat beyond a knee, in both directions; with oil that gives way."""

    word = "valve"
    kind = "specimen"
    about = "a valve that opens (digressive or blow-off damping)"
    shows = "force over velocity is steep at first and flat beyond a knee; with compliance it opens to a loop there"
    confused_with = {
        "friction": "a slow triangle: the force of a valve disappears, that of friction stays",
        "power_law_damping": "speeds far below and far above the knee: both ends of a valve are straight",
        "asymmetric_damping": "the same speeds in both directions: a valve bends in both",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A digressive curve with a knee in both directions; a sharp blow-off; both behind a spring that lets the
        force lag, over knees, asymmetries and lags.
        """
        least = OPENS * view.speed
        bends: dict[str, Pair] = {f"{side}_digression": (0.0, min(1.0 / least, SHARPEST)) for side in SIDES}
        knees: dict[str, Pair] = {f"{side}_knee": (max(least, KNEE[0]), KNEE[1]) for side in SIDES} | SERIES
        yield _form(view, "a knee in both directions", "asymmetric_damper", _digressive, (0.0,), 3, bends)
        band = 2.0 * np.pi * view.highest_frequency
        lags = tuple(share / band for share in TIMES)
        yield _form(view, "a knee behind a spring", "valve", _lagging, lags, 5, knees)
        yield _form(view, "a sharp blow-off behind a spring", "valve", _sharp, lags, 6, knees)


def _form(
    view: View,
    form: str,
    element: str,
    values: Callable[..., Mapping[str, float]],
    lags: tuple[float, ...],
    unknowns: int,
    bounds: Mapping[str, Pair],
) -> Suspect:
    places = [(knee * view.speed, ratio, lag) for knee, ratio, lag in product(KNEES, RATIOS, lags)]
    suspect = added_branch(
        element,
        "valve",
        tuple(float(number) for number in range(len(places))),
        lambda damping, number: values(damping, *places[int(number)]),
        UNITS,
        unknowns=unknowns,
        bounds=bounds,
        form=form,
    )
    return replace(suspect, quantity="damping", unit="N*s/m")


def _digressive(damping: float, knee: float, ratio: float, _: float) -> Mapping[str, float]:
    return {
        "compression": damping,
        "rebound": damping / ratio,
        "compression_digression": 1.0 / knee,
        "rebound_digression": 1.0 / knee,
    }


def _lagging(damping: float, knee: float, ratio: float, lag: float) -> Mapping[str, float]:
    return {
        "compression": damping,
        "rebound": damping / ratio,
        "compression_knee": knee,
        "rebound_knee": knee,
        "stiffness": damping / lag,
    }


def _sharp(damping: float, knee: float, ratio: float, lag: float) -> Mapping[str, float]:
    opened = {f"{side}_opened": 0.1 * damping / (ratio if side == "rebound" else 1.0) for side in SIDES}
    return {**_lagging(damping, knee, ratio, lag), **opened, "sharpness": SHARP}
