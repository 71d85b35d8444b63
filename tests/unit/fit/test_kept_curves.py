"""A curve that is kept as the slow loop gives it; truth: a spring in closed form, a Maxwell branch exact."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import jacobian_of, network

from dashpot.data.drive import drive_from_samples
from dashpot.fit.grounding import ground_curves
from dashpot.fit.kept_curves import kept_curves, refinement
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import refine
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network

CURVE = "rubber: {element: spring, stiffness: {from: quasi_static, knots: 12}}"
FREE_CURVE = "rubber: {element: spring, stiffness: {from: quasi_static, refine: true, knots: 12}}"
MAXWELL = "slow: {element: maxwell, stiffness: {start: 2e4}, relaxation_time: {start: 3}}"
STIFFNESS, RELAXATION_TIME = 4e4, 6.0


def elastic(x):
    return 2e5 * x + 2e6 * x**2


def relaxing(x, dt):
    """Force of a Maxwell branch along straight pieces of path, exact on each."""
    fading = np.exp(-dt / RELAXATION_TIME)
    gain = STIFFNESS * (1.0 - fading) * RELAXATION_TIME / dt
    force = np.zeros(x.size)
    for k, travel in enumerate(np.diff(x)):
        force[k + 1] = fading * force[k] + gain * travel
    return force


def run(name: str, kind: str, x, dt: float, force, first: int = 0) -> ScoredRun:
    return ScoredRun(name, kind, drive_from_samples(dt, x, smooth=False), force, first)


def measured(more, noise: float = 0.0) -> list[ScoredRun]:
    """Two slow triangles over 20 mm in 40 s, and a sine of 3 mm about 10 mm; ``more(x, dt)`` on top of the spring."""
    rng = np.random.default_rng(seed_of("kept curves"))
    quarter = np.linspace(0.0, 20e-3, 1001)
    slow = np.concatenate([quarter, quarter[-2::-1], quarter[1:], quarter[-2::-1]])
    fast = 10e-3 + 3e-3 * np.sin(2.0 * np.pi * 4.0 * 1e-3 * np.arange(2000))
    found = []
    for name, kind, x, dt in (("slow", "quasi_static", slow, 0.02), ("fast", "harmonic", fast, 1e-3)):
        force = elastic(x) + more(name, x, dt) + noise * rng.standard_normal(x.size)
        found.append(run(name, kind, x, dt, force))
    return found


def fitted(branches: str, runs: list[ScoredRun]):
    spec = with_ranges(ground_curves(network(branches), runs), natural_sizes(runs))
    whole = refinement(spec, Objective(compile_network(spec), runs), lambda slot: True)
    return whole.at(refine(whole.loss, whole.coordinates, whole.coordinates.start, 60).point)


def curve(spec):
    table = spec.curves()["rubber.stiffness"]
    return np.array(table.at), np.array([value.number for value in table.values])


def stiffer_when_fast(name, x, dt):
    return 6e4 * (x - 10e-3) if name == "fast" else np.zeros(x.size)


def test_a_kept_curve_is_that_of_the_slow_loop_however_a_model_errs_elsewhere():
    runs = measured(stiffer_when_fast, noise=2.0)
    kept, free = (fitted(branches, runs) for branches in (CURVE, FREE_CURVE))
    at, force = curve(kept)
    assert force == pytest.approx(elastic(at), abs=3.0)
    assert all(value.known and not value.searched for value in kept.curves()["rubber.stiffness"].values)
    # free to move, it takes half of what the fast run is stiffer by
    at, force = curve(free)
    assert np.max(np.abs(force - elastic(at))) > 50.0


def test_a_kept_curve_gives_way_to_what_another_branch_does_in_the_slow_loop():
    runs = measured(lambda name, x, dt: relaxing(x - x[0], dt), noise=2.0)
    spec = fitted(f"{CURVE}\n{MAXWELL}", runs)
    at, force = curve(spec)
    numbers = {slot.path: slot.value.number for slot in spec.slots()}
    assert numbers["slow.stiffness"] == pytest.approx(STIFFNESS, rel=0.01)
    assert numbers["slow.relaxation_time"] == pytest.approx(RELAXATION_TIME, rel=0.02)
    assert force == pytest.approx(elastic(at), abs=8.0)
    # the mid line itself is far from the spring
    assert np.max(np.abs(curve(ground_curves(network(CURVE), runs))[1] - elastic(at))) > 60.0


def test_the_loss_beside_a_mid_line_is_the_root_mean_square_of_its_residual():
    runs = measured(stiffer_when_fast, noise=2.0)
    spec = with_ranges(ground_curves(network(f"{CURVE}\n{MAXWELL}"), runs), natural_sizes(runs))
    whole = refinement(spec, Objective(compile_network(spec), runs), lambda slot: True)
    coordinates, point = whole.coordinates, whole.coordinates.start
    residual, jacobian = jacobian_of(whole.loss, coordinates, point)
    (loss,) = whole.loss.losses(coordinates.to_values(point))
    assert loss == pytest.approx(
        np.sqrt(
            np.mean(residual[: whole.loss.objective.total] ** 2)
            + np.sum(residual[whole.loss.objective.total :] ** 2) / whole.loss.objective.total
        ),
        rel=1e-9,
    )
    step = 1e-4 * coordinates.unit
    for number in (0, 5, point.size - 1):
        there = point.copy()
        there[number] += step[number]
        moved, _ = jacobian_of(whole.loss, coordinates, there)
        assert (moved - residual) / 1e-4 == pytest.approx(jacobian[number], abs=2e-3 * np.abs(jacobian[number]).max())


def test_numbers_beside_a_curve_that_is_not_chosen_leave_it_alone():
    runs = measured(stiffer_when_fast)
    spec = with_ranges(ground_curves(network(f"{CURVE}\n{MAXWELL}"), runs), natural_sizes(runs))
    objective = Objective(compile_network(spec), runs)
    whole = refinement(spec, objective, lambda slot: slot.path.startswith("slow."))
    assert whole.loss is objective and whole.coordinates.paths == ("slow.stiffness", "slow.relaxation_time")
    assert list(kept_curves(spec)) == ["rubber.stiffness"]
    assert not kept_curves(ground_curves(network(FREE_CURVE), runs))


@pytest.mark.parametrize("branches", [f"{CURVE}\n{MAXWELL}", f"{FREE_CURVE}\n{MAXWELL}"])
def test_of_a_loss_beside_a_mid_line_the_part_of_the_data_is_known_without_simulating_them(branches):
    runs = measured(lambda name, x, dt: relaxing(x, dt), noise=2.0)
    spec = with_ranges(ground_curves(network(branches), runs), natural_sizes(runs))
    objective = Objective(compile_network(spec), runs)
    whole = refinement(spec, objective, lambda slot: True)
    point = whole.coordinates.start + 0.2 * whole.coordinates.unit
    values = whole.coordinates.to_values(point)
    alone = np.sqrt(
        np.mean([np.mean(misfit**2) for misfit in np.split(objective.misfits(values)[0], [runs[0].samples])])
    )
    assert whole.of_data(point, float(whole.loss.losses(values)[0])) == pytest.approx(alone, rel=1e-9)
