"""Networks to draw: as texts, and made at random by hypothesis."""

from __future__ import annotations

from hypothesis import strategies as st

from dashpot import Curve, Element, Parallel, Parameter, Response, Series, Symbol
from dashpot.model.network import Branch, Characteristic, Ends, Group, Joint, NetworkSpec, Value

AXLE = """
format: dashpot-network/1
name: axle
gravity: 9.81 m/s^2
nodes:
  platform_left: driven
  platform_right: driven
  wheel_left: {mass: {start: 40 kg}, added_mass: 5 kg}
  wheel_right: {same_as: wheel_left}
  body: ground
branches:
  tire: {between: [platform_left, wheel_left], offset: 20 mm, parallel: {
    carcass: {element: spring, stiffness: {deflection: [0 mm, 20 mm, 40 mm], force: [0 N, 4 kN, 9 kN]}},
    loss: {repeat: 3, element: maxwell, stiffness: {start: [8 N/mm, 9 N/mm, 12 N/mm]},
           relaxation_time: {start: [160 ms, 32 ms, 6.4 ms]}},
    slip: {element: prandtl, stiffness: 20 N/mm, limit: 20 N}}}
  tire_right: {same_as: tire, between: [platform_right, wheel_right]}
  spring: {between: [wheel_left, body], element: spring, stiffness: 30 N/mm}
  strut: {between: [wheel_left, body], series: {
    damper: {element: damper, damping: {start: 1500 N*s/m}},
    mount: {parallel: {rubber: {element: spring, stiffness: 200 N/mm}, loss: {element: damper, damping: 400 N*s/m}}}}}
  rub: {between: [wheel_left, body], element: dahl, stiffness: 100 N/mm, limit: {start: 80 N}}
  spring_right: {between: [wheel_right, body], same_as: spring}
  strut_right: {between: [wheel_right, body], same_as: strut}
  rub_right: {between: [wheel_right, body], same_as: rub}
  bar: {between: [wheel_left, wheel_right], parallel: {
    twist: {element: spring, stiffness: 20 N/mm}, bushing: {element: dahl, stiffness: 200 N/mm, limit: 60 N}}}
"""
QUARTER_CAR = """
format: dashpot-network/1
name: quarter_car
nodes: {platform: driven, wheel: {mass: 40 kg}, body: {mass: 400 kg}}
branches:
  tire: {between: [platform, wheel], element: spring, stiffness: 200 N/mm, offset: 20 mm}
  spring: {between: [wheel, body], element: spring, stiffness: 20 N/mm}
  damper: {between: [wheel, body], element: damper, damping: 1500 N*s/m,
           scale: {deflection: [0 mm, 20 mm], factor: [1.4, 1]}}
measurement: {force: {gain: 1.01, delay: 1 ms}}
"""
LOADED = """
format: dashpot-network/1
name: loaded
nodes: {floor: ground, seat: {hold: loaded, mass: 12 kg}, head: {mass: 5 kg}}
branches:
  foot: {between: [floor, seat], element: spring, stiffness: 20 N/mm}
  neck: {between: [seat, head], element: damper, damping: 100 N*s/m}
  wall: {between: [head, floor], element: spring, stiffness: 1 N/mm}
"""
TEXTS = {"axle": AXLE, "quarter_car": QUARTER_CAR, "loaded": LOADED}


class Plain(Element):
    """A law of which only the picture matters."""

    number = Parameter("N/m", "a number", symbol="k_1")
    table = Curve(("force", "N"), ("deflection", "m"), "a curve", symbol="c")

    def step(self, x, z, p, dt):
        return Response(x.new)


def pictured(name, shown):
    """An element with a picture."""
    return type(name.title(), (Plain,), {"word": name, "picture": shown})


KINDS = [
    *(pictured(symbol.name.lower(), symbol) for symbol in Symbol),
    pictured("chain", Series(Symbol.SPRING, Symbol.DASHPOT)),
    pictured("fan", Series(Symbol.GAP, Parallel(Symbol.TRACK, Series(Symbol.SPRING, Symbol.SLIDER), Symbol.PLAY))),
]
NAMES = st.sampled_from(["a", "damper", "a_rather_long_name_of_a_branch", "Größe", "MMWWMM", "ß+1"])
NUMBERS = st.floats(1e-3, 1e7).map(lambda number: float(f"{number:.4g}"))


@st.composite
def branches(draw, name):
    kind = draw(st.sampled_from(KINDS))
    role = draw(st.sampled_from(["fixed", "free"]))
    values = {"number": Value(draw(NUMBERS), "N/m", role)} if draw(st.booleans()) else {}
    knots = draw(st.integers(0, 7))
    at = tuple(0.01 * knot for knot in range(knots))
    table = Characteristic(Plain.table, "table" if knots else "constant", (Value(3.0, "N"),) * max(knots, 1), at)
    scale = Characteristic(Plain.table, "table", (Value(1.5, "1"), Value(1.0, "1")), (0.0, 0.01))
    return Branch(name, kind, values, {"table": table}, scale if draw(st.booleans()) else None, name)


@st.composite
def trees(draw, name, depth):
    """A branch, or a group of branches and groups."""
    if depth == 0 or draw(st.integers(0, 2)) == 0:
        return draw(branches(name))
    kind = draw(st.sampled_from(["series", "parallel"]))
    count = draw(st.integers(1, 3))
    members = tuple(draw(trees(f"{name}.{draw(NAMES)}{number}", depth - 1)) for number in range(count))
    return Group(name, kind, members)


@st.composite
def two_ended(draw):
    """A network between two ends."""
    count = draw(st.integers(1, 4))
    members = tuple(draw(trees(f"{draw(NAMES)}{number}", 3)) for number in range(count))
    return NetworkSpec("two_ended", Group("", "parallel", members))


@st.composite
def jointed(draw):
    """A network with nodes, connected at random."""
    names = [f"n{number}" for number in range(draw(st.integers(2, 6)))]
    holds = [draw(st.sampled_from(["driven", "ground", "free", "free", "loaded"])) for _ in names]
    masses = {"mass": Value(40.0, "kg")}
    joints = {
        name: Joint(name, hold, masses if hold in ("free", "loaded") and draw(st.booleans()) else {})
        for name, hold in zip(names, holds, strict=True)
    }
    pairs = st.tuples(st.sampled_from(names), st.sampled_from(names)).filter(lambda pair: pair[0] != pair[1])
    ends = [draw(pairs) for _ in range(draw(st.integers(1, 8)))]
    members = tuple(draw(trees(f"b{number}", 2)) for number in range(len(ends)))
    offsets = [Value(0.02, "m") if draw(st.booleans()) else None for _ in ends]
    connections = {
        member.name: Ends(*pair, offset) for member, pair, offset in zip(members, ends, offsets, strict=True)
    }
    return NetworkSpec("jointed", Group("", "parallel", members), {}, joints, connections)
