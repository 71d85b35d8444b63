"""The built-in metrics, one a file; the name of the file is the word in result files.

- `eusama`                      least contact force of a wheel in per cent of the static one
- `phase_shift`                 least phase angle between platform and contact force
- `phase_shift_first_crossings` what some programs read in its place, a pitfall
- `contact_force`               what both look at: static force, and whether a run is such a test
- `periods`                     tops of the platform and crossings of the static force, for both angles
"""

from __future__ import annotations

from dashpot.contract.hooks import hookimpl


@hookimpl
def dashpot_metrics() -> list[type]:
    """Every metric of this package."""
    from dashpot_metrics.eusama import Eusama
    from dashpot_metrics.phase_shift import PhaseShift
    from dashpot_metrics.phase_shift_first_crossings import FirstCrossings

    return [Eusama, PhaseShift, FirstCrossings]
