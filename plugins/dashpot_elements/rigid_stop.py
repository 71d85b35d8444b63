"""Stops that do not give way."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol

OUT_OF_REACH = 1e3


class RigidStop(Element):
    """Rigid stops at two places that hold any force: F = 0 for rebound < x < compression.

    A mass that hits one stays there, without rebound, until a force pulls it off; its energy is lost at once. The
    impulse is no force and shows in none. With ``compression: 0 mm`` it is a rigid contact that may lift off. The
    rebound stop is out of reach unless it is given. Something else must give way: a spring in series, or a mass.
    """

    picture = Symbol.PLAY
    source = "Moreau, in Nonsmooth Mechanics and Applications, CISM 302 (1988), for the inelastic impact"

    compression = Parameter(
        "m",
        "deflection at which the compression stop is touched",
        bounds=(0.0, OUT_OF_REACH),
        scale="linear",
        symbol="x_c",
    )
    rebound = Parameter(
        "m",
        "deflection at which the rebound stop is touched",
        bounds=(-OUT_OF_REACH, 0.0),
        scale="linear",
        symbol="x_r",
        default=-OUT_OF_REACH,
    )
    rigidity = Parameter(
        "N/m",
        "force over how far it gives way: with 1e14 N/m 1 kN presses it in by 0.01 nm",
        bounds=(1e12, 1e16),
        symbol="k_r",
        default=1e14,
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """What it takes to hold the ends at the stop that they are beyond."""
        return Response(p.rigidity * (np.maximum(x.new - p.compression, 0.0) - np.maximum(p.rebound - x.new, 0.0)))

    def stops(self, p: Any) -> tuple[Any, Any]:
        """The two places."""
        return p.rebound, p.compression
