"""The least phase angle between a platform and the contact force of the wheel on it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.metric import Metric
from dashpot.data.run import Run
from dashpot_metrics.contact_force import is_inspection
from dashpot_metrics.periods import least_angle, periods_of

Array = NDArray[np.float64]


class PhaseShift(Metric):
    """The least angle, between 18 and 6 Hz, from the top of the platform to the trough of the contact force.

    The trough is the middle between the falling and the next rising crossing of the static force. At least 35 degrees
    are wanted. The angle is taken from the last top before the trough, however early the force fell; what others read
    is `phase_shift_first_crossings`. After EGEA SPECSUS2018 as it is told in public accounts; the original was not
    seen.
    """

    word, unit = "phase_shift", "deg"

    def measure(self, run: Run) -> float | None:
        """The angle of a falling sweep under a wheel; None too where no period counts."""
        return least_angle(zip(*angles(run), strict=True)) if is_inspection(run) else None


def angles(run: Run) -> tuple[Array, Array]:
    """Frequency (k,) in Hz and phase angle (k,) in degrees of every period that counts."""
    periods = periods_of(run)
    tops, falls, rises = periods.tops, periods.falls, periods.rises
    after = np.searchsorted(rises, falls)
    falls, rises = falls[after < rises.size], rises[after[after < rises.size]]
    found = []
    for trough in 0.5 * (falls + rises):
        last = int(np.searchsorted(tops, trough, side="right")) - 1
        if 0 <= last < tops.size - 1 and periods.counts(tops[last], tops[last + 1]):
            period = tops[last + 1] - tops[last]
            found.append((1.0 / period, 360.0 * (trough - tops[last]) / period))
    return tuple(np.array(found).reshape(-1, 2).T)  # type: ignore[return-value]
