"""Linear networks with unknown nodes beside their exact state space."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from verification.systems import system
from verification.truth.linear import StateSpace, chain, quarter_car, three_in_series, zener

from dashpot.kernel.system import CompiledSystem


@dataclass(frozen=True)
class Linear:
    """The texts of a network, and its state space by the numbers at its paths."""

    nodes: str
    branches: str
    gravity: str
    space: Callable[..., StateSpace]
    arguments: tuple[str, ...]

    @property
    def network(self) -> CompiledSystem:
        return system(self.nodes, self.branches, self.gravity)

    def exact(self, values: np.ndarray) -> StateSpace:
        known = dict(zip(self.network.paths, values, strict=True))
        return self.space(*(known[path] for path in self.arguments))


QUARTER_CAR = Linear(
    "{platform: driven, wheel: {mass: 40 kg}, body: {mass: 300 kg}}",
    """
    tire:
      between: [platform, wheel]
      offset: 20 mm
      parallel: {k: {element: spring, stiffness: 220 N/mm}, d: {element: damper, damping: 200 N*s/m}}
    strut:
      between: [wheel, body]
      offset: 120 mm
      parallel: {k: {element: spring, stiffness: 25 N/mm}, d: {element: damper, damping: 1500 N*s/m}}
    """,
    "9.81 m/s^2",
    lambda m, body, k, d, ks, ds, at, place: quarter_car(m, body, k, d, ks, ds, 9.81, at, place),
    (
        "wheel.mass",
        "body.mass",
        "tire.k.stiffness",
        "tire.d.damping",
        "strut.k.stiffness",
        "strut.d.damping",
        "tire.offset",
        "strut.offset",
    ),
)
ZENER = Linear(
    "",
    """
    leg:
      series:
        outer: {element: spring, stiffness: 200 N/mm}
        inner: {parallel: {k: {element: spring, stiffness: 100 N/mm}, d: {element: damper, damping: 2 N*s/mm}}}
    """,
    "",
    zener,
    ("leg.outer.stiffness", "leg.inner.k.stiffness", "leg.inner.d.damping"),
)
THREE = Linear(
    "",
    """
    leg:
      series:
        first: {element: spring, stiffness: 200 N/mm}
        second: {element: damper, damping: 3 N*s/mm}
        third: {parallel: {k: {element: spring, stiffness: 100 N/mm}, d: {element: damper, damping: 2 N*s/mm}}}
    """,
    "",
    three_in_series,
    ("leg.first.stiffness", "leg.second.damping", "leg.third.k.stiffness", "leg.third.d.damping"),
)
CHAIN = Linear(
    "{table: driven, one: {mass: 30 kg}, two: {mass: 60 kg}, wall: ground}",
    """
    first:
      between: [table, one]
      parallel: {k: {element: spring, stiffness: 200 N/mm}, d: {element: damper, damping: 300 N*s/m}}
    middle:
      between: [one, two]
      parallel: {k: {element: spring, stiffness: 100 N/mm}, b: {element: inerter, inertance: 8 kg}}
    last:
      between: [two, wall]
      parallel: {k: {element: spring, stiffness: 80 N/mm}, d: {element: damper, damping: 1500 N*s/m}}
    """,
    "0 m/s^2",
    chain,
    (
        "one.mass",
        "two.mass",
        "first.k.stiffness",
        "first.d.damping",
        "middle.k.stiffness",
        "middle.b.inertance",
        "last.k.stiffness",
        "last.d.damping",
    ),
)
LINEAR = {"quarter car": QUARTER_CAR, "zener": ZENER, "three in series": THREE, "two masses and an inerter": CHAIN}
