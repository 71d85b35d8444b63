"""A shock absorber with separate valves for both directions."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class AsymmetricDamper(Element):
    """A dashpot with its own damping in compression (v > 0) and rebound: F = damping v/(1 + digression |v|).

    With a digression of 0 both branches are straight lines. Otherwise 1/digression is the knee velocity, at which the
    force is half of that of the straight line, and damping/digression the force that it approaches.
    """

    picture = Symbol.DASHPOT

    compression = Parameter("N*s/m", "damping in compression", bounds=(1e-2, 1e7), symbol="d_c")
    rebound = Parameter("N*s/m", "damping in rebound", bounds=(1e-2, 1e7), symbol="d_r")
    compression_digression = Parameter("s/m", "one over the knee velocity in compression", bounds=(0.0, 1e3),
                                       scale="linear", symbol="g_c", default=0.0)  # fmt: skip
    rebound_digression = Parameter("s/m", "one over the knee velocity in rebound", bounds=(0.0, 1e3), scale="linear",
                                   symbol="g_r", default=0.0)  # fmt: skip

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The branch of the velocity at the end of the step."""
        inward, outward = np.maximum(x.velocity_new, 0.0), np.minimum(x.velocity_new, 0.0)
        compression = p.compression * inward / (1.0 + p.compression_digression * inward)
        return Response(compression + p.rebound * outward / (1.0 - p.rebound_digression * outward))
