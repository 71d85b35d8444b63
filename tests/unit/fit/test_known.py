"""The interval of a number that is known from elsewhere reaches the numbers that are found."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import STIFFNESS, ready, runs

from dashpot.fit.known import known_numbers
from dashpot.fit.uncertainty import assess_uncertainty

PART, HALF = 80e3, 6e3
SPRINGS = f"""
    part: {{{{element: spring, stiffness: {{part}}}}}}
    rest: {{{{element: spring, stiffness: {{{{start: {STIFFNESS - PART}}}}}}}}}
"""
KNOWN = f"{{known: {PART}, interval: [{PART - HALF}, {PART + HALF}]}}"


def half_width(part: str) -> float:
    rng = np.random.default_rng(seed_of("test_known"))
    scored = runs(lambda x, v, a: STIFFNESS * x)
    for each in scored:
        each.force[:] += rng.standard_normal(each.force.size)
    _, objective, coordinates = ready(SPRINGS.format(part=part), scored)
    steps = [each.step for each in known_numbers(objective.network.spec)]
    known = assess_uncertainty(objective, coordinates, coordinates.start, steps)
    return (STIFFNESS - PART) * np.diff(np.log(known.intervals[0]))[0] / 2.0


def test_what_a_known_spring_may_have_more_the_rest_may_have_less():
    assert half_width(KNOWN) == pytest.approx(HALF, rel=1e-2)


def test_a_plain_number_is_taken_as_exact():
    assert half_width(f"{PART}") < 0.05 * HALF


def test_a_known_number_is_not_searched():
    spec, _, coordinates = ready(SPRINGS.format(part=KNOWN), runs())
    assert coordinates.paths == ("rest.stiffness",)
    (part, _) = spec.slots()
    assert (part.value.role, part.value.known, part.value.number) == ("fixed", True, PART)
