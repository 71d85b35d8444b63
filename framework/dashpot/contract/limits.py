"""What a rig can do at most."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Annotated


@dataclass(frozen=True)
class Limits:
    """What a rig can do at most; what is left out has no limit.

    stroke: from the lowest to the highest place; speed: of the actuator; force: of either sign; bandwidth: of the
    servo, the frequency at which it follows with 1/sqrt(2) of the amplitude and 45 degrees late.
    """

    stroke: Annotated[float, "m"] = math.inf
    speed: Annotated[float, "m/s"] = math.inf
    force: Annotated[float, "N"] = math.inf
    bandwidth: Annotated[float, "Hz"] = math.inf

    def __post_init__(self) -> None:
        if min(getattr(self, each.name) for each in fields(self)) <= 0.0:
            raise ValueError("stroke, speed, force and bandwidth: expected more than 0")
