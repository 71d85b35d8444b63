"""A shock absorber with separate valves for both directions."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol

REST = 1e-3


class AsymmetricDamper(Element):
    """A dashpot with its own law in compression and rebound: F = damping v r^(exponent - 1)/(1 + digression |v|).

    Here r = |v|/reference, and v > 0 is compression.

    With a digression of 0 and an exponent of 1 both branches are straight lines. With an exponent of 1, 1/digression is
    the knee velocity, at which the force is half of that of the straight line, and damping/digression the force that it
    approaches. With another exponent the damping is that at the reference velocity; below a thousandth of it the branch
    goes over into a straight line through zero, so that its slope is finite at rest.
    """

    picture = Symbol.DASHPOT

    compression = Parameter("N*s/m", "damping in compression", bounds=(1e-4, 1e11), symbol="d_c")
    rebound = Parameter("N*s/m", "damping in rebound", bounds=(1e-4, 1e11), symbol="d_r")
    compression_digression = Parameter(
        "s/m", "one over the knee velocity in compression", bounds=(0.0, 1e8), scale="linear", symbol="g_c", default=0.0
    )
    rebound_digression = Parameter(
        "s/m", "one over the knee velocity in rebound", bounds=(0.0, 1e8), scale="linear", symbol="g_r", default=0.0
    )
    compression_exponent = Parameter(
        "1", "power of the velocity in compression", bounds=(0.05, 4.0), scale="linear", symbol="n_c", default=1.0
    )
    rebound_exponent = Parameter(
        "1", "power of the velocity in rebound", bounds=(0.05, 4.0), scale="linear", symbol="n_r", default=1.0
    )
    reference = Parameter(
        "m/s", "velocity at which the dampings are given", bounds=(1e-8, 1e3), symbol="v_r", default=0.1
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The branch of the velocity at the end of the step."""
        inward, outward = np.maximum(x.velocity_new, 0.0), np.minimum(x.velocity_new, 0.0)
        square = (x.velocity_new / p.reference) ** 2 + REST * REST
        compression = p.compression * inward * square ** (0.5 * (p.compression_exponent - 1.0))
        rebound = p.rebound * outward * square ** (0.5 * (p.rebound_exponent - 1.0))
        return Response(
            compression / (1.0 + p.compression_digression * inward) + rebound / (1.0 - p.rebound_digression * outward)
        )
