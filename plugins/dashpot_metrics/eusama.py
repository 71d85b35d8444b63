"""The least contact force of a wheel in per cent of the static one."""

from __future__ import annotations

from dashpot.contract.metric import Metric
from dashpot.data.run import Run
from dashpot_metrics.contact_force import is_inspection, static_force


class Eusama(Metric):
    """100 F_min / F_static of a sweep from 25 Hz downwards; 0 where the wheel leaves the platform.

    Usual classes: above 60 good, 41 to 60 sufficient, 21 to 40 weak, up to 20 bad. After the recommendation TS-02-76 of
    the European shock absorber manufacturers, as it is told in public accounts; the original was not seen.
    """

    word, unit = "eusama", "%"

    def measure(self, run: Run) -> float | None:
        """The per cent of a falling sweep under a wheel."""
        if not is_inspection(run):
            return None
        return max(0.0, 100.0 * float(run.force.min()) / static_force(run))
