"""How far a force is determined: a law whose errors grow by a known factor at each step, and one without memory."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.kernel.eager import simulate_eagerly
from dashpot.model.element import Element, Parameter, Response, State
from dashpot.testing.agreement import LAST_BITS, TOLERANCE, determined
from dashpot.testing.motion import random_drive
from dashpot.testing.specimen import specimen_of

GROWTH = 1.9


class Tent(Element):
    """A tent map of slope 1.9: every error grows by that factor at each step."""

    height = Parameter("N", "largest force", bounds=(1.0, 1e4), symbol="F")
    place = State("1", "place on the tent")

    def step(self, x, z, p, dt):
        place = 1.0 - GROWTH * np.abs(z.place - 0.3)
        return Response(p.height * place, place=place)


class Straight(Element):
    """A spring."""

    stiffness = Parameter("N/m", "stiffness", bounds=(1.0, 1e9), symbol="k")

    def step(self, x, z, p, dt):
        return Response(p.stiffness * x.new)


@pytest.fixture
def known(request):
    def look(element, **numbers):
        random = np.random.default_rng(seed_of(request.node.name))
        specimen = specimen_of(element, {key: np.full(8, number) for key, number in numbers.items()}, {})
        drive = random_drive(random, "sweep", 1e-3, 0.02, 160)
        force = simulate_eagerly(specimen.spec, drive, specimen.values)
        scale = np.max(np.abs(force), axis=1, keepdims=True)
        return determined(specimen, drive, force, scale, random)

    return look


def test_growing_errors_end_it_when_they_reach_the_tolerance(known):
    found = known(Tent, height=100.0)
    steps = np.log(TOLERANCE / LAST_BITS) / np.log(GROWTH)
    assert np.all(np.abs(np.count_nonzero(found, axis=1) - steps) < 5)
    assert np.array_equal(found, np.minimum.accumulate(found, axis=1))


def test_without_memory_it_is_determined_throughout(known):
    assert known(Straight, stiffness=1e5).all()
