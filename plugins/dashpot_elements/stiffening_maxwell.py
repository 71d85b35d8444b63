"""A dashpot on a spring that stiffens up to a block."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol
from dashpot_elements.behind_spring import FAR, NEAR, SHARE, middle_velocity


class StiffeningMaxwell(Element):
    """A dashpot in series with a progressive spring: e' = v - F/d, F = k e/(1 - |e|/travel), d = k T.

    e is the deflection of the spring, which grows ever stiffer towards the travel, where it is blocked: a damper on a
    rubber top mount, or a hose that stretches less under pressure. Small forces see `maxwell`, large ones the dashpot
    alone. A `series:` of a spring with a curve and any law of a dashpot does the same for all laws; this one is a
    single branch. One step follows TR-BDF2, of second order in the step; its equation is a quadratic one.
    """

    picture = Series(Symbol.SPRING, Symbol.DASHPOT)
    source = "Hosea and Shampine, Applied Numerical Mathematics 20 (1996) 21, for TR-BDF2"
    exact = False

    stiffness = Parameter("N/m", "stiffness of the spring for small forces", bounds=(1e-3, 1e12), symbol="k")
    relaxation_time = Parameter("s", "damping over stiffness", bounds=(1e-5, 1e4), symbol="T")
    travel = Parameter("m", "deflection at which the spring is blocked", bounds=(1e-8, 100.0), symbol="s")
    force = State("N", "force in the branch")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The spring deflects by what the dashpot leaves of the motion, over both parts of the step."""
        part = SHARE * dt
        loaded = z.force / p.stiffness
        stretch = _stretch(loaded, p.travel)
        speed = x.velocity_old - loaded / p.relaxation_time + middle_velocity(x, dt)
        loaded = _loaded(stretch + part * speed, part / p.relaxation_time, p.travel)
        given = NEAR * _stretch(loaded, p.travel) - FAR * stretch + part * x.velocity_new
        force = p.stiffness * _loaded(given, part / p.relaxation_time, p.travel)
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring."""
        share = np.abs(z.force) / (p.stiffness * p.travel)
        return p.stiffness * p.travel * p.travel * (np.log1p(share) - share / (1.0 + share))


def _stretch(loaded: Any, travel: Any) -> Any:
    """The deflection in m under a force over the stiffness, in m."""
    return loaded / (1.0 + np.abs(loaded) / travel)


def _loaded(given: Any, part: Any, travel: Any) -> Any:
    """The force over the stiffness at which deflection and ``part`` of that force are together ``given``, in m.

    The root of part y^2 + (1 + part - q) y = q for y and q in units of the travel, by the form that does not cancel.
    """
    q = np.abs(given) / travel
    half = 0.5 * (1.0 + part - q)
    root = np.sqrt(half * half + part * q)
    lower = 1.0 / (np.maximum(half, 0.0) + root)
    upper = (root - half) / (part * np.maximum(q, 1.0))
    return given * np.where(half > 0.0, lower, upper)
