"""Networks with unknown nodes that have another form: elements as series of others, flight, impact, a loaded mass."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from seeds import seed_of
from verification.alone import network_of
from verification.systems import drive_of, excitation, lanes, rms, system, times
from verification.truth.linear import StateSpace
from verification.truth.motion import smooth_motion

from dashpot.kernel.solution import Status

GRAVITY = 9.81
LANES, MOTIONS, LANDINGS, IMPACTS = 24, 5, 24, 15


@pytest.fixture
def rng() -> np.random.Generator:
    seed = seed_of("test_systems_closed_forms")
    print(f"seed {seed}")
    return np.random.default_rng(seed)


def series(first: str, second: str):
    return system("", f"leg: {{series: {{first: {{element: {first}}}, second: {{element: {second}}}}}}}", "")


def solved(network, at, motion, values=None, pairs=1):
    found = network.solve(network.prepare(excitation(at, {network.outputs[0]: motion}), pairs), values)
    assert set(found.status) == {Status.GOOD}
    return found


def around(rng, number, spread=0.7):
    return number * np.exp(rng.uniform(-spread, spread, LANES))


def test_a_spring_and_a_damper_in_series_are_a_maxwell_element(rng):
    at, motion = times(0.5), smooth_motion(rng, 0.0, 3e-3)
    network = series("spring, stiffness: 20 N/mm", "damper, damping: 400 N*s/m")
    stiffness, damping = around(rng, 2e4), around(rng, 400.0)
    found = solved(network, at, motion, lanes(network, leg__first__stiffness=stiffness, leg__second__damping=damping))
    # F' = k x' - k/d F
    exact = [
        StateSpace(np.array([[-k / d]]), np.array([[0.0, k, 0.0, 0.0]]), np.ones(1), np.zeros(4)).force(motion, at)
        for k, d in zip(stiffness, damping, strict=True)
    ]
    assert np.all(rms(found.force[:, 0] - exact) < found.error[:, 0])
    assert np.all(rms(found.force[:, 0] - exact) < 1e-5 * rms(np.array(exact)))
    maxwell = network_of("maxwell", stiffness=2e4, relaxation_time=0.02)
    one = solved(network, at, motion).force[0, 0]
    assert one == pytest.approx(maxwell.simulate(maxwell.prepare(drive_of(motion, at))), abs=1e-5 * np.ptp(one))


@pytest.mark.parametrize("sharpness", [1.0, 10.0])
def test_a_spring_and_a_slider_in_series_are_a_prandtl_element(sharpness, rng, state):
    at, motions = times(0.5), [smooth_motion(rng, 0.0, 3e-3) for _ in range(MOTIONS)]
    network = series("spring, stiffness: 20 N/mm", "dahl, stiffness: 200 N/mm, limit: 20 N")
    stiffness, limit = around(rng, 2e4), around(rng, 20.0)
    values = lanes(
        network, leg__first__stiffness=stiffness, leg__second__stiffness=sharpness * stiffness, leg__second__limit=limit
    )
    prandtl = network_of("prandtl", stiffness=2e4, limit=20.0, sharpness=sharpness)
    numbers = np.repeat(prandtl.start[None], LANES, axis=0)
    for key, column in (("stiffness", stiffness), ("limit", limit)):
        numbers[:, prandtl.paths.index(f"it.{key}")] = column
    errors = np.concatenate(
        [
            rms(
                solved(network, at, motion, values).force[:, 0]
                - prandtl.simulate(prandtl.prepare(drive_of(motion, at)), numbers)
            )
            / limit
            for motion in motions
        ]
    )
    state(
        f"spring and slider {sharpness:g} times as stiff in series at 1 ms: {np.median(errors):.1e} of the limit, "
        f"largest {errors.max():.1e}"
    )
    # where the slider turns Newton's method stops up to a tenth of a micrometre beside the root
    assert np.median(errors) < 5e-5
    assert np.quantile(errors, 0.9) < 2e-4
    assert errors.max() < 5e-4


def test_a_loaded_mass_on_a_spring_moves_as_its_equation_says(rng):
    network = system(
        "{block: {hold: loaded, mass: 5 kg}, wall: ground}",
        """
        k: {element: spring, stiffness: 20 N/mm, between: [block, wall]}
        d: {element: damper, damping: 100 N*s/m, between: [block, wall]}
        """,
    )
    at, motion = times(0.5), smooth_motion(rng, 3.0, 100.0)
    run = network.prepare(excitation(at, {}, loads={"block": motion.place(at)}))
    found = network.solve(run, lanes(network, block__mass=np.array([5.0, 8.0])))
    for mass, moved in zip((5.0, 8.0), found.motion[:, 0], strict=True):
        # the place of the block stands for the force of the state space
        moves = np.array([[0.0, 1.0], [-2e4 / mass, -100.0 / mass]])
        push = np.array([[0.0] * 4, [1.0 / mass, 0.0, 0.0, 0.0]])
        exact = StateSpace(moves, push, np.array([1.0, 0.0]), np.zeros(4)).force(motion, at)
        assert np.max(np.abs(moved - exact)) < 2e-5 * np.max(np.abs(exact))
    assert found.force.shape == (2, 0, at.size)


def integrated(rate, start, at):
    """Continuous rates with a kink where something is touched: short steps."""
    found = solve_ivp(rate, (at[0], at[-1]), start, method="DOP853", rtol=1e-11, atol=1e-14, t_eval=at, max_step=4e-4)
    assert found.success
    return found.y


def test_a_block_on_a_table_flies_freely_after_it_lost_contact(rng, state):
    foot = "foot: {element: contact, stiffness: 200 N/mm, between: [table, block]}"
    network = system("{table: driven, block: {mass: 20 kg}}", foot, "9.81 m/s^2")
    at, flights, pulls, errors = times(0.5), [], [], []
    for _ in range(LANDINGS):
        motion = smooth_motion(rng, 0.0, 8e-3, 6.0, 14.0)

        def rate(t, y, motion=motion):
            return [y[1], 2e5 * max(float(motion.place(t)) - y[0], 0.0) / 20.0 - GRAVITY]

        found, y = solved(network, at, motion), integrated(rate, [-20.0 * GRAVITY / 2e5, 0.0], at)
        exact, place = 2e5 * np.maximum(motion.place(at) - y[0], 0.0), found.motion[0, 0]
        # clear of the table at three samples, and one more to either side, as it is left and met between two of them
        free = np.convolve(y[0] - motion.place(at) > 20e-6, np.ones(5), "valid") == 5.0
        flights.append(np.diff(place, 2)[1:-1][free] / 1e-6 + GRAVITY)
        pulls.append(max(0.0, -np.min(found.force)) / exact.max())
        errors.append(rms(found.force[0, 0] - exact) / exact.std())
    state(
        f"lift-off at 1 ms: error {np.median(errors):.1e} of the RMS force, largest {max(errors):.1e}; the contact "
        f"pulls by at most {max(pulls):.1e} of the largest force"
    )
    # both courses fly along parabolas, which the scheme follows exactly
    flown = np.abs(np.concatenate(flights))
    assert flown.size > 20 * LANDINGS and np.mean(flown < 2e-2) > 0.99
    # at which point of a step the table is met is chance: a single sample may miss it by more
    assert np.median(pulls) < 3e-3 and max(pulls) < 0.1
    assert np.median(errors) < 1e-3 and max(errors) < 2e-2


STOPS = """
    k: {element: spring, stiffness: 50 N/mm, between: [table, block]}
    d: {element: damper, damping: 200 N*s/m, between: [table, block]}
    stop: {element: end_stop, stiffness: 1 kN/mm, compression: 1 mm, rebound: -2 mm, between: [block, wall]}
    """


def struck(rng, at):
    """A motion (drawn until the block meets a stop) and place and speed (2, N) of the block."""
    while True:
        motion = smooth_motion(rng, 0.0, 6e-3, 3.0, 12.0)

        def rate(t, y, motion=motion):
            stop = 1e6 * (max(y[0] - 1e-3, 0.0) - max(-2e-3 - y[0], 0.0))
            pull = 5e4 * (float(motion.place(t)) - y[0]) + 200.0 * (float(motion.speed(t)) - y[1])
            return [y[1], (pull - stop) / 20.0]

        y = integrated(rate, [0.0, 0.0], at)
        if y[0].max() > 1e-3 or y[0].min() < -2e-3:
            return motion, y


def test_impacts_on_end_stops_converge_to_their_integration(rng, state):
    network = system("{table: driven, block: {mass: 20 kg}, wall: ground}", STOPS)
    at, shares, errors = times(0.4), [], []
    for _ in range(IMPACTS):
        motion, y = struck(rng, at)
        exact = 5e4 * (motion.place(at) - y[0]) + 200.0 * (motion.speed(at) - y[1])
        answers = [solved(network, at, motion, pairs=pairs) for pairs in (1, 4)]
        errors.append([rms(answer.force[0, 0] - exact) / exact.std() for answer in answers])
        shares.append(rms(answers[0].force[0, 0] - exact) / answers[0].error[0, 0])
    coarse, fine = np.array(errors).T
    order = np.median(np.log2(coarse / fine)) / 2.0
    state(
        f"impacts on end stops at 1 ms: error {np.median(coarse):.1e} of the RMS force (largest {coarse.max():.1e}), "
        f"{np.median(shares):.2f} of the estimate (largest {max(shares):.1f}), order {order:.2f}"
    )
    assert coarse.max() < 1e-2
    assert order > 1.5
    # where and when a step meets a corner is chance: single estimates fall short, most do not
    assert np.median(shares) < 1.0
