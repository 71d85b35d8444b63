"""Elements with one mistake each, as an author might make it."""

from __future__ import annotations

import math
from itertools import count

import numpy as np

from dashpot.expr.node import Node
from dashpot.model.element import Curve, Element, Motion, Parameter, Response, State

STIFFNESS = Parameter("N/m", "slope", bounds=(1.0, 1e9))
DAMPING = Parameter("N*s/m", "force over velocity", bounds=(1e-2, 1e7))
TIME = Parameter("s", "time of relaxation", bounds=(1e-5, 1e4))
LIMIT = Parameter("N", "sliding force", bounds=(1e-3, 1e6))
FORCE = State("N", "force")


class StrangeUnit(Element):
    """A spring in a unit that nobody knows."""

    stiffness = Parameter("N/furlong", "slope", bounds=(1.0, 1e9))

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new)


class Silent(Element):
    """A spring that says nothing about its stiffness."""

    stiffness = Parameter("N/m", "", bounds=(1.0, 1e9))

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new)


class Undocumented(Element):
    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new)


class Endless(Element):
    """A spring searched by logarithm over everything."""

    stiffness = Parameter("N/m", "slope")

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new)


class OddDefault(Element):
    """A spring whose default lies outside its bounds."""

    stiffness = Parameter("N/m", "slope", bounds=(1.0, 10.0), default=20.0)

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new)


class TakenName(Element):
    """A spring whose parameter is called like something else in a file."""

    repeat = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(p.repeat * x.new)


class TwinAxes(Element):
    """A spring whose curve has one word for both axes."""

    stiffness = Curve(("force", "N"), ("force", "m"), "force over deflection", bounds=(1.0, 1e9))

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness(x.new))


class Forgetful(Element):
    """A state that the law does not answer."""

    stiffness = STIFFNESS
    force = FORCE

    def step(self, x: Motion, z, p, dt):
        return Response(z.force + p.stiffness * x.travel)


class Branching(Element):
    """A Python condition on a value."""

    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new if x.new > 0.0 else 0.0 * x.new)


class Mathematical(Element):
    """A function of the math module instead of numpy's."""

    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * math.sin(x.new))


class Reducing(Element):
    """A numpy function that cannot be traced."""

    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * np.cumsum(x.new))


class WrongUnit(Element):
    """A spring whose stiffness claims to be a damping."""

    stiffness = Parameter("N*s/m", "slope", bounds=(1.0, 1e9))

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new)


class TimeBlind(Element):
    """A memory that fades by the step instead of by the second."""

    stiffness = STIFFNESS
    force = FORCE

    def step(self, x: Motion, z, p, dt):
        force = 0.9 * z.force + p.stiffness * x.travel
        return Response(force, force=force)


class BlindToScale(Element):
    """A spring with a stop at ten millimetres, whatever the unit of length."""

    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * (x.new + 1e-3 * np.tanh(x.new / 1e-3)))


class Counting(Element):
    """A law that remembers by itself how often it was called."""

    stiffness = STIFFNESS
    calls = count(1)

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new * (1.0 + 1e-9 * next(self.calls)))


class TwoFaced(Element):
    """A law that does something else while it is traced."""

    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new * (1.0 if isinstance(x.new, Node) else 1.0 + 1e-9))


class Undefined(Element):
    """Zero over zero where nothing moves."""

    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(p.stiffness * x.new * x.travel / x.travel)


class Jumping(Element):
    """Friction that jumps with the direction of the step."""

    exact = False
    passive = False
    limit = LIMIT
    force = FORCE

    def step(self, x: Motion, z, p, dt):
        force = p.limit * np.sign(x.travel)
        return Response(force, force=force)


class Singular(Element):
    """A root whose slope is not a number where nothing moves."""

    limit = LIMIT
    stiffness = STIFFNESS
    force = FORCE

    def step(self, x: Motion, z, p, dt):
        force = z.force + p.stiffness * np.sqrt(x.travel * x.travel) * np.where(x.travel < 0.0, -1.0, 1.0)
        return Response(force, force=force)


class Approximate(Element):
    """A Maxwell element by the explicit Euler method that claims to be exact."""

    stiffness = STIFFNESS
    relaxation_time = TIME
    force = FORCE

    def step(self, x: Motion, z, p, dt):
        force = z.force * (1.0 - dt / p.relaxation_time) + p.stiffness * x.travel
        return Response(force, force=force)


class Differencing(Element):
    """A damper by the backward difference that claims to be exact."""

    damping = DAMPING

    def step(self, x: Motion, z, p, dt):
        return Response(p.damping * x.travel / dt)


class Pushing(Element):
    """A damper with the wrong sign."""

    damping = DAMPING

    def step(self, x: Motion, z, p, dt):
        return Response(-p.damping * x.velocity_new)


class Swelling(Element):
    """A Maxwell element whose force is larger on the way back."""

    stiffness = STIFFNESS
    force = FORCE

    def step(self, x: Motion, z, p, dt):
        force = z.force + p.stiffness * x.travel * np.where(x.travel * z.force < 0.0, 0.7, 1.0)
        return Response(force, force=force)


class Hiding(Element):
    """A condition that takes a number for NaN."""

    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        return Response(np.where(p.stiffness > 0.0, p.stiffness, 1.0) * x.new)


class Recovering(Element):
    """A memory that starts afresh where it is no number."""

    stiffness = STIFFNESS
    force = FORCE

    def step(self, x: Motion, z, p, dt):
        force = np.where(z.force == z.force, z.force, 0.0) + p.stiffness * x.travel
        return Response(force, force=force)


class Gregarious(Element):
    """A law that looks at all lanes at once, but only in its own code."""

    stiffness = STIFFNESS

    def step(self, x: Motion, z, p, dt):
        mean = p.stiffness if isinstance(x.new, Node) else np.mean(p.stiffness)
        return Response((p.stiffness + 1e-6 * mean) * x.new)
