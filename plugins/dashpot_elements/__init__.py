"""The built-in elements, one law per file; the name of the file is the word in a network."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")

# the laws by what they stand for; each family has its page in the documentation
FAMILIES: Mapping[str, tuple[str, ...]] = {
    "springs": (
        "spring",
        "signed_spring",
        "contact",
        "end_stop",
        "rigid_stop",
        "clearance",
        "backlash",
        "loose_kelvin_voigt",
        "gas_spring",
        "warm_gas_spring",
        "constant_force",
    ),
    "dampers": (
        "damper",
        "asymmetric_damper",
        "quadratic_damper",
        "power_law_damper",
        "valve",
        "compliant_damper",
        "stiffening_maxwell",
        "proportional_damper",
        "fading_damper",
        "worn_damper",
    ),
    "relaxation": ("maxwell", "springpot", "creep", "preload_creep", "relaxing_spring"),
    "friction": (
        "coulomb",
        "ideal_coulomb",
        "dahl",
        "prandtl",
        "stribeck",
        "stribeck_curve",
        "directional_coulomb",
        "directional_friction",
        "side_load_friction",
        "loaded_slider",
        "loose_friction",
        "bouc_wen",
        "iwan",
        "kraus",
    ),
    "softening": ("bedding_in", "mullins", "softening", "fading_spring", "self_heating"),
    "inertia": ("inerter", "hydro", "vibration_absorber", "rattling_mass", "sliding_mass"),
}
WORDS = tuple(word for words in FAMILIES.values() for word in words)


@hookimpl
def dashpot_elements() -> list[type]:
    """Every element of this package, in the order of ``WORDS``."""
    modules = [import_module(f"{__name__}.{word}") for word in WORDS]
    return [getattr(module, word.title().replace("_", "")) for module, word in zip(modules, WORDS, strict=True)]
