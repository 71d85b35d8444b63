"""The built-in causes of misfit, one per file; the name of the file is the word in a diagnosis."""

from __future__ import annotations

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")


@hookimpl
def dashpot_causes() -> list[type]:
    """Every cause of this package."""
    from dashpot_causes.delay import Delay
    from dashpot_causes.friction import Friction
    from dashpot_causes.moving_mass import MovingMass
    from dashpot_causes.preload_dependent_damping import PreloadDependentDamping
    from dashpot_causes.quadratic_damping import QuadraticDamping
    from dashpot_causes.relaxation import Relaxation
    from dashpot_causes.stiffness_curve import StiffnessCurve
    from dashpot_causes.viscous_damping import ViscousDamping

    return [
        Friction,
        Relaxation,
        ViscousDamping,
        QuadraticDamping,
        PreloadDependentDamping,
        StiffnessCurve,
        MovingMass,
        Delay,
    ]
