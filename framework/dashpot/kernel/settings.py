"""Numbers of a network that a run gives by its settings."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]


def with_settings(spec: NetworkSpec, lanes: Array, settings: Mapping[str, float]) -> Array:
    """The lanes (lanes, slots) with the numbers that the run itself gives."""
    given = {number: settings[slot.value.setting] for number, slot in enumerate(spec.slots())
             if slot.value.setting in settings}  # fmt: skip
    if not given:
        return lanes
    own = lanes.copy()
    own[:, list(given)] = list(given.values())
    return own
