"""The equation that the documentation shows of an element is the one that its class computes."""

from __future__ import annotations

import os
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from architecture.source import ROOT
from architecture.written import things
from seeds import seed_of

from dashpot import Motion

sys.path.insert(0, str(ROOT / "docs"))

from building.law import equations, evaluate, mathml, parse  # noqa: E402

ELEMENTS = things("elements")
# laws of the present motion alone, stated as F = ... without further words
PLAIN = ("coulomb", "inerter", "power_law_damper", "quadratic_damper")


@pytest.fixture
def rng():
    """Seeded anew for every test; LAW_SEED repeats it."""
    seed = int(os.environ.get("LAW_SEED") or seed_of("test_law"))
    print(f"seed {seed}: LAW_SEED={seed} repeats it")
    return np.random.default_rng(seed)


@pytest.mark.parametrize("word", ELEMENTS)
def test_every_element_states_an_equation(word):
    assert equations(ELEMENTS[word])
    assert all(mathml(equation, {}).startswith("<math") for equation in equations(ELEMENTS[word]))


@pytest.mark.parametrize("word", PLAIN)
def test_the_stated_equation_is_what_the_class_computes(word, rng):
    made = ELEMENTS[word]
    x, v, a = rng.normal(size=(3, 100)) * [[1e-2], [1.0], [10.0]]
    numbers = {key: float(rng.uniform(0.5, 3.0)) for key in made.declares.parameters}
    force, *others = equations(made)
    names = numbers | {"x": x, "v": v, "a": a}
    names |= {other.parts[0].text: evaluate(other.parts[1], names) for other in others}
    found = made().step(Motion(x, x, v, v, a), SimpleNamespace(), SimpleNamespace(**numbers), 1e-3).force
    assert found == pytest.approx(evaluate(force.parts[1], names), rel=1e-12)


def test_the_stated_force_of_bedding_in_is_what_the_class_computes(rng):
    x, numbers = rng.normal(size=100), {"stiffness": 3.0, "depth": 0.7, "exponent": 2.5, "before": 0.3}
    found = ELEMENTS["bedding_in"]().step(Motion(x, x, x, x, x), SimpleNamespace(reach=0.0), numbers_of(numbers), 1.0)
    reach = np.maximum(np.abs(x), numbers["before"])
    stated = evaluate(equations(ELEMENTS["bedding_in"])[0].parts[1], numbers | {"x": x, "reach": reach})
    assert found.force == pytest.approx(stated, rel=1e-12)


def test_the_stated_force_of_softening_is_what_the_class_computes(rng):
    x, warmth = rng.normal(size=100), rng.uniform(0.0, 3.0, size=100)
    numbers = {
        "stiffness": 3.0,
        "speed": 0.7,
        "time": 20.0,
        "exponent": 2.5,
        "before": 9.0,
        "kept": 0.0,
    }
    # a step that is short beside the time constant leaves the warmth as it is
    still = Motion(x, x, np.zeros(100), np.zeros(100), np.zeros(100))
    found = ELEMENTS["softening"]().step(still, SimpleNamespace(warmth=warmth, cooled=0.0), numbers_of(numbers), 1e-12)
    names = numbers | {"x": x, "warmth": warmth, "c": 2 ** (1 / 2.5) - 1}
    assert found.force == pytest.approx(evaluate(equations(ELEMENTS["softening"])[0].parts[1], names), rel=1e-12)


def numbers_of(values):
    """The numbers of an element, as its law reads them."""
    return SimpleNamespace(**values)


def test_a_negative_exponent_is_set_as_one():
    term = parse("F = k (1 + x/d)^-n")
    assert evaluate(term.parts[1], {"k": 3.0, "x": 1.0, "d": 0.5, "n": 2.0}) == pytest.approx(3 / 9)
    assert mathml(term, {}).endswith("<mrow><mo>−</mo><mi>n</mi></mrow></msup></mrow></math>")


def test_products_bind_closer_than_fractions_and_bars_pair_up():
    term = parse("F = k s u^2/(1 + s |u| v) - |x| sgn v")
    names = {"k": 2.0, "s": 3.0, "u": -0.5, "v": -4.0, "x": -7.0}
    assert evaluate(term.parts[1], names) == pytest.approx(2 * 3 * 0.25 / (1 + 3 * 0.5 * -4) - 7 * -1)


@pytest.mark.parametrize("text", ["F = (1 + 2", "F = 1 $ 2", "F = |x", "F = k + /x"])
def test_what_is_no_equation_is_refused(text):
    with pytest.raises(ValueError):
        parse(text)
