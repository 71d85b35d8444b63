"""A network that could do by itself what a cause would be named for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.assess.rig import REGISTRY, STEP, fitted
from unit.assess.test_refits import bench_of

from dashpot.assess.court import Court
from dashpot.assess.own import at_its_best
from dashpot.assess.suspicion import look_at
from dashpot.model.reading import parse_network

CAUSES = [REGISTRY.causes[word] for word in ("relaxation", "viscous_damping")]
TWO = """\
format: dashpot-network/1
name: two
branches:
  stiffness: {element: spring, stiffness: {start: 200 N/mm}}
  slow: {element: maxwell, stiffness: {start: 20 N/mm}, relaxation_time: {start: 100 ms, bounds: [40 ms, 10 s]}}
  other: {element: maxwell, stiffness: {start: 1 N/mm}, relaxation_time: {start: 3 s, bounds: [1 ms, 10 s]}}
"""


def relaxing_twice(fast):
    """A spring of 200 N/mm and two Maxwell branches, by explicit steps: 20 N/mm over 100 ms, ``fast`` N/m over 8 ms."""

    def force(x, v):
        parts = np.zeros((2, x.size))
        for k in range(1, x.size):
            change, time = x[k] - x[k - 1], np.array([0.1, 8e-3])
            parts[:, k] = (parts[:, k - 1] + np.array([20e3, fast]) * change) / (1.0 + STEP / time)
        return 200e3 * x + parts.sum(axis=0)

    return force


def stuck(bench):
    """A fit of which the second branch rests where the record does not reach."""
    held = fitted(bench, TWO.replace("bounds: [1 ms, 10 s]", "bounds: [2.9 s, 3.1 s]"))
    numbers = {slot.path: slot.value.number for slot in held.fitted.slots()}
    declared = parse_network(TWO, REGISTRY.elements)
    start = bench.start_from(declared, declared)
    start = start.with_values({slot.path: replace(slot.value, number=numbers[slot.path]) for slot in start.slots()})
    return bench.as_it_stands(declared, start, None)


@pytest.mark.parametrize("fast", [1.5e3, 5e3])
def test_an_idle_branch_does_what_a_new_one_of_its_kind_would(fast, rng):
    bench, held_out = bench_of(relaxing_twice(fast), rng)
    look = look_at(bench, stuck(bench), CAUSES, None, 0)
    assert look.screen.best.candidate.cause.word == "relaxation"
    best = at_its_best(bench, look)
    assert look.model.chi_square - best.chi_square > 0.8 * look.screen.best.gain
    # of noise alone one look in a hundred sees something
    left = Court(bench, held_out, CAUSES, 0).glance(best, look).screen.best
    assert left is None or left.gain < 0.1 * look.screen.best.gain


def test_what_the_network_cannot_do_is_left_to_a_cause(rng):
    bench, held_out = bench_of(lambda x, v: relaxing_twice(0.0)(x, v) + 80.0 * v, rng)
    look = look_at(bench, fitted(bench, TWO), CAUSES, None, 0)
    best = at_its_best(bench, look)
    left = Court(bench, held_out, CAUSES, 0).glance(best, look).screen.best
    assert left.candidate.cause.word == "viscous_damping"
