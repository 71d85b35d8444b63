"""Curves taken out of the data."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import DT, network, run

from dashpot.data.drive import drive_from_samples
from dashpot.fit.grounding import correct_ends, free_curves, ground_curves, widest
from dashpot.fit.scored import ScoredRun
from dashpot.model.identified import Identified

SPRING = "rubber: {element: spring, stiffness: {from: quasi_static}}"
FRICTION = "friction: {element: dahl, stiffness: 5e4, limit: 50}"


def progressive(x):
    return 2e5 * x + 2e6 * x**2


def elastic(x, v, a):
    return progressive(x)


def loop(stroke: float, friction: float, name: str = "loop") -> ScoredRun:
    """Two slow triangles with a slider that yields over a millimetre."""
    quarter = np.linspace(0.0, stroke, 2000)
    x = np.concatenate([quarter, quarter[-2::-1], quarter[1:], quarter[-2::-1]])
    force, memory = np.empty(x.size), 0.0
    for k, travel in enumerate(np.diff(x, prepend=x[0])):
        side = np.sign(travel) or 1.0
        memory = side * friction + (memory - side * friction) * np.exp(-abs(travel) / 1e-3)
        force[k] = progressive(x[k]) + memory
    return ScoredRun(name, "quasi_static", drive_from_samples(DT, x, smooth=False), force, 0)


def curve_of(spec):
    return spec.curves()["rubber.stiffness"]


def force_of(spec):
    return np.array([value.number for value in curve_of(spec).values])


def test_without_friction_the_loop_is_the_curve():
    curve = curve_of(ground_curves(network(SPRING), [loop(20e-3, 0.0)]))
    assert curve.form == "table" and curve.data == "quasi_static"
    assert all(value.role == "fixed" and value.known for value in curve.values)
    force = np.array([value.number for value in curve.values])
    assert force == pytest.approx(progressive(np.array(curve.at)), abs=2.0)


def test_the_number_of_knots_may_be_given():
    spec = network("rubber: {element: spring, stiffness: {from: quasi_static, knots: 11}}")
    assert len(curve_of(ground_curves(spec, [loop(20e-3, 0.0)])).at) == 11


@pytest.mark.parametrize(("deflection", "anew"), [("[0 mm, 10 mm, 20 mm]", False), ("[-4 mm, 0 mm, 4 mm]", True)])
def test_a_table_that_does_not_span_the_runs_is_taken_anew(deflection, anew):
    """A curve of the literature about zero on a test that presses one way only."""
    spec = network(
        f"rubber: {{element: spring, stiffness: {{from: quasi_static, deflection: {deflection}, force: [-9, 0, 9]}}}}"
    )
    found = ground_curves(spec, [loop(20e-3, 0.0)])
    assert (force_of(found).tolist() == [-9.0, 0.0, 9.0]) is not anew
    if anew:
        assert force_of(found) == pytest.approx(progressive(np.array(curve_of(found).at)), abs=2.0)


def test_the_widest_loop_counts_and_the_knots_cover_all_runs():
    short, long = loop(5e-3, 0.0, "short"), loop(20e-3, 0.0, "long")
    dynamic = run("fast", 4e-3, 5.0, elastic, middle=22e-3)
    assert widest([short, dynamic, long]) is long
    assert widest([dynamic]) is None
    at = curve_of(ground_curves(network(SPRING), [short, long, dynamic])).at
    assert at[0] == pytest.approx(0.0, abs=1e-4) and at[-1] == pytest.approx(26e-3, abs=1e-6)


def test_without_a_loop_the_sweeps_give_the_curve():
    dynamic = run("fast", 8e-3, 3.0, elastic, middle=12e-3)
    curve = curve_of(ground_curves(network(SPRING), [dynamic]))
    force = np.array([value.number for value in curve.values])
    inside = (np.array(curve.at) > 4.5e-3) & (np.array(curve.at) < 19.5e-3)
    assert force[inside] == pytest.approx(progressive(np.array(curve.at))[inside], rel=0.02)


def test_friction_bends_the_ends_of_the_middle_line_and_the_correction_takes_it_out():
    spec = ground_curves(network(f"{SPRING}\n{FRICTION}"), [loop(20e-3, 50.0)])
    at = np.array(curve_of(spec).at)
    before = np.abs(force_of(spec) - progressive(at))
    corrected = correct_ends(spec, [loop(20e-3, 50.0)])
    after = np.abs(force_of(corrected) - progressive(at))
    # the ends are off by the friction, the middle is not
    assert before[0] == pytest.approx(50.0, abs=1.0) and before[-1] == pytest.approx(50.0, abs=1.0)
    assert np.max(before[8:-8]) < 0.1
    assert np.max(after) < 0.02


def test_without_a_loop_there_is_nothing_to_correct():
    dynamic = run("fast", 8e-3, 3.0, elastic, middle=12e-3)
    spec = ground_curves(network(f"{SPRING}\n{FRICTION}"), [dynamic])
    assert correct_ends(spec, [dynamic]) is spec
    fixed = network("rubber: {element: spring, stiffness: 2e5}")
    assert correct_ends(fixed, [loop(20e-3, 0.0)]) is fixed
    assert ground_curves(fixed, [dynamic]) == fixed


def test_a_curve_that_has_its_numbers_keeps_them():
    once = ground_curves(network(SPRING), [loop(20e-3, 0.0)])
    assert ground_curves(once, [loop(5e-3, 0.0)]) == once


def test_a_curve_to_be_refined_is_searched_within_its_span():
    spec = network("rubber: {element: spring, stiffness: {from: quasi_static, refine: true, knots: 2}}")
    curve = curve_of(ground_curves(spec, [loop(20e-3, 0.0)]))
    low, high = (value.number for value in curve.values)
    assert [value.role for value in curve.values] == ["identified", "identified"]
    bounds = [bound for value in curve.values for bound in value.bounds]
    assert bounds == pytest.approx([2 * low - high, high, low, 2 * high - low], rel=1e-9)
    assert curve_of(free_curves(ground_curves(network(SPRING), [loop(20e-3, 0.0)]))).refine


def test_without_a_loop_and_beyond_it_only_a_fit_can_tell_the_knots():
    dynamic = run("fast", 8e-3, 3.0, elastic, middle=16e-3)
    alone = curve_of(ground_curves(network(SPRING), [dynamic]))
    assert alone.refine and all(value.searched for value in alone.values)
    beside = curve_of(ground_curves(network(SPRING), [loop(20e-3, 0.0), dynamic]))
    assert not beside.refine
    assert [at for at, value in zip(beside.at, beside.values, strict=True) if value.searched] == [
        pytest.approx(24e-3, abs=1e-6)
    ]


def test_the_intervals_of_kept_knots_are_those_of_the_mean_of_noise():
    found = []
    for seed in range(40):
        noisy = loop(20e-3, 0.0)
        noisy.force[:] += 5.0 * np.random.default_rng([seed_of("kept knots"), seed]).standard_normal(noisy.force.size)
        curve = curve_of(ground_curves(network(SPRING), [noisy]))
        inner = range(2, len(curve.at) - 2)
        found += [low <= progressive(curve.at[k]) <= high for k in inner for low, high in [curve.values[k].interval]]
    # 94 % in 800 loops, with a standard deviation of 1 % for 40 of them
    assert 0.9 < np.mean(found) < 0.99


def test_knots_of_the_literature_give_way_to_the_runs_where_there_is_no_slow_loop_and_those_of_a_fit_do_not():
    """The file knows a spring that is five times as stiff as that of the runs."""
    curve = "{from: quasi_static, deflection: [-3 mm, 0 mm, 3 mm], force: [-3 kN, 0 kN, 3 kN]}"
    spec = network(f"rubber: {{element: spring, stiffness: {curve}}}")
    quick = [run("quick", 2e-3, 2.0, lambda x, v, a: 2e5 * x)]
    searched = ground_curves(spec, quick).curves()["rubber.stiffness"]
    assert all(value.searched for value in searched.values)
    forces = np.array([value.number for value in searched.values])
    assert np.interp(1e-3, searched.at, forces) == pytest.approx(200.0, rel=0.02)
    identified = replace(spec, identified=Identified({"data": "0123"}))
    assert ground_curves(identified, quick) == identified
