"""The error of a part that was identified by itself reaches the numbers of the whole."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import STIFFNESS, ready, runs

from dashpot.data.noise import NoiseFloor
from dashpot.fit.api import Setting
from dashpot.fit.holdout import Split
from dashpot.fit.result import Errors
from dashpot.fit.study.allowance import LEAST_SHARE, allowance, effect, force_error, force_slots
from dashpot.fit.uncertainty import assess_uncertainty

PART = 8e4
SPRINGS = f"""
    part: {{element: spring, stiffness: {PART}}}
    rest: {{element: spring, stiffness: {{start: {STIFFNESS - PART}}}}}
"""


def springs(x, v, a):
    return STIFFNESS * x


def assessed(share: float):
    rng = np.random.default_rng(seed_of("test_allowance"))
    scored = runs(springs)
    for each in scored:
        each.force[:] += rng.standard_normal(each.force.size)
    _, objective, coordinates = ready(SPRINGS, scored)
    allowed = allowance(objective.network.spec, "part", "spring", share)
    plain = assess_uncertainty(objective, coordinates, coordinates.start)
    return coordinates, plain, assess_uncertainty(objective, coordinates, coordinates.start, [allowed.step])


def test_a_stiffer_part_leaves_less_stiffness_to_the_rest():
    coordinates, _, known = assessed(0.001)
    moved = effect(coordinates, known.moved[0])["rest.stiffness"]
    assert moved == pytest.approx(-0.001 * PART, rel=1e-3)


def test_the_interval_is_wider_by_the_square_of_what_the_part_owes():
    coordinates, plain, known = assessed(0.02)
    statistical, whole = (np.diff(np.log(each.intervals[0]))[0] / 2.0 for each in (plain, known))
    owed = 1.96 * 0.02 * PART / (STIFFNESS - PART)
    assert whole == pytest.approx(np.hypot(statistical, owed), rel=1e-3)
    assert whole > 5.0 * statistical


def test_all_that_carries_force_scales_and_nothing_else():
    spec, *_ = ready(
        """
        part: {element: maxwell, stiffness: {start: 1e4}, relaxation_time: {start: 0.02}}
        other: {element: damper, damping: {start: 10}}
        """,
        runs(),
    )
    names = [slot.path for slot in spec.slots()]
    assert [names[number] for number in force_slots(spec, "part")] == ["part.stiffness"]


def judged(train: float, floor: float) -> tuple[Errors, Setting]:
    """Errors on the two sines, whose forces vary by ``STIFFNESS`` times the deviation of their motion."""
    scored = {run.name: run for run in runs(springs)}
    setting = Setting(None, scored, Split(tuple(scored), (), ""), NoiseFloor(floor, "repeats"))
    return Errors(train, None, train, {}), setting


def test_a_part_may_be_wrong_by_what_it_or_the_whole_errs_above_the_noise():
    swing = np.sqrt(np.mean([np.var(run.force[run.first :]) for run in runs(springs)]))
    good, bad = judged(5.0, 5.0), judged(13.0, 5.0)
    for pair in ((good, bad), (bad, good)):
        assert force_error(*pair) == pytest.approx(12.0 / swing, rel=1e-12)


def test_load_cells_differ_where_nothing_errs():
    assert force_error(judged(5.0, 5.0), judged(4.0, 5.0)) == LEAST_SHARE
