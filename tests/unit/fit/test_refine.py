"""Damped Gauss-Newton finds what is there, and says how it ended."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import lsq_linear
from seeds import seed_of
from unit.fit.bench import DAMPING, KELVIN_VOIGT, STIFFNESS, jacobian_of, kelvin_voigt, network, ready, run, runs

from dashpot.fit.coordinates import search_coordinates, with_point
from dashpot.fit.linear import Linear
from dashpot.fit.objective import Objective
from dashpot.fit.refine import DAMPINGS, LEAPS, PATIENCE, Outcome, candidates, leaps, refine
from dashpot.fit.starts import KEPT, refine_from_starts
from dashpot.kernel.network import compile_network


def numbers(spec, coordinates, point):
    return {slot.path: slot.value.number for slot in with_point(spec, coordinates, point).slots()}


def test_it_finds_the_numbers_that_made_the_data():
    spec, objective, coordinates = ready(KELVIN_VOIGT, runs())
    heard = []
    found = refine(objective, coordinates, coordinates.start, watch=heard.append)
    expected = {"rubber.stiffness": STIFFNESS, "oil.damping": DAMPING}
    assert numbers(spec, coordinates, found.point) == pytest.approx(expected, rel=1e-6)
    assert found.outcome is Outcome.CONVERGED
    assert found.loss < 1e-4
    assert heard == sorted(heard, reverse=True)
    assert found.loss == pytest.approx(objective.losses(coordinates.to_values(found.point))[0])


def test_a_walk_of_short_steps_is_continued_and_stays_in_its_range():
    _, _, coordinates = ready("\n        a: {element: spring, stiffness: {start: 1, bounds: [1, 1e3]}}", runs())
    trail = [np.array([0.1 * k]) for k in range(PATIENCE + 1)]
    assert leaps(coordinates, trail[:-1]) == []
    (found,) = leaps(coordinates, trail)
    ends = trail[-1] + np.outer(LEAPS, trail[-1] - trail[0])
    assert found == pytest.approx(np.minimum(ends, np.log(1e3)))
    (clipped,) = leaps(coordinates, [5.0 * place for place in trail])
    assert clipped[-1] == pytest.approx(coordinates.high)


class BentValley:
    """A floor that sinks along a circle: steps along its tangent leave it, so that they are short."""

    radius, steepness, aim = 1e3, 1e-2, 1e-2

    def residual(self, values):
        away = np.hypot(*values.T) - self.radius
        angle = np.arctan2(values[:, 1], values[:, 0])
        return np.stack([self.steepness * away, self.aim * (angle - 1.5)])

    def losses(self, values):
        return np.sqrt(np.mean(self.residual(np.atleast_2d(values)) ** 2, axis=0))

    def linearise(self, values, moves, reduce):
        at = self.residual(values[None])
        changes = [self.residual((values + move)[None]) - at for move in moves]
        yield reduce(0, np.concatenate([at[None], changes])[..., 0])


def test_a_walk_along_a_bent_valley_leaps():
    _, _, coordinates = ready(
        """
        a: {element: spring, stiffness: {start: 999.8, bounds: [1, 1e6]}}
        b: {element: damper, damping: {start: 20, bounds: [1, 1e6]}}
        """,
        runs(),
    )
    found = refine(BentValley(), coordinates, coordinates.start, steps=400)
    a, b = np.exp(found.point)
    assert np.arctan2(b, a) > 1.1  # without leaps as many steps lead to 0.99


@pytest.mark.parametrize("half_width", [0.7, 0.05])
def test_within_a_box_each_of_two_orthogonal_numbers_goes_as_far_as_it_may(half_width):
    _, _, coordinates = ready(
        """
        a: {element: spring, stiffness: {start: 1000, bounds: [1, 1e6]}}
        b: {element: damper, damping: {start: 20, bounds: [1, 1e6]}}
        """,
        runs(),
    )
    # the second one is hardly felt, and would move by e^5
    wanted = np.array([0.02, 5.0]) / coordinates.unit
    felt = np.array([4.0, 1e-6])
    gram = np.block([[np.ones((1, 1)), -(felt * wanted)[None]], [-(felt * wanted)[:, None], np.diag(felt)]])
    nothing = np.zeros(2, dtype=bool)
    linear = Linear(None, 2, coordinates.to_values(coordinates.start)[0], np.eye(2), np.ones(2), gram, nothing)
    found = candidates(linear, coordinates, coordinates.start, boxes=[half_width])[len(DAMPINGS)]
    assert found - coordinates.start == pytest.approx([np.log1p(0.02), half_width], rel=1e-9)


def test_friction_and_relaxation_are_found_from_a_distant_start():
    branches = """
        rubber: {element: spring, stiffness: {start: 3e5}}
        friction: {element: dahl, stiffness: {start: 4e4}, limit: {start: 60}}
        memory: {element: maxwell, stiffness: {start: 8e4}, relaxation_time: {start: 10 ms}}
    """
    truth = compile_network(
        network("""
        rubber: {element: spring, stiffness: 2e5}
        friction: {element: dahl, stiffness: 9e4, limit: 25}
        memory: {element: maxwell, stiffness: 3e4, relaxation_time: 30 ms}
    """)
    )

    def law(drive):
        return truth.simulate(truth.prepare(drive))

    scored = [
        run(name, amplitude, frequency, kelvin_voigt)
        for name, amplitude, frequency in (("a", 0.3e-3, 3.0), ("b", 2e-3, 3.0), ("c", 1e-3, 15.0))
    ]
    scored = [type(each)(each.name, each.kind, each.drive, law(each.drive), each.first) for each in scored]
    spec, objective, coordinates = ready(branches, scored)
    found = refine(objective, coordinates, coordinates.start, steps=80)
    assert list(numbers(spec, coordinates, found.point).values()) == pytest.approx(
        [2e5, 9e4, 25.0, 3e4, 0.03], rel=1e-3
    )


def test_a_bound_holds_and_the_others_go_on():
    scored = runs()
    spec = network("""
        rubber: {element: spring, stiffness: {start: 1.1e5, bounds: [1e5, 1.5e5]}}
        oil: {element: damper, damping: {start: 1000, bounds: [1, 1e5]}}
    """)
    objective, coordinates = Objective(compile_network(spec), scored), search_coordinates(spec)
    found = refine(objective, coordinates, coordinates.start)
    stiffness, damping = coordinates.to_values(found.point)[0]
    assert stiffness == pytest.approx(1.5e5)
    # what remains is a regression on the velocity, each run weighing the same
    pairs = [
        (each.drive.velocity[each.first :], (each.force - 1.5e5 * each.drive.displacement)[each.first :])
        for each in scored
    ]
    best = sum(v @ f / v.size for v, f in pairs) / sum(v @ v / v.size for v, _ in pairs)
    assert damping == pytest.approx(best, rel=1e-5)


@pytest.mark.parametrize("limit", [1.2e5, 0.7e5, 0.3e5])
def test_what_a_bound_takes_from_a_number_the_others_make_up_for_at_once(limit):
    """Three branches that resemble one another, linear in their numbers: the least squares within the bounds."""
    memory = "element: maxwell, relaxation_time: 30 ms"
    branches = f"""
        rubber: {{element: spring, stiffness: {{start: 1e5, bounds: [1e3, 1e6], scale: linear}}}}
        memory: {{{memory}, stiffness: {{start: 2e4, bounds: [1e4, {limit}], scale: linear}}}}
        oil: {{element: damper, damping: {{start: 10, bounds: [1, 600], scale: linear}}}}
    """
    truth = compile_network(
        network(f"""
        rubber: {{element: spring, stiffness: 2e5}}
        memory: {{{memory}, stiffness: 1e5}}
        oil: {{element: damper, damping: 500}}
    """)
    )
    scored = [run(name, 1e-3, frequency, kelvin_voigt) for name, frequency in (("slow", 3.0), ("fast", 9.0))]
    scored = [replace(each, force=truth.simulate(truth.prepare(each.drive))) for each in scored]
    _, objective, coordinates = ready(branches, scored)
    residual, jacobian = jacobian_of(objective, coordinates, coordinates.start)
    sides = [(side - coordinates.start) / coordinates.unit for side in (coordinates.low, coordinates.high)]
    exact = coordinates.start + lsq_linear(jacobian.T, -residual, sides, "bvls").x * coordinates.unit
    found = refine(objective, coordinates, coordinates.start, steps=1)
    assert found.loss == pytest.approx(objective.losses(coordinates.to_values(exact))[0], rel=1e-6, abs=1e-6)
    assert found.point == pytest.approx(exact, rel=1e-4)


def test_a_number_that_may_not_go_as_far_as_it_would_does_not_hold_up_the_others():
    """The damping grows tenfold at the most; sine and cosine being orthogonal, the stiffness is found beside it."""
    branches = """
        rubber: {element: spring, stiffness: {start: 1e5, bounds: [1e3, 1e6], scale: linear}}
        oil: {element: damper, damping: {start: 0.02, bounds: [0.01, 1e5]}}
    """
    spec, objective, coordinates = ready(branches, runs())
    found = numbers(spec, coordinates, refine(objective, coordinates, coordinates.start, steps=1).point)
    assert found["rubber.stiffness"] == pytest.approx(STIFFNESS, rel=0.01)
    assert found["oil.damping"] == pytest.approx(0.2, rel=0.01)


def test_what_is_linear_in_a_number_is_found_in_one_step_upwards():
    """Of a force in proportion to a number the linear forecast is exact, though its logarithm is searched."""
    _, objective, coordinates = ready("rubber: {element: spring, stiffness: {start: 4e4, bounds: [1e3, 1e6]}}", runs())
    ((stiffness,),) = coordinates.to_values(refine(objective, coordinates, coordinates.start, steps=1).point)
    ((exact,),) = coordinates.to_values(refine(objective, coordinates, coordinates.start).point)
    assert exact > 1.5e5 and stiffness == pytest.approx(exact, rel=1e-4)


def without_hope(damping):
    spec = network(f"""
        rubber: {{element: spring, stiffness: {{start: 1.5e5, bounds: [1e4, 1e6]}}}}
        oil: {{element: damper, damping: {{start: {damping!r}, bounds: [0.01, 1e6]}}}}
    """)
    objective, coordinates = Objective(compile_network(spec), runs()), search_coordinates(spec)
    found = refine(objective, coordinates, coordinates.start, tolerance=1e-12, hopeless=lambda point, loss: True)
    return found.outcome, numbers(spec, coordinates, found.point)["oil.damping"]


def test_a_refinement_without_hope_is_left_behind():
    assert without_hope(2.0 * DAMPING)[0] is Outcome.LEFT_BEHIND


def test_points_that_are_equal_are_simulated_once():
    branches = "rub: {element: dahl, stiffness: {start: 1e5, bounds: [1e3, 1e6]}, limit: {start: 60, bounds: [1, 1e3]}}"
    _, objective, coordinates = ready(branches, runs())
    asked = []

    class Watched:
        linearise = objective.linearise

        def losses(self, values):
            asked.append(values)
            return objective.losses(values)

    found = refine(Watched(), coordinates, coordinates.start)
    assert all(len(np.unique(values, axis=0)) == len(values) for values in asked)
    # at the end steps are shorter than all boxes
    assert len(asked[1]) > len(asked[-1]) and found.evaluations > sum(map(len, asked))


def test_hope_is_asked_for_with_each_point_and_its_loss():
    branches = "rub: {element: dahl, stiffness: {start: 1e5, bounds: [1e3, 1e6]}, limit: {start: 60, bounds: [1, 1e3]}}"
    _, objective, coordinates = ready(branches, runs())
    told = []
    refine(objective, coordinates, coordinates.start, hopeless=lambda point, loss: bool(told.append((point, loss))))
    losses = [loss for _, loss in told]
    assert len(told) > 1 and losses == sorted(losses, reverse=True)
    assert objective.losses(coordinates.to_values(np.array([point for point, _ in told]))) == pytest.approx(losses)


def test_a_number_that_has_dwindled_may_grow_back_before_hope_is_lost():
    decades = np.random.default_rng(seed_of("test_refine")).uniform(2.5, 4.4)
    outcome, damping = without_hope(DAMPING / 10.0**decades)
    # ten times a step, then two steps of Newton's in the logarithm
    assert 0.5 * DAMPING < damping < 2.0 * DAMPING, outcome


def test_it_says_when_the_steps_were_spent():
    _, objective, coordinates = ready(KELVIN_VOIGT, runs())
    assert refine(objective, coordinates, coordinates.start, steps=1).outcome is Outcome.STEPS_SPENT


def test_a_start_that_cannot_be_simulated_is_told():
    scored = runs(lambda x, v, a: np.full(x.size, np.nan))
    spec = network("it: {element: spring, stiffness: {start: 1e5, bounds: [1e4, 1e6]}}")
    objective, coordinates = Objective(compile_network(spec), scored), search_coordinates(spec)
    found = refine(objective, coordinates, coordinates.start)
    assert found.outcome is Outcome.FAILED and found.loss == np.inf


def test_without_anything_to_search_the_start_is_the_end():
    _, objective, coordinates = ready("it: {element: spring, stiffness: 1e5}", runs())
    found = refine(objective, coordinates, coordinates.start)
    assert (found.outcome, found.point.size, found.evaluations) == (Outcome.CONVERGED, 0, 1)
    assert found.loss == pytest.approx(objective.losses(np.array([[1e5]]))[0])


def test_the_jacobian_is_per_natural_step_on_both_sides_of_a_bound():
    spec, objective, coordinates = ready(KELVIN_VOIGT, runs())
    (slow, fast) = objective.runs
    point = np.array([np.log(STIFFNESS), np.log(DAMPING)])
    weights = [np.sqrt(objective.total / (2.0 * each.samples)) for each in (slow, fast)]
    expected = np.concatenate(
        [
            weight * STIFFNESS * each.drive.displacement[each.first :]
            for weight, each in zip(weights, (slow, fast), strict=True)
        ]
    )
    for at in (point, np.array([coordinates.high[0], np.log(DAMPING)])):
        _, jacobian = jacobian_of(objective, coordinates, at)
        stiffness = np.exp(at[0]) / STIFFNESS
        assert jacobian[0] == pytest.approx(
            stiffness * expected, rel=1e-4, abs=1e-6 * np.max(np.abs(expected)) * stiffness
        )


def test_a_parameter_without_influence_stays_where_it_is():
    branches = (
        KELVIN_VOIGT
        + "    far: {element: spring, stiffness: {deflection: [90 mm, 91 mm], force: [0, {start: 0, bounds: [-1, 1]}]}}"
    )
    spec, objective, coordinates = ready(branches, runs())
    found = refine(objective, coordinates, coordinates.start)
    assert np.isfinite(found.point).all()
    assert coordinates.to_values(found.point)[0][0] == pytest.approx(STIFFNESS, rel=0.2)


def test_several_starts_end_where_the_best_of_them_does_and_repeat_with_the_seed():
    _, objective, coordinates = ready(KELVIN_VOIGT, runs())
    heard = []
    first = refine_from_starts(objective, coordinates, 7, lambda done, loss: heard.append((done, loss)))
    again = refine_from_starts(objective, coordinates, 7, lambda done, loss: None)
    assert np.array_equal(first.refined.point, again.refined.point)
    assert first.refined.loss <= min(first.spread)
    assert list(first.spread) == sorted(first.spread)
    assert len(first.spread) in (KEPT, KEPT + 1)
    assert [loss for _, loss in first.history] == sorted((loss for _, loss in first.history), reverse=True)
    assert first.history[-1][0] == first.evaluations
    assert [done for done, _ in heard] == sorted(done for done, _ in heard) and heard[-1][0] < 1.0


def test_several_starts_of_nothing():
    _, objective, coordinates = ready("it: {element: spring, stiffness: 1e5}", runs())
    best = refine_from_starts(objective, coordinates, 0, lambda done, loss: None)
    assert best.spread == (best.refined.loss,)


def test_what_was_linearised_is_not_linearised_again_where_no_step_helped():
    class Counted(BentValley):
        asked: list[bytes] = []

        def linearise(self, values, moves, reduce):
            self.asked.append(values.tobytes())
            yield from super().linearise(values, moves, reduce)

        def losses(self, values):
            # what is lower than at the start is out of reach
            found = super().losses(values)
            return np.where(found < self.floor, 2.0 * self.floor - found, found)

    _, _, coordinates = ready(
        """
        a: {element: spring, stiffness: {start: 999.8, bounds: [1, 1e6]}}
        b: {element: damper, damping: {start: 20, bounds: [1, 1e6]}}
        """,
        runs(),
    )
    valley = Counted()
    valley.floor = BentValley().losses(coordinates.to_values(coordinates.start))[0]
    found = refine(valley, coordinates, coordinates.start)
    assert found.outcome is Outcome.CONVERGED and np.array_equal(found.point, coordinates.start)
    assert len(valley.asked) == 1
