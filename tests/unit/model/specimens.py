"""Two elements for texts of networks, and how to write one."""

from __future__ import annotations

from textwrap import dedent, indent

from dashpot.model.element import Curve, Element, Parameter, Response, State
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import parse_network


class Elastic(Element):
    """A spring."""

    word = "elastic"
    stiffness = Curve(("force", "N"), ("deflection", "m"), "force over deflection", bounds=(1.0, 1e9))

    def step(self, x, z, p, dt):
        return Response(p.stiffness(x.new))


class Viscous(Element):
    """A damper."""

    word = "viscous"
    damping = Curve(("force", "N"), ("velocity", "m/s"), "force over velocity", bounds=(1e-2, 1e7))

    def step(self, x, z, p, dt):
        return Response(p.damping(x.velocity_new))


class Slider(Element):
    """A slider whose exponent may be left out."""

    word = "slider"
    stiffness = Parameter("N/m", "slope at rest", bounds=(1.0, 1e9))
    limit = Parameter("N", "sliding force", bounds=(1e-3, 1e6))
    exponent = Parameter("1", "shape", bounds=(0.0, 4.0), scale="linear", default=1.0)
    force = State("N", "friction force")

    def step(self, x, z, p, dt):
        return Response(z.force + p.stiffness * x.travel, force=z.force)


ELEMENTS = {element.word: element for element in (Elastic, Viscous, Slider)}
HEAD = "format: dashpot-network/1\nname: bench\nbranches:\n"


def written(branches: str) -> str:
    """The text of a network with these branches."""
    return HEAD + indent(dedent(branches).strip("\n"), "  ") + "\n"


def network(branches: str) -> NetworkSpec:
    """The network with these branches."""
    return parse_network(written(branches), ELEMENTS, "n.yaml")


def numbers(spec: NetworkSpec) -> dict[str, float]:
    """All numbers by path."""
    return {slot.path: slot.value.number for slot in spec.slots()}
