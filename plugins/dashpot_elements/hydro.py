"""Fluid that is pumped to and fro through a long channel."""

from __future__ import annotations

from dataclasses import dataclass
from math import factorial
from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Parallel, Series, Symbol

DOUBLINGS = 18


class Hydro(Element):
    """A hydraulic mount with an inertia track: m x_h'' + d_1 x_h' + d_2 |x_h'| x_h' + k_2 x_h = k_b (x - x_h).

    The force is F = k_b (x - x_h). x_h and m are the displacement and the mass of the fluid in the track as felt at the
    piston (mass times the squared ratio of areas), k_b is the stiffness of the walls that bulge, k_2 that of the
    compensation chamber: in series with k_b it is the static stiffness. The dynamic stiffness k_b (k_2 - m w^2 + j w
    d)/(k_b + k_2 - m w^2 + j w d) dips below and peaks above the resonance at w^2 = (k_b + k_2)/m.

    Solved exactly along the cubic path where the quadratic damping is 0; otherwise this damping acts in two halves,
    before and after the step (Strang splitting, second order).
    """

    picture = Series(Symbol.SPRING, Parallel(Symbol.TRACK, Symbol.DASHPOT))
    source = "Strang, SIAM J. Numer. Anal. 5 (1968) 506, for the splitting"
    exact = False

    fluid_mass = Parameter("kg", "mass of the fluid in the track, felt at the piston", bounds=(1e-3, 1e4), symbol="m")
    stiffness = Parameter("N/m", "stiffness of the bulging walls", bounds=(1.0, 1e9), symbol="k_b")
    damping = Parameter("N*s/m", "linear damping in the track", bounds=(1e-2, 1e7), symbol="d_1")
    quadratic_damping = Parameter("N*s^2/m^2", "turbulent damping in the track", bounds=(0.0, 1e8), scale="linear",
                                  symbol="d_2", default=0.0)  # fmt: skip
    compensation_stiffness = Parameter("N/m", "stiffness of the compensation chamber", bounds=(0.0, 1e9),
                                       scale="linear", symbol="k_2", default=0.0)  # fmt: skip
    bulge = State("m", "bulge of the walls beyond the static one")
    flow = State("m/s", "velocity of the fluid in the track")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Half of the turbulence, the linear part over the whole step, the other half of the turbulence."""
        both = p.stiffness + p.compensation_stiffness
        matrix = _Matrix(dt * p.damping / p.fluid_mass, dt * dt * both / p.fluid_mass)
        turbulence = 0.5 * dt * p.quadratic_damping / p.fluid_mass
        memory = z.bulge, dt * _slowed(z.flow, turbulence)
        bulge, shift = _moved(memory, matrix, p.stiffness / both, x, dt)
        static = p.compensation_stiffness * (p.stiffness / both)
        return Response(static * x.new + p.stiffness * bulge, bulge=bulge, flow=_slowed(shift / dt, turbulence))

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the walls, of the compensation chamber and of the moving fluid."""
        share = p.stiffness / (p.stiffness + p.compensation_stiffness)
        displaced = share * x.new - z.bulge
        walls, chamber = x.new - displaced, displaced
        held = p.stiffness * walls * walls + p.compensation_stiffness * chamber * chamber
        return 0.5 * (held + p.fluid_mass * z.flow * z.flow)


def _slowed(flow: Any, turbulence: Any) -> Any:
    """The flow after a while of quadratic damping alone."""
    return flow / (1.0 + turbulence * np.abs(flow))


@dataclass(frozen=True)
class _Matrix:
    """Z = [[0, -1], [stiff, -damped]], which moves (bulge, flow dt) over a step: y' = Z y + (share v dt, 0).

    As Z^2 = -stiff I - damped Z, every function of Z is a pair (a, b) that stands for a I + b Z.
    """

    damped: Any
    stiff: Any

    def product(self, f: _Pair, g: _Pair) -> _Pair:
        """The product of two functions."""
        twice = f[1] * g[1]
        return f[0] * g[0] - self.stiff * twice, f[0] * g[1] + f[1] * g[0] - self.damped * twice

    def apply(self, f: _Pair, bulge: Any, shift: Any) -> _Pair:
        """A function of Z on a vector."""
        return f[0] * bulge - f[1] * shift, f[1] * (self.stiff * bulge) + (f[0] - self.damped * f[1]) * shift

    def moments(self) -> list[_Pair]:
        """integral of w^j exp(Z w) over w = 0..1 for j = 0, 1, 2: by its series for a small part of Z, then doubled.

        It needs no difference of near numbers, whether the fluid swings, creeps, or stands between both.
        """
        part = 0.5**DOUBLINGS
        square = -part * part * self.stiff, -part * part * self.damped
        powers = (1.0, 0.0), (0.0, part), square, self.product((0.0, part), square)
        found = [_sum(*(_sum(power, times=1.0 / (factorial(n) * (n + j + 1))) for n, power in enumerate(powers)))
                 for j in range(3)]  # fmt: skip
        for number in range(DOUBLINGS):
            found = self._doubled(found, 2.0**number * part)
        return found

    def _doubled(self, moments: list[_Pair], part: float) -> list[_Pair]:
        # the second half of the way holds exp(Z w) of the first one, times 1 + growth
        none, one, two = moments
        growth = self.product((0.0, part), none)
        late = none, _sum(one, none), _sum(two, one, one, none)
        return [_sum(early, later, self.product(growth, later), times=0.5 ** (j + 1))
                for j, (early, later) in enumerate(zip(moments, late, strict=True))]  # fmt: skip


_Pair = tuple[Any, Any]


def _sum(*pairs: _Pair, times: float = 1.0) -> _Pair:
    return times * sum(pair[0] for pair in pairs), times * sum(pair[1] for pair in pairs)


def _moved(memory: _Pair, matrix: _Matrix, share: Any, x: Motion, dt: Any) -> _Pair:
    """The memory after a step along the cubic path, of whose velocity the bulge takes a ``share``."""
    moments = matrix.moments()
    bow = 6.0 * (x.travel - 0.5 * dt * (x.velocity_old + x.velocity_new))
    # backwards from the end, with w = 1 - u, the travel is that of v_new + (v_old - v_new + bow/dt) w - bow/dt w^2
    ways = dt * x.velocity_new, dt * (x.velocity_old - x.velocity_new) + bow, -bow
    growth = matrix.product((0.0, 1.0), moments[0])
    pushes = [matrix.apply(moment, share * way, 0.0) for moment, way in zip(moments, ways, strict=True)]
    return _sum(memory, matrix.apply(growth, *memory), *pushes)
