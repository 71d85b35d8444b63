"""All forms by the cause they stand for, and what can be hidden in which base."""

from __future__ import annotations

from . import (
    channel,
    contacts,
    damping,
    fault,
    friction,
    history,
    inertia,
    lawless,
    relaxation,
    resonator,
    sliding,
    stiffness,
    valves,
)
from .axle_case import AXLE_KINDS
from .form import Form

FORMS: dict[str, tuple[type[Form], ...]] = {
    "friction": friction.FORMS,
    "relaxation": relaxation.FORMS,
    "viscous_damping": damping.VISCOUS_FORMS,
    "quadratic_damping": damping.QUADRATIC_FORMS,
    "preload_dependent_damping": damping.PRELOAD_FORMS,
    "stiffness_curve": stiffness.FORMS,
    "moving_mass": inertia.FORMS,
    "delay": channel.FORMS,
    "asymmetric_damping": valves.ASYMMETRIC_FORMS,
    "power_law_damping": valves.POWER_FORMS,
    "end_stop": contacts.STOP_FORMS,
    "clearance": contacts.PLAY_FORMS,
    "resonance": resonator.FORMS,
    "amplitude_softening": history.PAYNE_FORMS,
    "softening": history.WARM_FORMS,
    "bedding_in": history.MULLINS_FORMS,
    "creep": history.CREEP_FORMS,
    "load_dependent_friction": sliding.LOADED_FORMS,
    "velocity_dependent_friction": sliding.FADING_FORMS,
    "no_law": lawless.FORMS,
}

FAULTS = fault.FORMS

# What the refit of a base would swallow cannot be hidden in it: a damper in a damper, a curve in a free table. Nor can
# play take away stiffness that a shock absorber does not have.
_ANYWHERE = ("resonance", "moving_mass", "delay", *FAULTS)
_AGING = ("softening", "bedding_in", "creep")
_LOSSES = ("friction", "relaxation", "velocity_dependent_friction")
_VALVES = ("quadratic_damping", "asymmetric_damping", "power_law_damping")
_TIRE = ("clearance", *_ANYWHERE, *_AGING, *_VALVES)
_SIMPLE_TIRE = (*_TIRE, *_LOSSES, "amplitude_softening", "load_dependent_friction", "preload_dependent_damping")

KINDS_OF_BASE: dict[str, tuple[str, ...]] = {
    "spring": ("friction", "relaxation", "viscous_damping", "moving_mass"),
    "kelvin_voigt": _SIMPLE_TIRE,
    "ftire": _SIMPLE_TIRE,
    "tire_model_3": _TIRE,
    "damper": (*_ANYWHERE, *_LOSSES),
    "polynomial": (*_SIMPLE_TIRE, "stiffness_curve", "end_stop"),
    "axle": AXLE_KINDS,
}
