"""A pitfall: the phase angle between platform and contact force, read from the first crossings of each period."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dashpot.contract.metric import Metric
from dashpot.data.run import Run
from dashpot_metrics.contact_force import is_inspection
from dashpot_metrics.periods import least_angle, periods_of


class FirstCrossings(Metric):
    """A pitfall: the phase shift read from the first two crossings after each top, which passes every car.

    Below 90 degrees the force falls through its static value before the platform is at its top. The first two crossings
    after the top are then a rising and a falling one. Their middle is the crest in place of the trough, half a period
    behind it, and 180 degrees less the angle is read. Programs that are public read it so. Only a sensitivity study
    that names it has it.
    """

    word, unit, everywhere = "phase_shift_first_crossings", "deg", False

    def measure(self, run: Run) -> float | None:
        """What is read from a falling sweep under a wheel; None too where no period counts."""
        return least_angle(first_crossings(run)) if is_inspection(run) else None


def first_crossings(run: Run) -> Iterator[tuple[float, float]]:
    """Frequency in Hz and angle in degrees of every period that counts and has two crossings."""
    periods = periods_of(run)
    crossings = np.sort(np.concatenate([periods.falls, periods.rises]))
    for start, stop in periods.whole():
        first = int(np.searchsorted(crossings, start))
        inside = crossings[first : first + 2]
        if inside.size == 2 and inside[1] < stop:
            angle = 360.0 * (float(inside.mean()) - start) / (stop - start)
            yield 1.0 / (stop - start), min(angle, 360.0 - angle)
