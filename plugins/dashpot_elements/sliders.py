"""Springs in parallel, each behind a slider: what rate-independent laws with a spectrum of yield travels share."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dashpot.model.element import Motion, Response, State


def stretches(count: int) -> tuple[State, ...]:
    """The states of so many springs."""
    return tuple(State("m", f"stretch of spring {number}") for number in range(1, count + 1))


def slide(x: Motion, z: Any, stiffnesses: Sequence[Any], travels: Sequence[Any]) -> Response:
    """Every spring takes the travel up to its yield travel."""
    force, found = 0.0, {}
    for number, (stiffness, travel) in enumerate(zip(stiffnesses, travels, strict=True), 1):
        stretch = np.minimum(np.maximum(getattr(z, f"stretch_{number}") + x.travel, -travel), travel)
        force, found[f"stretch_{number}"] = force + stiffness * stretch, stretch
    return Response(force, **found)


def energy(z: Any, stiffnesses: Sequence[Any]) -> Any:
    """The energy of all springs."""
    stretched = [getattr(z, f"stretch_{number}") for number in range(1, len(stiffnesses) + 1)]
    return 0.5 * sum(k * stretch * stretch for k, stretch in zip(stiffnesses, stretched, strict=True))
