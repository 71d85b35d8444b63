"""The built-in elements, one law per file; the name of the file is the word in a network."""

from __future__ import annotations

from importlib import import_module

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")

SPRINGS = ("spring", "contact", "end_stop", "clearance", "backlash", "gas_spring", "warm_gas_spring")
DAMPERS = (
    "damper",
    "asymmetric_damper",
    "quadratic_damper",
    "power_law_damper",
    "valve",
    "compliant_damper",
    "fading_damper",
    "worn_damper",
)
RELAXATION = ("maxwell", "springpot", "creep", "preload_creep", "hydro", "vibration_absorber", "relaxing_spring")
MASSES = ("inerter", "rattling_mass", "sliding_mass")
FRICTION = (
    "coulomb",
    "dahl",
    "prandtl",
    "stribeck",
    "stribeck_curve",
    "directional_friction",
    "side_load_friction",
    "loose_friction",
    "bouc_wen",
    "iwan",
    "kraus",
)
CHANGE = ("bedding_in", "mullins", "softening", "fading_spring", "self_heating")
WORDS = (*SPRINGS, *DAMPERS, *RELAXATION, *FRICTION, *CHANGE, *MASSES, "constant_force", "signed_spring")


@hookimpl
def dashpot_elements() -> list[type]:
    """Every element of this package, in the order of ``WORDS``."""
    modules = [import_module(f"{__name__}.{word}") for word in WORDS]
    return [getattr(module, word.title().replace("_", "")) for module, word in zip(modules, WORDS, strict=True)]
