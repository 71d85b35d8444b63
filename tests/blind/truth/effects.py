"""All forms by the cause they stand for, and what can be hidden in which base."""

from __future__ import annotations

from . import channel, damping, fault, friction, inertia, relaxation, stiffness
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
}

FAULTS = fault.FORMS

_EVERYWHERE = ("friction", "relaxation", "quadratic_damping", "moving_mass", "delay")

# What the refit of a base would swallow cannot be hidden in it: a damper in a damper, a curve in a free table.
KINDS_OF_BASE: dict[str, tuple[str, ...]] = {
    "spring": ("friction", "relaxation", "viscous_damping", "moving_mass"),
    "kelvin_voigt": (*_EVERYWHERE, "preload_dependent_damping"),
    "ftire": (*_EVERYWHERE, "preload_dependent_damping"),
    "polynomial": (*_EVERYWHERE, "preload_dependent_damping", "stiffness_curve"),
}
