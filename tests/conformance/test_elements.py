"""Every installed element keeps the promises of an element, and the checks catch one that does not."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from conformance import broken_elements as broken
from seeds import seed_of

from dashpot import load_registry
from dashpot.testing import (
    CHECKS,
    ConformanceError,
    check_agreement,
    check_declarations,
    check_dimensions,
    check_element,
    check_halving,
    check_passivity,
    check_separation,
    check_tangent,
    check_visibility,
)

ELEMENTS = load_registry().elements

CAUGHT = [
    (check_declarations, broken.StrangeUnit, "unit 'N/furlong' of 'stiffness' is unknown"),
    (check_declarations, broken.Silent, "nothing is said about 'stiffness'"),
    (check_declarations, broken.Undocumented, "no docstring"),
    (check_declarations, broken.Endless, "expected positive finite bounds of 'stiffness'"),
    (check_declarations, broken.OddDefault, "default 20 of 'stiffness' lies outside its bounds 1 to 10"),
    (check_declarations, broken.TakenName, "'repeat' is the name of something else"),
    (check_declarations, broken.TwinAxes, "both axes of 'stiffness' have the same name"),
    (check_declarations, broken.Forgetful, r"declares the states \['force'\] but its step answers \[\]"),
    (check_declarations, broken.Branching, r"use np\.where"),
    (check_declarations, broken.Mathematical, "may not turn a traced value into a float"),
    (check_declarations, broken.Reducing, r"may not use numpy\.cumsum"),
    (check_dimensions, broken.WrongUnit, "when (times|forces|lengths) are measured in another unit"),
    (check_dimensions, broken.BlindToScale, "when lengths are measured in another unit"),
    (check_agreement, broken.Counting, "the traced law gives"),
    (check_agreement, broken.TwoFaced, "the traced law gives"),
    (check_agreement, broken.Undefined, "not finite for ordinary numbers: nan at sample"),
    (check_tangent, broken.Jumping, "the tangent is 0 N/m where the force rises by"),
    (check_tangent, broken.Singular, "the tangent is (nan|-?inf) N/m"),
    (check_halving, broken.Approximate, "one step and two half steps give forces that differ by"),
    (check_halving, broken.Differencing, "one step and two half steps give forces that differ by"),
    (check_halving, broken.TimeBlind, "one step and two half steps give forces that differ by"),
    (check_passivity, broken.Pushing, "gives back more work than was put in, by .*% of all"),
    (check_passivity, broken.Swelling, "gives back more work than was put in, by .*% of all"),
    (check_visibility, broken.Hiding, "NaN as 'specimen.stiffness' gives a number"),
    (check_visibility, broken.Recovering, "NaN in the motion at sample 40 gives a number"),
    (check_separation, broken.Gregarious, "another force than among 64"),
]


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__.removeprefix("check_"))
@pytest.mark.parametrize("word", ELEMENTS)
def test_an_installed_element_conforms(word, check):
    check(ELEMENTS[word], seed_of(f"{word} {check.__name__}"))


def test_the_element_of_the_example_plugin_conforms(monkeypatch):
    monkeypatch.syspath_prepend(str(Path(__file__).parents[1] / "example_plugin"))
    from dashpot_example.soft_slider import SoftSlider

    check_element(SoftSlider, seed_of("soft_slider"))
    for name in [name for name in sys.modules if name.startswith("dashpot_example")]:
        del sys.modules[name]


@pytest.mark.parametrize(("check", "element", "found"), CAUGHT, ids=lambda value: getattr(value, "__name__", ""))
def test_a_broken_element_is_caught_by_the_check_that_is_for_it(check, element, found):
    with pytest.raises(ConformanceError, match=found) as caught:
        check(element, seed_of(element.__name__))
    assert f"element '{element.word}'" in str(caught.value)
    assert element.__qualname__ in str(caught.value)


@pytest.mark.parametrize(
    "element", dict.fromkeys(element for _, element, _ in CAUGHT[11:]), ids=lambda element: element.__name__
)
def test_a_broken_law_has_nothing_wrong_with_its_declarations(element):
    check_declarations(element)


def checks_in(error):
    return [line.split(", ")[1].partition(":")[0] for line in str(error).splitlines()]


def test_all_faults_of_an_element_are_told_at_once():
    with pytest.raises(ConformanceError) as caught:
        check_element(broken.Hiding, seed_of("Hiding"))
    assert checks_in(caught.value) == ["visibility"]
    with pytest.raises(ConformanceError) as caught:
        check_element(broken.TimeBlind, seed=1)
    assert checks_in(caught.value) == ["halving"]


def test_the_seed_in_a_message_repeats_it():
    with pytest.raises(ConformanceError) as first:
        check_halving(broken.Approximate)
    seed = int(str(first.value).rpartition("seed ")[2].rstrip("]"))
    with pytest.raises(ConformanceError) as second:
        check_halving(broken.Approximate, seed)
    assert str(first.value) == str(second.value)


def test_what_an_element_does_not_claim_is_not_asked_of_it():
    check_halving(broken.Jumping)
    check_passivity(broken.Jumping)
