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
    # the power law is rounded off at rest, by (1 + 1e-6 / r^2)^((exponent - 1) / 2): from r = 1/3 on less than 1e-5
    v += np.sign(v)
    numbers = {key: float(rng.uniform(0.5, 3.0)) for key in made.declares.parameters}
    force, *others = equations(made)
    names = numbers | {"x": x, "v": v, "a": a}
    names |= {other.parts[0].text: evaluate(other.parts[1], names) for other in others}
    found = made().step(Motion(x, x, v, v, a), SimpleNamespace(), SimpleNamespace(**numbers), 1e-3).force
    assert found == pytest.approx(evaluate(force.parts[1], names), rel=1e-4)


def test_products_bind_closer_than_fractions_and_bars_pair_up():
    term = parse("F = k s u^2/(1 + s |u| v) - |x| sgn v")
    names = {"k": 2.0, "s": 3.0, "u": -0.5, "v": -4.0, "x": -7.0}
    assert evaluate(term.parts[1], names) == pytest.approx(2 * 3 * 0.25 / (1 + 3 * 0.5 * -4) - 7 * -1)


@pytest.mark.parametrize("text", ["F = (1 + 2", "F = 1 $ 2", "F = |x"])
def test_what_is_no_equation_is_refused(text):
    with pytest.raises(ValueError):
        parse(text)
