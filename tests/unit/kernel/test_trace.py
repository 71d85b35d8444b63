"""How a branch sees the drive, and what cannot be compiled."""

from __future__ import annotations

import numpy as np
import pytest
from unit.kernel.networks import HEAD, network

from dashpot.expr.node import symbols_of
from dashpot.kernel.compiler.trace import trace_branch, trace_network
from dashpot.kernel.network import compile_network
from dashpot.model.element import Curve, Element, Parameter, Response, State
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError


def traced(line: str):
    return trace_branch(network(f"it: {{{line}}}").leaves()[0])


@pytest.mark.parametrize(
    ("line", "sight"),
    [
        ("element: spring, stiffness: 5", "still"),
        ("element: damper, damping: 5", "still"),
        ("element: inerter, inertance: 5", "still"),
        ("element: maxwell, stiffness: 5, relaxation_time: 5", "path"),
        ("element: dahl, stiffness: 5, limit: 5", "monotone"),
        ("element: prandtl, stiffness: 5, limit: 5", "monotone"),
    ],
)
def test_a_branch_sees_as_much_of_the_motion_as_it_uses(line, sight):
    branch = traced(line)
    assert branch.sight == sight
    used = {name for root in branch.roots for name in symbols_of(root)}
    assert {name.partition(".")[0] for name in used if name.split(".")[-1] in ("old", "new")} <= {sight}


def test_numbers_that_are_left_out_are_constants_of_the_law():
    assert symbols_of(traced("element: dahl, stiffness: 5, limit: 5").force) == {
        "monotone.old",
        "monotone.new",
        "it|force",
        "it.stiffness",
        "it.limit",
    }
    assert "it.exponent" in symbols_of(traced("element: dahl, stiffness: 5, limit: 5, exponent: 2").force)


def test_a_factor_acts_on_the_force_and_not_on_the_memory():
    plain = traced("element: dahl, stiffness: 5, limit: 5")
    scaled = traced("element: dahl, stiffness: 5, limit: 5, scale: {deflection: [0, 1], factor: [1, 2]}")
    assert scaled.states["it|force"] is plain.states["it|force"]
    assert scaled.force is not plain.force


def test_a_curve_without_numbers_is_refused_with_what_to_do():
    spec = network("it: {element: spring, stiffness: {from: quasi_static}}")
    assert trace_network(spec)
    told = "n.yaml:4:36: the curve 'it.stiffness' is to be taken from data and has no knots yet. fit the network first"
    with pytest.raises(InputError, match=told):
        compile_network(spec)


class Worn(Element):
    """A slider whose limit is a curve over its own memory."""

    word = "worn"
    limit = Curve(("force", "N"), ("deflection", "m"), "sliding force", bounds=(1.0, 1e9))
    stiffness = Parameter("N/m", "slope", bounds=(1.0, 1e9))
    force = State("N", "force")

    def step(self, x, z, p, dt):
        force = np.minimum(z.force + p.stiffness * x.travel, p.limit(z.force / p.stiffness))
        return Response(force, force=force)


class Placed(Element):
    """A slider whose limit is a curve over the deflection."""

    word = "placed"
    limit = Curve(("force", "N"), ("deflection", "m"), "sliding force", bounds=(1.0, 1e9))
    stiffness = Parameter("N/m", "slope", bounds=(1.0, 1e9))
    force = State("N", "force")

    def step(self, x, z, p, dt):
        force = np.minimum(z.force + p.stiffness * x.travel, p.limit(x.new))
        return Response(force, force=force)


class Shifted(Element):
    """A spring whose curve is shifted by a parameter."""

    word = "shifted"
    stiffness = Curve(("force", "N"), ("deflection", "m"), "force", bounds=(1.0, 1e9))
    shift = Parameter("m", "how far", bounds=(-1.0, 1.0), scale="linear")

    def step(self, x, z, p, dt):
        return Response(p.stiffness(x.new - p.shift))


TABLE = "{deflection: [0, 1], force: [1, 2]}"


@pytest.mark.parametrize(
    ("element", "numbers", "told"),
    [
        (Worn, "stiffness: 5, limit: CURVE", r"'it.limit' at it.stiffness, it\|force, expected along the drive"),
        (
            Placed,
            "stiffness: 5, limit: CURVE",
            "'it.limit' for its memory between two samples, expected along the drive",
        ),
        (Shifted, "shift: 5 mm, stiffness: CURVE", "'it.stiffness' at it.shift, expected along the drive"),
    ],
)
def test_a_table_that_the_kernel_cannot_look_up_is_refused(element, numbers, told):
    def spec(curve):
        entry = f"it: {{element: {element.word}, {numbers.replace('CURVE', curve)}}}"
        return parse_network(f"{HEAD}  {entry}\n", {element.word: element}, "n.yaml")

    with pytest.raises(InputError, match=rf"n.yaml:4:7: the element '{element.word}' looks up the table {told}"):
        trace_network(spec(TABLE))
    assert trace_network(spec("9")) and trace_network(spec("{polynomial: [9, 1]}"))


class Confused(Element):
    """Answers another state than it declares."""

    word = "confused"
    stiffness = Parameter("N/m", "slope", bounds=(1.0, 1e9))
    force = State("N", "force")

    def step(self, x, z, p, dt):
        return Response(p.stiffness * x.new, power=x.new)


def test_an_element_that_cannot_be_traced_is_named():
    text = f"{HEAD}  it: {{element: confused, stiffness: 5}}\n"
    with pytest.raises(InputError, match=r"it declares the states \['force'\] but .*\['power'\]") as caught:
        trace_network(parse_network(text, {"confused": Confused}))
    [problem] = caught.value.problems
    assert problem.message.startswith("the law of the element 'confused' cannot be used")
    assert (problem.place.file, problem.place.line) == (__file__, Confused.step.__code__.co_firstlineno)


class Branching(Confused):
    """Asks what cannot be known yet."""

    word = "branching"

    def step(self, x, z, p, dt):
        slope = p.stiffness
        if x.new > 0.0:
            slope = 2.0 * slope
        return Response(slope * x.new, force=x.new)


class Raising(Confused):
    """Raises in a function of its own."""

    word = "raising"

    def step(self, x, z, p, dt):
        return Response(self.force_at(x.new), force=x.new)

    def force_at(self, x):
        return {}["far"] * x


class Leaving(Confused):
    """Would end the process."""

    word = "leaving"

    def step(self, x, z, p, dt):
        raise SystemExit(5)


class Interrupted(Confused):
    """Ctrl-C while it is traced."""

    word = "interrupted"

    def step(self, x, z, p, dt):
        raise KeyboardInterrupt


@pytest.mark.parametrize(
    "element, line, told",
    [
        (Leaving, Leaving.step.__code__.co_firstlineno + 1, "it raises SystemExit: 5"),
        (Branching, Branching.step.__code__.co_firstlineno + 2, "a law may not branch on a traced value; use np.where"),
        (Raising, Raising.force_at.__code__.co_firstlineno + 1, "it raises KeyError: 'far'"),
    ],
)
def test_a_law_that_fails_is_told_as_the_fault_of_its_plugin_with_the_line(element, line, told):
    text = f"{HEAD}  it: {{element: {element.word}, stiffness: 5}}\n"
    with pytest.raises(InputError, match=told) as caught:
        trace_network(parse_network(text, {element.word: element}))
    [problem] = caught.value.problems
    assert (problem.place.file, problem.place.line) == (__file__, line)
    assert "a fault of the plugin that gives the element" in problem.hint


def test_an_interruption_while_a_law_is_traced_stays_one():
    text = f"{HEAD}  it: {{element: interrupted, stiffness: 5}}\n"
    with pytest.raises(KeyboardInterrupt):
        trace_network(parse_network(text, {"interrupted": Interrupted}))
