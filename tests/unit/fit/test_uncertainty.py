"""Intervals hold the truth as often as they say, and say when nothing is known."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import DAMPING, KELVIN_VOIGT, STIFFNESS, jacobian_of, network, ready, runs

from dashpot.data.drive import drive_from_path
from dashpot.fit.bootstrap import bootstrap_intervals
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.identifiability import identifiability
from dashpot.fit.linear import linearise
from dashpot.fit.noise_of_runs import white
from dashpot.fit.objective import Objective
from dashpot.fit.profile import profile_likelihood
from dashpot.fit.refine import refine
from dashpot.fit.scored import ScoredRun
from dashpot.fit.uncertainty import _quantiles, _sandwich, assess_uncertainty, widening
from dashpot.kernel.network import compile_network

NOISE = 20.0


def noisy(rng, spread=NOISE) -> list[ScoredRun]:
    return [
        ScoredRun(each.name, each.kind, each.drive, each.force + spread * rng.standard_normal(each.force.size), 0)
        for each in runs()
    ]


def assessed(branches, scored):
    _, objective, coordinates = ready(branches, scored)
    found = refine(objective, coordinates, coordinates.start)
    return coordinates, found.point, assess_uncertainty(objective, coordinates, found.point)


def test_the_intervals_hold_the_truth_in_most_of_many_repeats():
    rng = np.random.default_rng(seed_of("test_uncertainty2"))
    hits = 0
    for _ in range(40):
        _, _, known = assessed(KELVIN_VOIGT, noisy(rng))
        pairs = zip(known.intervals, (STIFFNESS, DAMPING), strict=True)
        hits += sum(low <= truth <= high for (low, high), truth in pairs)
    # 93 % of 80 intervals on so few blocks; less than 62 is five standard deviations away
    assert hits >= 62


def erring(rng) -> list[ScoredRun]:
    """Six sines of different amplitudes; the force of each errs by something of its own, the same in every cycle."""
    turn = 2.0 * np.pi * 2.0
    time = 0.005 * np.arange(1000)
    found = []
    for number in range(6):
        path = [
            1e-3 * (1.0 + 0.5 * number) * turn**order * np.sin(turn * time + 0.5 * np.pi * order) for order in range(3)
        ]
        harmonics = np.array([wave(turn * n * time) for n in (1, 2, 3) for wave in (np.sin, np.cos)])
        error = NOISE * rng.standard_normal(6) @ harmonics + 0.1 * NOISE * rng.standard_normal(time.size)
        force = STIFFNESS * path[0] + DAMPING * path[1] + error
        found.append(ScoredRun(str(number), "sine", drive_from_path(0.005, *path), force, 0))
    return found


def test_an_error_that_comes_again_in_every_cycle_is_seen_between_runs():
    """As blocks of one record it is always the same; of so many intervals hardly one would hold the truth."""
    rng = np.random.default_rng(seed_of("test_uncertainty5"))
    hits, off, told = 0, [], []
    for _ in range(30):
        coordinates, point, known = assessed(KELVIN_VOIGT, erring(rng))
        low, high = known.intervals[0]
        hits += low <= STIFFNESS <= high
        off.append((coordinates.numbers(point)[0] / STIFFNESS - 1.0) / coordinates.unit[0])
        told.append(known.errors[0])
    # 95 % of 30; fewer than 21 have a probability of 5e-4 even if it is 90 %
    assert hits >= 21
    # the standard error is the one that the intervals come from
    assert np.sqrt(np.mean(np.square(told))) > 0.5 * np.std(off)


def test_the_intervals_of_white_noise_are_those_of_linear_regression():
    rng = np.random.default_rng(seed_of("test_uncertainty3"))
    x = np.concatenate([each.drive.displacement for each in runs()])
    v = np.concatenate([each.drive.velocity for each in runs()])
    normal = np.array([[x @ x, x @ v], [x @ v, v @ v]])
    expected = 2.0 * 1.96 * NOISE * np.sqrt(np.diag(np.linalg.inv(normal)))
    widths = [[high - low for low, high in assessed(KELVIN_VOIGT, noisy(rng))[2].intervals] for _ in range(12)]
    # a single width scatters by a quarter, as it is found from twelve blocks
    assert np.mean(widths, axis=0) == pytest.approx(expected, rel=0.35)


def test_twice_the_noise_gives_twice_the_width():
    seed = seed_of("test_uncertainty")
    widths = []
    for spread in (NOISE, 2.0 * NOISE):
        _, _, known = assessed(KELVIN_VOIGT, noisy(np.random.default_rng(seed), spread))
        widths.append([high - low for low, high in known.intervals])
    assert np.array(widths[1]) / np.array(widths[0]) == pytest.approx(2.0, rel=0.05)


def test_intervals_stay_inside_the_bounds_and_parameters_at_one_are_named():
    spec = network("""
        rubber: {element: spring, stiffness: {start: 1.1e5, bounds: [1e5, 1.5e5]}}
        oil: {element: damper, damping: {start: 1000, bounds: [1, 1e5]}}
    """)
    runs = noisy(np.random.default_rng(seed_of("test_uncertainty4")))
    objective, coordinates = Objective(compile_network(spec), runs), search_coordinates(spec)
    found = refine(objective, coordinates, coordinates.start)
    known = assess_uncertainty(objective, coordinates, found.point)
    assert known.at_bound == ("rubber.stiffness",)
    assert known.intervals[0][1] == pytest.approx(1.5e5)


def test_a_parameter_that_the_data_do_not_feel_is_named_and_may_be_anything_in_its_range():
    branches = KELVIN_VOIGT + (
        "    far: {element: spring, stiffness: {deflection: [90 mm, 91 mm, 92 mm], "
        "force: [0, 0, {start: 1, bounds: [0, 9]}]}}"
    )
    coordinates, _, known = assessed(branches, noisy(np.random.default_rng(seed_of("test_uncertainty5"))))
    assert known.idle == ("far.stiffness[2]",)
    assert known.intervals[2] == (0.0, 9.0)
    low, high = known.intervals[0]
    assert high - low < 0.03 * STIFFNESS


def test_two_parameters_that_make_up_for_each_other_are_not_known():
    branches = """
        rubber: {element: spring, stiffness: {start: 1e5}}
        oil: {element: damper, damping: {start: 100, bounds: [1, 1000]}}
        more: {element: damper, damping: {start: 300, bounds: [1, 2000]}}
    """
    coordinates, point, known = assessed(branches, noisy(np.random.default_rng(seed_of("test_uncertainty6"))))
    values = coordinates.to_values(point)[0]
    # the noise leaves the sum of both uncertain by 3 % (one standard deviation)
    assert values[1] + values[2] == pytest.approx(DAMPING, rel=0.2)
    assert known.intervals[1] == pytest.approx((1.0, 1000.0))
    assert known.intervals[2] == pytest.approx((1.0, 2000.0))
    low, high = known.intervals[0]
    assert high - low < 0.03 * STIFFNESS


def products(residual, jacobian, blocks):
    rows = np.vstack([residual, jacobian])
    return [rows[:, block] @ rows[:, block].T for block in blocks]


def test_the_variance_of_a_mean_is_that_of_the_block_means():
    rng = np.random.default_rng(seed_of("test_uncertainty7"))
    blocks = [slice(k, k + 30) for k in range(0, 240, 30)]
    residual = rng.standard_normal(240)
    residual -= residual.mean()
    column = np.ones((1, 240))
    root = np.array([[240.0**-0.5]])
    covariance, freedom = _sandwich(products(residual, column, blocks), root)
    means = [residual[block].mean() for block in blocks]
    assert covariance[0, 0] == pytest.approx(np.var(means, ddof=1) / 8)
    assert freedom[0] == pytest.approx(8.0)


def test_a_number_that_shows_in_few_blocks_has_few_degrees_of_freedom():
    column = np.zeros((1, 240))
    column[0, 30:90] = 1.0
    blocks = [slice(k, k + 30) for k in range(0, 240, 30)]
    _, freedom = _sandwich(products(np.zeros(240), column, blocks), np.array([[60.0**-0.5]]))
    assert freedom[0] == pytest.approx(2.0)
    # Student's t: 4.303 for two degrees of freedom, 1.960 for very many
    assert _quantiles(np.array([2.0, 1e9])) == pytest.approx([4.302653, 1.959964], rel=1e-5)


class Unsolved(Objective):
    """An objective without a solution where the slots in ``walls`` move up; or down, where ``both`` is set."""

    walls: tuple[int, ...] = ()
    both = False

    def linearise(self, values, moves, reduce):
        def lost(number, rows):
            for row, move in zip(rows[1:], moves[:, self.walls], strict=True):
                if np.any(move if self.both else move > 0.0):
                    row[:] = np.nan
            return reduce(number, rows)

        return super().linearise(values, moves, lost)


def at_a_wall(both: bool):
    scored = noisy(np.random.default_rng(seed_of("test_uncertainty8")))
    spec, plain, coordinates = ready(KELVIN_VOIGT, scored)
    walled = Unsolved(compile_network(spec), scored)
    walled.walls, walled.both = (int(coordinates.which[0]),), both
    point = refine(plain, coordinates, coordinates.start).point
    return [assess_uncertainty(each, coordinates, point) for each in (plain, walled)], coordinates


def test_a_number_that_can_move_one_way_only_is_known_as_well():
    (plain, walled), _ = at_a_wall(both=False)
    assert np.array(walled.intervals) == pytest.approx(np.array(plain.intervals), rel=1e-4)


def test_the_interval_of_a_number_that_cannot_move_is_its_whole_range():
    (_, walled), coordinates = at_a_wall(both=True)
    assert walled.intervals[0] == pytest.approx(np.exp([coordinates.low[0], coordinates.high[0]]))
    assert np.isfinite(walled.widths[1])
    assert walled.idle == ()


@pytest.mark.parametrize("both", [False, True])
def test_no_user_of_a_jacobian_sees_what_could_not_be_moved(both):
    # one mask for all: refinement, intervals, profile, refits and identifiability go through, and the rest is known
    scored = noisy(np.random.default_rng(seed_of("test_uncertainty8")))
    spec, plain, coordinates = ready(KELVIN_VOIGT, scored)
    walled = Unsolved(compile_network(spec), scored)
    walled.walls, walled.both = (int(coordinates.which[0]),), both
    unsolved = linearise(walled, coordinates, coordinates.start).unsolved
    residual, jacobian = jacobian_of(walled, coordinates, coordinates.start)
    assert unsolved.tolist() == [both, False] and np.isfinite(jacobian).all() and np.any(jacobian[1])
    assert not both or not np.any(jacobian[0])
    refined = refine(walled, coordinates, coordinates.start)
    assert np.isfinite(refined.point).all() and (refined.point[0] == coordinates.start[0]) is np.bool_(both)
    noise = white({run.name: 20.0 for run in scored}, scored[0].drive.dt)
    known = identifiability(walled, coordinates, refined.point, noise)
    assert known.unsolved == (("rubber.stiffness",) if both else ())
    assert ("rubber.stiffness" in known.undetermined) is both
    assert np.isfinite(profile_likelihood(walled, coordinates, refined.point, 1, None).losses).all()
    groups = [(run.kind, run.name) for run in scored]
    assert np.isfinite(bootstrap_intervals(walled, coordinates, refined.point, groups, 3, 1)).all()


def test_a_model_that_errs_has_wider_intervals_and_one_at_the_noise_has_not():
    _, objective, coordinates = ready(KELVIN_VOIGT, noisy(np.random.default_rng(seed_of("test_uncertainty9"))))
    found = refine(objective, coordinates, coordinates.start)
    plain, right, wrong = (
        assess_uncertainty(objective, coordinates, found.point, noise=noise).widths
        for noise in (None, 1.01 * found.loss, 0.5 * found.loss)
    )
    assert right == pytest.approx(plain)
    assert wrong == pytest.approx(plain * widening(1.0, 0.5))
    assert widening(1.0, 0.5) > 2.0
