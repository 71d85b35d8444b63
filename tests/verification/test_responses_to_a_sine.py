"""Elements against the harmonics and loops that follow from their laws for a sine."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import dawsn, gamma, hyp2f1
from verification.alone import dynamic_stiffness, last_cycle


def harmonics(element, amplitude, frequency, cycles, samples, count=3, **numbers):
    """Mean, sine parts a_k and cosine parts b_k of the force for x = amplitude sin."""
    angle, _, force = last_cycle(element, amplitude, frequency, cycles, samples, **numbers)
    turns = np.outer(np.arange(1, count + 1), angle)
    return np.mean(force), 2.0 / samples * (np.sin(turns) @ force), 2.0 / samples * (np.cos(turns) @ force)


@pytest.mark.parametrize("frequency", [2.0, 8.0, 10.0, 12.0, 25.0])
@pytest.mark.parametrize("chamber", [0.0, 4e4])
def test_a_hydro_element_has_the_dynamic_stiffness_of_its_formula(frequency, chamber):
    mass, wall, damping, omega = 50.0, 2e5, 1.6e3, 2.0 * np.pi * frequency
    track = chamber - mass * omega**2 + 1j * omega * damping
    found = dynamic_stiffness(
        "hydro",
        1e-3,
        frequency,
        60,
        200,
        fluid_mass=mass,
        stiffness=wall,
        damping=damping,
        compensation_stiffness=chamber,
    )
    # 60 cycles with a damping constant of at least 16/s; the cubic between samples is good to (2 pi/200)^4/384
    assert abs(found - wall * track / (wall + track)) < (2e-8 + np.exp(-16.0 * 60.0 / frequency)) * wall


@pytest.mark.parametrize("frequency", [2.0, 8.0, 10.0, 12.0, 25.0])
def test_an_absorber_has_the_dynamic_stiffness_of_its_formula(frequency):
    mass, stiffness, damping, omega = 5.0, 2e4, 160.0, 2.0 * np.pi * frequency
    hung = stiffness + 1j * omega * damping
    found = dynamic_stiffness(
        "vibration_absorber", 1e-3, frequency, 60, 200, mass=mass, stiffness=stiffness, damping=damping
    )
    # 60 cycles with a damping constant of 16/s; the cubic between samples is good to (2 pi/200)^4/384
    expected = -mass * omega**2 * hung / (hung - mass * omega**2)
    assert abs(found - expected) < (2e-8 + np.exp(-16.0 * 60.0 / frequency)) * abs(hung)


@pytest.mark.parametrize("order", [0.03, 0.1, 0.3, 0.7])
@pytest.mark.parametrize(("frequency", "loss"), [(0.1, 0.03), (1.0, 7e-3), (10.0, 7e-3), (25.0, 7e-3), (100.0, 0.03)])
def test_a_springpot_has_a_loss_angle_that_does_not_change_with_frequency(order, frequency, loss):
    found = dynamic_stiffness("springpot", 1e-3, frequency, 12, 400, stiffness=1e5, order=order)
    # within the cycles the slowest branches have not all settled: they add to the mean force, not to the harmonic
    assert abs(found) == pytest.approx(1e5 * frequency**order, rel=4e-3)
    assert found.imag / found.real == pytest.approx(np.tan(0.5 * np.pi * order), rel=loss + 5e-3)


def test_the_harmonics_of_a_clearance_are_those_of_its_dead_zone():
    stiffness, gap, amplitude = 2.2e5, 0.05e-3, 2e-3
    mean, a, b = harmonics("clearance", amplitude, 5.0, 1, 4000, stiffness=stiffness, gap=gap)
    edge = gap / amplitude
    inside = 2.0 / np.pi * (np.arcsin(edge) + edge * np.sqrt(1.0 - edge**2))
    assert a[0] == pytest.approx(stiffness * amplitude * (1.0 - inside), rel=1e-6)
    # for a short gap 4/pi of it is missing in the first harmonic and a third of that in the third one
    assert a[0] == pytest.approx(stiffness * (amplitude - 4.0 / np.pi * gap), rel=1e-3)
    assert a[2] == pytest.approx(-4.0 / (3.0 * np.pi) * stiffness * gap, rel=1e-2)
    assert np.abs(b).max() < 1e-9 * a[0]
    assert abs(mean) < 1e-9 * a[0]


def test_backlash_gives_back_the_work_of_its_parallelogram():
    stiffness, gap, amplitude = 2.2e5, 0.05e-3, 2e-3
    found = dynamic_stiffness("backlash", amplitude, 5.0, 2, 4000, stiffness=stiffness, gap=gap)
    # a loop of width 2 gap and height 2 stiffness (amplitude - gap), against the sense of friction
    expected = -4.0 * gap * stiffness * (amplitude - gap) / (np.pi * amplitude**2)
    assert found.imag == pytest.approx(expected, rel=1e-5)


def test_loose_friction_dissipates_where_it_slides_only():
    stiffness, limit, gap, amplitude = 2.2e5, 60.0, 0.4e-3, 2e-3
    found = dynamic_stiffness("loose_friction", amplitude, 5.0, 3, 8000, limit=limit, stiffness=stiffness, gap=gap)
    # of every half cycle the slider takes what play and spring leave of the stroke
    work = 4.0 * limit * (amplitude - gap - limit / stiffness)
    assert found.imag == pytest.approx(work / (np.pi * amplitude**2), rel=1e-5)


def test_an_asymmetric_damper_has_a_mean_force_of_one_and_a_half_its_second_harmonic():
    compression, rebound, amplitude, frequency = 500.0, 1500.0, 2e-3, 10.0
    mean, a, b = harmonics("asymmetric_damper", amplitude, frequency, 1, 4000, compression=compression, rebound=rebound)
    speed, half = 2.0 * np.pi * frequency * amplitude, 0.5 * (compression - rebound)
    assert b[0] == pytest.approx(0.5 * (compression + rebound) * speed, rel=1e-6)
    assert mean == pytest.approx(2.0 / np.pi * half * speed, rel=1e-6)
    assert mean / b[1] == pytest.approx(1.5, rel=1e-5)
    assert np.abs(a).max() < 1e-9 * b[0]


def test_a_digressive_damper_has_half_the_force_at_its_knee():
    numbers = {"compression": 1000.0, "rebound": 3000.0, "compression_digression": 10.0, "rebound_digression": 5.0}
    _, x, force = last_cycle("asymmetric_damper", 0.4 / (2.0 * np.pi), 1.0, 1, 4000, **numbers)
    velocity = 0.4 * np.cos(2.0 * np.pi * np.arange(1, 4001) / 4000)
    for knee, damping in ((0.1, 1000.0), (-0.2, 3000.0)):
        at = int(np.argmin(np.abs(velocity - knee)))
        assert force[at] == pytest.approx(0.5 * damping * velocity[at], rel=2e-3)
    assert x.size == 4000


@pytest.mark.parametrize("side", ["compression", "rebound"])
@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.8])
def test_an_asymmetric_damper_has_the_equivalent_damping_of_a_power_in_each_direction(exponent, side):
    amplitude, frequency, reference = 5e-3, 4.0, 0.05
    speed = 2.0 * np.pi * frequency * amplitude
    numbers = {"compression": 1e-2, "rebound": 1e-2, "reference": reference} | {
        side: 800.0,
        f"{side}_exponent": exponent,
    }
    _, _, b = harmonics("asymmetric_damper", amplitude, frequency, 1, 20_000, **numbers)
    # the integral of cos^(n + 1) over one half of the cycle
    half = np.sqrt(np.pi) * gamma(0.5 * exponent + 1.0) / gamma(0.5 * exponent + 1.5)
    assert b[0] == pytest.approx(800.0 * reference * (speed / reference) ** exponent * half / np.pi, rel=1e-4)


@pytest.mark.parametrize("exponent", [0.2, 0.5, 1.0, 1.7, 3.0])
def test_a_power_law_damper_has_the_equivalent_damping_of_a_sine(exponent):
    amplitude, frequency = 5e-3, 5.0
    _, a, b = harmonics("power_law_damper", amplitude, frequency, 1, 20_000, force=80.0, exponent=exponent)
    # mean of 2 |cos|^(n + 1)
    shape = 2.0 / np.sqrt(np.pi) * gamma(0.5 * exponent + 1.0) / gamma(0.5 * exponent + 1.5)
    ratio = 2.0 * np.pi * frequency * amplitude / 0.1
    assert b[0] == pytest.approx(80.0 * ratio**exponent * shape, rel=2e-4)
    assert np.abs(a).max() < 1e-9 * b[0]


@pytest.mark.parametrize("knee", [0.1, 0.6, 4.0])
@pytest.mark.parametrize("exponent", [0.2, 0.5, 1.7, 3.0])
def test_a_fluid_that_thins_has_the_equivalent_damping_of_a_sine(exponent, knee):
    amplitude, frequency = 5e-3, 5.0
    numbers = {"force": 80.0, "exponent": exponent, "knee": knee}
    _, a, b = harmonics("power_law_damper", amplitude, frequency, 1, 20_000, **numbers)
    # mean of 2 cos^2 (1 + (r/knee cos)^2)^((n - 1)/2)
    ratio = 2.0 * np.pi * frequency * amplitude / 0.1
    shape = hyp2f1(0.5 - 0.5 * exponent, 1.5, 2.0, -((ratio / knee) ** 2))
    assert b[0] == pytest.approx(80.0 * ratio * knee ** (exponent - 1.0) * shape, rel=1e-6)
    assert np.abs(a).max() < 1e-9 * b[0]


@pytest.mark.parametrize("speed", [0.05, 0.3, 2.0])
def test_a_contact_whose_friction_falls_with_speed_takes_the_work_of_its_mean_limit(speed):
    amplitude, frequency = 5e-3, 5.0
    numbers = {"limit": 40.0, "breakaway": 100.0, "stribeck_velocity": speed, "creep_velocity": 1e-5}
    _, a, b = harmonics("stribeck_curve", amplitude, frequency, 1, 20_000, **numbers)
    # the mean of exp(-(r cos)^2) over the travel of a stroke is Dawson's integral of r over r
    ratio = 2.0 * np.pi * frequency * amplitude / speed
    assert b[0] == pytest.approx(4.0 / np.pi * (40.0 + 60.0 * dawsn(ratio) / ratio), rel=1e-3)
    assert np.abs(a).max() < 1e-9 * b[0]


def test_the_harmonics_of_an_end_stop_are_those_of_a_sine_cut_off_at_half_its_height():
    stiffness, amplitude = 1e5, 4e-3
    mean, a, b = harmonics("end_stop", amplitude, 3.0, 1, 6000, stiffness=stiffness, compression=0.5 * amplitude)
    unit = stiffness * amplitude
    assert (mean / unit, a[0] / unit) == pytest.approx((0.109, 0.196), abs=5e-4)
    assert (b[1] / unit, a[2] / unit) == pytest.approx((-0.138, -0.069), abs=5e-4)


def test_end_stops_stand_on_both_sides_and_grow_with_their_power():
    numbers = {"stiffness": 1e5, "compression": 2e-3, "rebound": -3e-3, "exponent": 2.5, "reference": 0.5e-3}
    _, x, force = last_cycle("end_stop", 5e-3, 3.0, 1, 600, **numbers)
    deep, low = np.maximum(x - 2e-3, 0.0), np.maximum(-3e-3 - x, 0.0)
    expected = 1e5 * 0.5e-3 * ((deep / 0.5e-3) ** 2.5 - (low / 0.5e-3) ** 2.5)
    assert force == pytest.approx(expected, rel=1e-12, abs=1e-9)


def test_a_contact_is_a_rectified_sine():
    stiffness, amplitude = 1e5, 4e-3
    mean, a, b = harmonics("contact", amplitude, 3.0, 1, 6000, stiffness=stiffness)
    assert mean == pytest.approx(stiffness * amplitude / np.pi, rel=1e-6)
    assert a[0] == pytest.approx(0.5 * stiffness * amplitude, rel=1e-6)
    assert b[1] == pytest.approx(-2.0 / (3.0 * np.pi) * stiffness * amplitude, rel=1e-5)


def jenkin(stiffness, travel, amplitude):
    """K' + j K'' of a spring behind a slider that yields at a travel."""
    if amplitude <= travel:
        return complex(stiffness)
    turn = np.arccos(1.0 - 2.0 * travel / amplitude)
    loss = 4.0 * stiffness * travel / (np.pi * amplitude) * (1.0 - travel / amplitude)
    return stiffness / np.pi * (turn - 0.5 * np.sin(2.0 * turn)) + 1j * loss


@pytest.mark.parametrize("slope", [0.0, 0.6, -0.5])
@pytest.mark.parametrize("amplitude", [2e-5, 3e-4, 2e-3, 2e-2])
def test_an_iwan_element_is_a_sum_of_springs_behind_sliders(amplitude, slope):
    travels = np.geomspace(1e-4, 5e-3, 8)
    stiffnesses = 1e5 * travels**-slope / np.sum(travels**-slope)
    expected = sum(jenkin(k, t, amplitude) for k, t in zip(stiffnesses, travels, strict=True))
    found = dynamic_stiffness("iwan", amplitude, 3.0, 3, 6000, stiffness=1e5, shortest=1e-4, longest=5e-3, slope=slope)
    assert abs(found - expected) < 1e-6 * 1e5


def test_an_iwan_element_softens_by_its_stiffness_per_decade():
    # eight springs of a share each, two decades over seven distances
    small, large = (
        dynamic_stiffness("iwan", x, 3.0, 3, 2000, stiffness=1e5, shortest=1e-4, longest=1e-2) for x in (4e-4, 4e-3)
    )
    assert small.real - large.real == pytest.approx(1e5 / 8 * 7 / 2, rel=0.03)


@pytest.mark.parametrize("exponent", [0.5, 1.0])
@pytest.mark.parametrize("amplitude", [2e-5, 3e-4, 2e-3, 2e-2])
def test_a_kraus_element_is_a_sum_of_springs_behind_sliders(amplitude, exponent):
    shares = np.linspace(0.05, 0.95, 10)
    travels = 1e-3 * (shares / (1.0 - shares)) ** (1.0 / exponent)
    expected = sum(jenkin(1e4, t, amplitude) for t in travels)
    found = dynamic_stiffness("kraus", amplitude, 3.0, 3, 6000, stiffness=1e5, travel=1e-3, exponent=exponent)
    assert abs(found - expected) < 1e-6 * 1e5


@pytest.mark.parametrize("exponent", [0.6, 1.0])
def test_the_tangent_of_a_kraus_element_falls_by_the_curve_of_broken_contacts(exponent):
    """From rest to a deflection x each spring carries min(x, t_i): the slope is the share that has not slipped."""
    x, step = np.array([0.05, 0.3, 1.0, 3.0]) * 1e-3, 1e-6
    ends = np.array(
        [
            last_cycle("kraus", end, 3.0, 1, 4, stiffness=1e5, travel=1e-3, exponent=exponent)[2][0]
            for end in np.concatenate([x - step, x + step])
        ]
    )
    slope = np.diff(ends.reshape(2, -1), axis=0)[0] / (2.0 * step)
    assert slope == pytest.approx(1e5 / (1.0 + (x / 1e-3) ** exponent), abs=0.051 * 1e5)


def test_a_specimen_beds_in_once():
    amplitude, depth, stiffness = 3e-3, 2e-3, 5e4
    _, x, first = last_cycle("bedding_in", amplitude, 3.0, 1, 400, stiffness=stiffness, depth=depth)
    reach = np.maximum.accumulate(np.abs(x))
    assert first == pytest.approx(stiffness * x / (1.0 + reach / depth), rel=1e-12, abs=1e-9)
    _, x, later = last_cycle("bedding_in", amplitude, 3.0, 2, 400, stiffness=stiffness, depth=depth)
    assert later == pytest.approx(stiffness * x / (1.0 + amplitude / depth), rel=1e-12, abs=1e-9)


def test_a_specimen_stays_as_soft_as_the_runs_before_have_left_it():
    amplitude, depth, stiffness, before = 3e-3, 2e-3, 5e4, 7e-3
    numbers = {"stiffness": stiffness, "depth": depth, "before": before}
    _, x, force = last_cycle("bedding_in", amplitude, 3.0, 1, 400, **numbers)
    assert force == pytest.approx(stiffness * x / (1.0 + before / depth), rel=1e-12, abs=1e-9)
    _, x, force = last_cycle("mullins", amplitude, 3.0, 1, 400, **numbers)
    left = 1.0 - np.tanh((before**2 - x**2) / depth**2)
    assert force == pytest.approx(stiffness * x * left, rel=1e-12, abs=1e-9)
    beyond = last_cycle("mullins", amplitude, 3.0, 1, 400, stiffness=stiffness, depth=depth, before=0.5 * amplitude)
    virgin = last_cycle("mullins", amplitude, 3.0, 2, 400, stiffness=stiffness, depth=depth)
    assert beyond[2][-1] == pytest.approx(virgin[2][-1], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("widening", [0.0, 0.4])
def test_a_specimen_is_soft_on_the_way_to_where_it_was(widening):
    amplitude, depth, stiffness = 3e-3, 2e-3, 5e4
    numbers = {"stiffness": stiffness, "depth": depth, "widening": widening}
    _, x, first = last_cycle("mullins", amplitude, 3.0, 1, 400, **numbers)
    virgin = np.abs(x) >= np.maximum.accumulate(np.abs(x))
    assert first[virgin] == pytest.approx(stiffness * x[virgin], rel=1e-12, abs=1e-9)
    _, x, later = last_cycle("mullins", amplitude, 3.0, 2, 400, **numbers)
    left = 1.0 - np.tanh((amplitude**2 - x**2) / (depth**2 + widening * amplitude**2))
    assert later == pytest.approx(stiffness * x * left, rel=1e-12, abs=1e-9)


def test_a_bedded_specimen_loses_stiffness_by_the_power_of_its_exponent():
    amplitude, depth, stiffness = 3e-3, 2e-3, 5e4
    _, x, later = last_cycle("bedding_in", amplitude, 3.0, 2, 400, stiffness=stiffness, depth=depth, exponent=2.5)
    assert later == pytest.approx(stiffness * x * (1.0 + amplitude / depth) ** -2.5, rel=1e-12, abs=1e-9)


def test_friction_that_fades_slides_at_the_limit_of_its_speed():
    """At the speed of the peak, long after the reversal, the force is the limit there, whatever the approach."""
    amplitude, frequency = 5e-3, 2.0
    for decay, exponent in ((1.0, 1.0), (2.0, 0.0), (0.7, 1.5)):
        _, x, force = last_cycle(
            "stribeck",
            amplitude,
            frequency,
            2,
            4000,
            stiffness=1e6,
            limit=10.0,
            breakaway=30.0,
            stribeck_velocity=0.05,
            decay=decay,
            exponent=exponent,
        )
        middle = int(np.argmin(np.where(np.gradient(x) > 0.0, np.abs(x), np.inf)))
        expected = 10.0 + 20.0 * np.exp(-((2.0 * np.pi * frequency * amplitude / 0.05) ** decay))
        assert force[middle] == pytest.approx(expected, rel=2e-3)
