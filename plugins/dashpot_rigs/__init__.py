"""The built-in test procedures, one a file; the name of the file is the word a user gives.

- `triangle`    slow loops, for the elastic curve and dry friction
- `hydropulser` sweeps at several amplitudes and preloads, for one specimen
- `axle_sweep`  both wheels of an axle in phase or in anti-phase, the body held
- `eusama`      a wheel shaken from 25 Hz downwards
- `phase_shift` the same, from 25 to 5 Hz
- `inspection`  what both do
- `sweep_path` `triangle_path` `smooth_step` the motions in closed form
"""

from __future__ import annotations

from dashpot.contract.hooks import hookimpl


@hookimpl
def dashpot_rigs() -> list[type]:
    """Every procedure of this package."""
    from dashpot_rigs.axle_sweep import AxleSweep
    from dashpot_rigs.eusama import Eusama
    from dashpot_rigs.hydropulser import Hydropulser
    from dashpot_rigs.phase_shift import PhaseShift
    from dashpot_rigs.triangle import Triangle

    return [Triangle, Hydropulser, AxleSweep, Eusama, PhaseShift]
