"""What makes a run unusable: holes, too few samples, a motion that never moves."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from dashpot.data.trouble import Trouble

FEWEST_SAMPLES = 16

Where = Callable[[int], str]


def missing_values(name: str, values: np.ndarray, where: Where) -> list[Trouble]:
    """Samples of a channel that are no finite numbers."""
    holes = np.flatnonzero(~np.isfinite(values))
    if not holes.size:
        return []
    more = f", and {holes.size - 1} more" if holes.size > 1 else ""
    message = f"the {name} has no number (empty, NaN or infinite) in {where(int(holes[0]))}{more}"
    return [Trouble(message, "cut a whole piece out with 'rows: [first, last]' or 'start', 'stop'")]


def too_short(count: int) -> list[Trouble]:
    """Fewer samples than anything can be said from."""
    if count >= FEWEST_SAMPLES:
        return []
    return [Trouble(f"it has {count} samples, expected at least {FEWEST_SAMPLES}", "check 'rows', 'start' and 'stop'")]


def no_motion(channels: Mapping[str, np.ndarray]) -> list[Trouble]:
    """No displacement changes at all, though there is one."""
    motions = [values for name, values in channels.items() if name.partition("@")[0] == "displacement"]
    if not motions or any(np.ptp(values) > 0 for values in motions):
        return []
    return [Trouble(f"its displacement is {motions[0][0]:.6g} m all the time", "check the column of the displacement")]


def dead_force(channels: Mapping[str, np.ndarray]) -> list[Trouble]:
    """A force that never changes: worth a warning."""
    return [
        Trouble(f"its {name} is {values[0]:.6g} N all the time", "check the column of the force", severity="warning")
        for name, values in channels.items()
        if name.partition("@")[0] == "force" and np.ptp(values) == 0
    ]
