"""Springs and dashpots that go along a curve, damping that fades, heat that makes soft, masses that rattle or slide."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator
from verification.alone import network_of
from verification.test_elements_with_memory import AMPLITUDE, OMEGA, march, orders, place, relative, speed
from verification.truth.elements import integrate

from dashpot.data.drive import drive_from_path
from dashpot.kernel.energy import EnergyCounter

EXACT = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-14, "max_step": 1e-4}


def test_a_relaxing_spring_with_a_straight_curve_is_a_maxwell_element():
    _, maxwell = march("maxwell", 1e-3, stiffness=2e4, relaxation_time=0.02)
    _, found = march("relaxing_spring", 1e-3, stiffness=2e4, relaxation_time=0.02)
    # between the samples the path is cubic, the parabola leaves its bow
    assert relative(found, maxwell) < 1e-5


def test_a_relaxing_spring_fades_along_its_curve(state):
    errors = []
    for dt in (4e-3, 2e-3, 1e-3):
        time, found = march(
            "relaxing_spring", dt, stiffness="{polynomial: [2e4, 3e6, 4e9]}", relaxation_time=0.02, share=0.3
        )

        def rate(t, force):
            x = place(t)
            return 0.3 * (2e4 + 6e6 * x + 12e9 * x * x) * speed(t) - force / 0.02

        errors.append(relative(found, integrate(rate, [0.0], time)[0]))
    state(f"relaxing_spring at 4, 2, 1 ms: {', '.join(f'{error:.1e}' for error in errors)} of the largest force")
    assert np.all(orders(errors) > 2.7)
    assert errors[2] < 1e-5


def test_a_held_relaxing_spring_loses_its_force_by_its_time():
    text = "{deflection: [-10 mm, 0 mm, 5 mm, 10 mm], force: [-200 N, 0 N, 60 N, 300 N]}"
    time = 1e-3 * np.arange(400)
    ramp = np.clip((time - 0.01) / 1e-3, 0.0, 1.0)
    still = np.zeros_like(time)
    network = network_of("relaxing_spring", stiffness=text, relaxation_time=0.05)
    found = network.simulate(network.prepare(drive_from_path(1e-3, 10e-3 * ramp, still, still)))
    assert found[60] / found[20] == pytest.approx(np.exp(-0.04 / 0.05), rel=1e-9)
    assert found[11] == pytest.approx(300.0, rel=0.02)


KNOTS = np.array([-12.0, -4.0, 0.0, 3.0, 6.0, 12.0]) * 1e-3, np.array([-900.0, -150.0, 0.0, 60.0, 200.0, 1500.0])
SLOPES = {
    "2e4": np.poly1d([2e4]),
    "{polynomial: [2e4, 3e6, 4e9]}": np.poly1d([12e9, 6e6, 2e4]),
    f"{{deflection: {KNOTS[0].tolist()}, force: {KNOTS[1].tolist()}}}": PchipInterpolator(*KNOTS).derivative(),
}


@pytest.mark.parametrize(("curve", "slope"), SLOPES.items(), ids=["line", "polynomial", "table"])
def test_a_proportional_damper_goes_with_the_slope_of_its_curve(curve, slope):
    time, found = march("proportional_damper", 1e-3, stiffness=curve, time=2e-3)
    assert found == pytest.approx(2e-3 * slope(place(time)) * speed(time), abs=1e-9 * np.abs(found).max())


def test_a_fading_damper_follows_the_clock_and_nothing_else():
    time, found = march("fading_damper", 1e-3, 8.0, damping=300.0, time=0.4)
    # at the first sample a step has passed
    assert found == pytest.approx(300.0 * speed(time) * np.exp(-(time + 1e-3) / 0.4), abs=1e-9)


def test_a_worn_damper_fades_with_the_work_that_it_has_taken_up():
    time, found = march("worn_damper", 1e-3, 8.0, damping=300.0, work=2.0)

    def rate(t, work):
        return 300.0 * speed(t) ** 2 * np.exp(-work / 2.0)

    work = integrate(rate, [0.0], time)[0]
    assert work[-1] > 1.0
    assert relative(found, 300.0 * speed(time) * np.exp(-work / 2.0)) < 1e-5


def test_heat_makes_spring_and_dashpot_soft(state):
    numbers = {"stiffness": 2e4, "damping": 300.0, "power": 0.5, "time": 0.3, "ratio": 0.4}
    errors = []
    for dt in (2e-3, 1e-3, 0.5e-3):
        time, found = march("self_heating", dt, 8.0, **numbers)
        warmth = integrate(lambda t, w: [(300.0 * speed(t) ** 2 * 2.0 ** -w[0] / 0.5 - w[0]) / 0.3], [0.0], time)[0]
        expected = 2e4 * place(time) * 2.0 ** (-0.4 * warmth) + 300.0 * speed(time) * 2.0**-warmth
        errors.append(relative(found, expected))
    state(f"self_heating at 2, 1, 0.5 ms: {', '.join(f'{error:.1e}' for error in errors)} of the largest force")
    assert np.max(warmth) > 0.5
    assert np.all(orders(errors) > 1.8)
    assert errors[1] < 1e-4


def test_at_its_power_the_damping_is_halved_in_the_end():
    # half of the damping takes up the power: damping v_rms^2/2
    power = 0.5 * 300.0 * 0.5 * (AMPLITUDE * OMEGA) ** 2
    time, found = march("self_heating", 1e-3, 60.0, damping=300.0, power=power, time=1.0)
    last = time > time[-1] - 1.0 / 7.0
    assert np.max(found[last]) == pytest.approx(0.5 * 300.0 * AMPLITUDE * OMEGA, rel=0.02)


def test_heat_is_carried_over_a_rest_into_the_next_run():
    """One course of the temperature over a run, a rest and a run; the second run alone begins with what is left."""
    damping, power, cooling, rest, dt = 300.0, 0.5, 0.8, 0.7, 5e-4
    numbers = {"stiffness": 2e4, "damping": damping, "power": power, "time": cooling, "ratio": 0.4}
    time, first = march("self_heating", dt, 8.0, **numbers)

    def rate(t, w):
        return [(damping * speed(t) ** 2 * 2.0 ** -w[0] / power - w[0]) / cooling]

    warm = integrate(rate, [0.0], time)[0][-1]
    still = solve_ivp(lambda t, w: [-w[0] / cooling], (0.0, rest), [warm], **EXACT).y[0, -1]
    warmth = integrate(rate, [still], time)[0]
    moved = float(np.sum(np.gradient(place(time)) ** 2)) / dt
    left = np.expm1(np.log(2.0) * still) / np.log(2.0) * power * cooling / (damping * moved)
    assert 0.1 < left < 0.8
    found = march("self_heating", dt, 8.0, **numbers, before=moved, share=left)[1]
    expected = 2e4 * place(time) * 2.0 ** (-0.4 * warmth) + damping * speed(time) * 2.0**-warmth
    # at the first sample a step has passed
    assert relative(found[1:], expected[1:]) < 1e-4
    assert relative(first, expected) > 0.05


def test_without_cooling_a_run_begins_with_the_heat_of_the_motion_before():
    """The temperature goes on from run to run, as integrated over both, where nothing has cooled."""
    damping, heat, cooling, dt = 300.0, 0.4, 1e5, 5e-4
    numbers = {"stiffness": 2e4, "damping": damping, "power": heat / cooling, "time": cooling, "ratio": 0.4}
    time, first = march("self_heating", dt, 8.0, **numbers)

    def rate(t, w):
        return [damping * speed(t) ** 2 * 2.0 ** -w[0] / heat]

    warm = integrate(rate, [0.0], time)[0]
    again = integrate(rate, [warm[-1]], time)[0]
    assert warm[-1] > 1.5
    expected = 2e4 * place(time) * 2.0 ** (-0.4 * again) + damping * speed(time) * 2.0**-again
    moved = float(np.sum(np.gradient(place(time)) ** 2)) / dt
    found = march("self_heating", dt, 8.0, **numbers, before=moved, share=1.0)[1]
    assert relative(found[1:], expected[1:]) < 1e-3
    assert relative(first, expected) > 0.2


def test_a_rattling_mass_flies_rings_and_flies_again(state):
    """Each contact is integrated by itself, from the instant at which it begins to that at which it ends."""
    mass, stiffness, gap, loss = 0.5, 4e4, 0.6e-3, 0.8
    errors = []
    for dt in (2e-4, 1e-4, 5e-5):
        time, found = march("rattling_mass", dt, 1.0, mass=mass, stiffness=stiffness, gap=gap, loss=loss)
        _, force = flight(time, mass, stiffness, gap, loss)
        errors.append(np.sqrt(np.mean((found - force) ** 2)) / np.max(np.abs(force)))
    shown = ", ".join(f"{error:.1e}" for error in errors)
    state(f"rattling_mass at 200, 100, 50 us: {shown} of the largest force, RMS")
    assert np.count_nonzero(np.diff(np.abs(force) > 0.0)) >= 3
    assert errors[2] < 5e-3
    assert errors[2] < 0.5 * errors[0]


def test_a_contact_without_loss_keeps_its_energy_and_one_with_loss_does_not():
    lost = {}
    for loss in (0.0, 0.8):
        time = 1e-4 * np.arange(1500)
        drive = drive_from_path(1e-4, place(time), speed(time), AMPLITUDE * OMEGA**2 * np.cos(OMEGA * time))
        balance = EnergyCounter.of(network_of("rattling_mass", mass=0.5, stiffness=4e4, gap=0.6e-3, loss=loss).spec)
        found = balance.balance(drive)
        lost[loss] = found.dissipated / np.max(np.abs(found.put_in))
    assert abs(lost[0.0]) < 0.02
    assert lost[0.8] > 0.05


def flight(time, mass, stiffness, gap, loss):
    def force(t, y):
        way, rate = place(t) - y[0], speed(t) - y[1]
        side = np.sign(way)
        return side * stiffness * max(abs(way) - gap, 0.0) * max(1.0 + loss * side * rate, 0.0)

    answer = solve_ivp(
        lambda t, y: [y[1], force(t, y) / mass],
        (0.0, time[-1]),
        [0.0, 0.0],
        method="DOP853",
        rtol=1e-9,
        atol=1e-13,
        max_step=1e-4,
        t_eval=time,
    )
    return answer.y, np.array([force(t, y) for t, y in zip(time, answer.y.T, strict=True)])


def test_without_play_a_rattling_mass_is_a_mass_on_a_spring():
    _, absorber = march("vibration_absorber", 1e-4, mass=0.5, stiffness=4e4, damping=1e-2)
    _, found = march("rattling_mass", 1e-4, mass=0.5, stiffness=4e4, gap=0.0)
    assert relative(found, absorber) < 5e-3


def test_a_sliding_mass_sticks_slips_and_rings(state):
    mass, stiffness, limit, damping = 2.0, 2e4, 5.0, 3.0
    errors = []
    for dt in (4e-4, 2e-4, 1e-4):
        time, found = march("sliding_mass", dt, 2.0, mass=mass, stiffness=stiffness, limit=limit, damping=damping)
        force = slipping(time, mass, stiffness, limit, damping)
        errors.append(relative(found, force))
    state(f"sliding_mass at 400, 200, 100 us: {', '.join(f'{error:.1e}' for error in errors)} of the largest force")
    assert errors[2] < 2e-3
    assert errors[2] < 0.3 * errors[0]


def slipping(time, mass, stiffness, limit, damping):
    """Sticking and slipping by turns, each until its own event."""

    def rate(side):
        def found(t, y):
            stretch, v = y
            moving = speed(t) - v
            elastic = side * limit if side else stiffness * stretch
            return [0.0 if side else moving, (elastic + damping * moving) / mass]

        return found

    state, begin, side, forces = np.array([0.0, 0.0]), 0.0, 0, np.empty_like(time)
    while begin < time[-1]:
        if side:
            event = lambda t, y, side=side: side * (speed(t) - y[1])  # noqa: E731
            event.direction = -1.0
        else:
            event = lambda t, y: limit - abs(stiffness * y[0])  # noqa: E731
            event.direction = -1.0
        event.terminal = True
        answer = solve_ivp(rate(side), (begin, time[-1]), state, events=event, dense_output=True, **EXACT)
        here = (time >= begin) & (time <= answer.t[-1])
        y = answer.sol(time[here])
        elastic = side * limit if side else stiffness * y[0]
        forces[here] = elastic + damping * (speed(time[here]) - y[1])
        begin, state = answer.t[-1], answer.y[:, -1]
        if answer.status == 0:
            break
        side = 0 if side else int(np.sign(state[0]))
        if not side:
            begin, state = begin + 1e-12, state
    return forces


def test_a_sliding_mass_that_never_slips_is_an_absorber():
    _, absorber = march("vibration_absorber", 1e-4, mass=2.0, stiffness=2e4, damping=3.0)
    _, found = march("sliding_mass", 1e-4, mass=2.0, stiffness=2e4, damping=3.0, limit=1e6)
    assert relative(found, absorber) < 1e-3
