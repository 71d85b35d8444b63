"""The built-in test procedures, one a file; the name of the file is the word a user gives.

- `triangle`    slow loops, for the elastic curve and dry friction
- `triangles`   loops of several speeds
- `hold`        steps that are held
- `hydropulser` sweeps at several amplitudes and preloads, for one specimen
- `stepped_sine` sines of one frequency after the other
- `preload_ramp` a sine on a preload that moves on
- `blocks`      a programme of blocks of sines
- `random`      a random motion: road, pink, white
- `damper_ladder` sines of one stroke and rising velocity
- `axle_sweep`  both wheels of an axle in phase or in anti-phase, the body held
- `four_post`   platforms under an axle or a car: heave, roll, pitch, warp
- `eusama`      a wheel shaken from 25 Hz downwards
- `phase_shift` the same, from 25 to 5 Hz
- `inspection`  what both do
- `sweep_path` `triangle_path` `waves` `smooth_step` the motions in closed form
"""

from __future__ import annotations

from dashpot.contract.hooks import hookimpl


@hookimpl
def dashpot_rigs() -> list[type]:
    """Every procedure of this package."""
    from dashpot_rigs.axle_sweep import AxleSweep
    from dashpot_rigs.blocks import Blocks
    from dashpot_rigs.damper_ladder import DamperLadder
    from dashpot_rigs.eusama import Eusama
    from dashpot_rigs.four_post import FourPost
    from dashpot_rigs.hold import Hold
    from dashpot_rigs.hydropulser import Hydropulser
    from dashpot_rigs.phase_shift import PhaseShift
    from dashpot_rigs.preload_ramp import PreloadRamp
    from dashpot_rigs.random import Random
    from dashpot_rigs.stepped_sine import SteppedSine
    from dashpot_rigs.triangle import Triangle
    from dashpot_rigs.triangles import Triangles

    return [
        Triangle,
        Triangles,
        Hold,
        Hydropulser,
        SteppedSine,
        PreloadRamp,
        Blocks,
        Random,
        DamperLadder,
        AxleSweep,
        FourPost,
        Eusama,
        PhaseShift,
    ]
