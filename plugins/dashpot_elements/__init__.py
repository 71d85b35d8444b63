"""The built-in elements, one law per file; the name of the file is the word in a network."""

from __future__ import annotations

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")


@hookimpl
def dashpot_elements() -> list[type]:
    """Every element of this package."""
    from dashpot_elements.asymmetric_damper import AsymmetricDamper
    from dashpot_elements.backlash import Backlash
    from dashpot_elements.bedding_in import BeddingIn
    from dashpot_elements.bouc_wen import BoucWen
    from dashpot_elements.clearance import Clearance
    from dashpot_elements.contact import Contact
    from dashpot_elements.coulomb import Coulomb
    from dashpot_elements.creep import Creep
    from dashpot_elements.dahl import Dahl
    from dashpot_elements.damper import Damper
    from dashpot_elements.end_stop import EndStop
    from dashpot_elements.fading_spring import FadingSpring
    from dashpot_elements.hydro import Hydro
    from dashpot_elements.inerter import Inerter
    from dashpot_elements.iwan import Iwan
    from dashpot_elements.kraus import Kraus
    from dashpot_elements.loose_friction import LooseFriction
    from dashpot_elements.maxwell import Maxwell
    from dashpot_elements.mullins import Mullins
    from dashpot_elements.power_law_damper import PowerLawDamper
    from dashpot_elements.prandtl import Prandtl
    from dashpot_elements.preload_creep import PreloadCreep
    from dashpot_elements.quadratic_damper import QuadraticDamper
    from dashpot_elements.softening import Softening
    from dashpot_elements.spring import Spring
    from dashpot_elements.springpot import Springpot
    from dashpot_elements.stribeck import Stribeck
    from dashpot_elements.stribeck_curve import StribeckCurve
    from dashpot_elements.vibration_absorber import VibrationAbsorber

    return [
        Spring,
        Contact,
        EndStop,
        Clearance,
        Backlash,
        Damper,
        AsymmetricDamper,
        QuadraticDamper,
        PowerLawDamper,
        Maxwell,
        Springpot,
        Creep,
        PreloadCreep,
        Hydro,
        VibrationAbsorber,
        Coulomb,
        Dahl,
        Prandtl,
        Stribeck,
        StribeckCurve,
        LooseFriction,
        BoucWen,
        Iwan,
        Kraus,
        BeddingIn,
        Mullins,
        Softening,
        FadingSpring,
        Inerter,
    ]
