"""The blind truth itself: its forms against closed forms, its noise, its seeds and its seal."""

import ast
import re
import subprocess
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.special import gamma, wrightomega
from truth import FORMS, KINDS_OF_BASE, SealBroken, draw_case
from truth.axle import Inner, Numbers, platform_forces
from truth.base import draw_base
from truth.branches import integrate_dahl, integrate_prandtl
from truth.case import _Bench
from truth.channel import FirstOrderLag, PureDelay
from truth.damping import Exponential, NearlyQuadratic, Quadratic, Rational, Tanh, Viscous
from truth.design import DESIGNS, LOOP_DEPTH, Plan, drive, further
from truth.form import alternating_rms
from truth.friction import BoucWen, Coulomb, Iwan, LuGre, Masing, slide
from truth.inertia import MountedMass, RigidMass
from truth.label import proves
from truth.motion import STEP, STEPS_PER_SAMPLE, Motion, harmonic, sweep, triangle
from truth.noise import Noise
from truth.relaxation import ColeCole, Maxwell, Springpot, StretchedExponential
from truth.sensor import Channel

PACKAGE = Path(__file__).parent / "truth"
ALLOWED = sys.stdlib_module_names | {"numpy", "scipy", "numba"}
AMPLITUDE, PRELOAD = 2e-3, 20e-3


def last_cycle(frequency, *series):
    """The last whole cycle of each series, sampled at every step."""
    steps = round(1 / frequency / STEP)
    return [values[-steps:] for values in series]


def complex_stiffness(motion, force, frequency):
    """First harmonic of the force over that of the displacement, in the last cycle."""
    time, x, f = last_cycle(frequency, motion.time, motion.displacement, force)
    turn = np.exp(-2j * np.pi * frequency * time)
    return (f @ turn) / (x @ turn)


def loop_area(motion, force, frequency):
    x, f = last_cycle(frequency, motion.displacement, force)
    return float(np.sum(f * (np.roll(x, -1) - np.roll(x, 1)) / 2))


def straight(speed, duration):
    """A path of constant speed."""
    time = np.arange(round(duration / STEP)) * STEP
    return Motion(time, speed * time, np.full(time.size, speed), np.zeros(time.size))


# --- what the rig does -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("motion", [sweep(2e-3, 20e-3, 1, 25, 5), triangle(36e-3, 12), harmonic(1e-3, 0.01, 7, 2)])
def test_velocity_and_acceleration_are_derivatives_of_the_displacement(motion):
    velocity = np.gradient(motion.displacement, STEP, edge_order=2)
    acceleration = np.gradient(motion.velocity, STEP, edge_order=2)
    assert np.allclose(velocity, motion.velocity, atol=2e-4 * np.abs(motion.velocity).max())
    assert np.allclose(acceleration, motion.acceleration, atol=2e-2 * np.abs(motion.acceleration).max())
    assert motion.velocity[0] == 0.0


def test_triangle_reaches_its_depth_and_comes_back():
    motion = triangle(36e-3, 12.0)
    assert motion.displacement.max() == pytest.approx(36e-3, rel=1e-9)
    assert motion.displacement[-1] == pytest.approx(0.0, abs=1e-8)


def test_full_design_is_12_sweeps_3_repeats_2_loops_in_99000_samples():
    plans = DESIGNS["full"]
    kinds = Counter((plan.dynamic, plan.repeats is None) for plan in plans)
    samples = sum(drive(plan.path).time[::STEPS_PER_SAMPLE].size for plan in plans)
    assert (kinds, samples) == (
        Counter({(True, True): 12, (True, False): 3, (False, True): 1, (False, False): 1}),
        99_000,
    )


# --- friction ----------------------------------------------------------------------------------------------------


def test_lugre_sliding_steadily_carries_its_stribeck_level():
    for speed in (1e-3, 20e-3, 0.2):
        form = LuGre(travel=0.1e-3, stiction=0.2, stribeck_speed=20e-3)
        level = 1 + 0.2 * np.exp(-((speed / 20e-3) ** 2))
        assert form.shape(straight(speed, 2e-3 / speed))[-1] == pytest.approx(level, rel=1e-6)


def test_lugre_far_below_the_stribeck_speed_is_coulomb_friction():
    form = LuGre(travel=0.1e-3, stiction=0.0, stribeck_speed=20e-3)
    assert form.shape(straight(-1e-3, 4.0))[-1] == pytest.approx(-1.0, rel=1e-9)


def test_bouc_wen_of_power_one_without_pinching_has_the_area_of_a_dahl_loop():
    travel, amplitude = 0.5e-3, 1e-3
    motion = harmonic(amplitude, 0.0, 1.0, 6.0)
    area = loop_area(motion, BoucWen(travel, 1.0, 1.0).shape(motion), 1.0)
    assert area == pytest.approx(4 * (amplitude - travel * np.tanh(amplitude / travel)), rel=2e-3)


@pytest.mark.parametrize("power", [1.0, 2.0, 2.7])
def test_bouc_wen_slides_at_one_newton(power):
    assert BoucWen(0.1e-3, power, 0.6).shape(straight(5e-3, 0.5))[-1] == pytest.approx(1.0, rel=1e-6)


def test_one_slider_has_the_stiffness_of_a_jenkin_element():
    travel, amplitude = 0.3e-3, 1e-3
    motion = harmonic(amplitude, PRELOAD, 1.0, 4.0)
    force = slide(motion.displacement, np.ones(1), np.full(1, travel))
    angle = np.arccos(1 - 2 * travel / amplitude)
    storage = (angle - np.sin(2 * angle) / 2) / (np.pi * travel)
    loss = 4 / (np.pi * amplitude) * (1 - travel / amplitude)
    assert complex_stiffness(motion, force, 1.0) == pytest.approx(complex(storage, loss), rel=1e-4)


def test_iwan_is_the_sum_of_its_sliders():
    form, amplitude = Iwan(travel=0.2e-3, spread=0.8), 1e-3
    motion = harmonic(amplitude, PRELOAD, 1.0, 4.0)
    quantiles = np.linspace(-2, 2, form.sliders)
    limits = np.exp(-(quantiles**2) / 2)
    slip = np.maximum(1 - 0.2e-3 * np.exp(0.8 * quantiles) / amplitude, 0.0)
    loss = 4 / (np.pi * amplitude) * (limits @ slip) / limits.sum()
    assert complex_stiffness(motion, form.shape(motion), 1.0).imag == pytest.approx(loss, rel=1e-4)


def test_regularised_coulomb_dissipates_like_dry_friction():
    motion = harmonic(AMPLITUDE, PRELOAD, 5.0, 2.0)
    area = loop_area(motion, Coulomb(0.5e-3).shape(motion), 5.0)
    assert area == pytest.approx(4 * AMPLITUDE, rel=1e-3)


def test_masing_loop_has_the_area_of_ramberg_osgood():
    # W = 4 (n - 1) / (n + 1) peak force * plastic travel
    form, amplitude = Masing(travel=0.1e-3, power=8.0), 1e-3
    motion = harmonic(amplitude, 0.0, 1.0, 4.0)
    force = form.shape(motion)
    peak = np.abs(last_cycle(1.0, force)[0]).max()
    plastic = 0.5 * peak**8 * form.travel
    assert peak + 0.5 * peak**8 == pytest.approx(amplitude / form.travel, rel=1e-5)
    assert loop_area(motion, force, 1.0) == pytest.approx(4 * 7 / 9 * peak * plastic, rel=1e-3)


def test_masing_remembers_the_outer_loop_through_an_inner_one():
    form = Masing(travel=0.1e-3, power=8.0)
    turns = np.array([0.0, 1.0, -0.5, 0.2, -0.5, 1.0]) * 1e-3
    path = np.concatenate([np.linspace(a, b, 4001)[1:] for a, b in zip(turns, turns[1:], strict=False)])
    force = form.shape(Motion(path, path, path, path))
    assert force[3999] == pytest.approx(force[-1], rel=1e-9)
    assert force[7999] == pytest.approx(force[15999], rel=1e-9)


@pytest.mark.parametrize("form", FORMS["friction"])
def test_friction_is_odd_in_the_motion(form, seed):
    friction = form.draw(np.random.default_rng(seed))
    there = harmonic(AMPLITUDE, 0.0, 3.0, 1.0)
    back = Motion(there.time, -there.displacement, -there.velocity, -there.acceleration)
    assert np.allclose(friction.shape(back), -friction.shape(there), atol=1e-12)


# --- relaxation --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [0.1, 0.3, 0.5])
@pytest.mark.parametrize("frequency", [2.0, 25.0])
def test_springpot_has_the_loss_angle_of_its_order(order, frequency):
    motion = harmonic(AMPLITUDE, 0.0, frequency, 8.0)
    stiffness = complex_stiffness(motion, Springpot(order).shape(motion), frequency)
    assert stiffness.imag / stiffness.real == pytest.approx(np.tan(order * np.pi / 2), rel=0.02)
    assert abs(stiffness) == pytest.approx((2 * np.pi * frequency) ** order, rel=0.01)


@pytest.mark.parametrize("order", [0.4, 0.85])
def test_cole_cole_has_its_complex_stiffness(order):
    motion, turn = harmonic(AMPLITUDE, 0.0, 5.0, 4.0), 2j * np.pi * 5.0
    wanted = (turn * 20e-3) ** order / (1 + (turn * 20e-3) ** order)
    assert complex_stiffness(motion, ColeCole(20e-3, order).shape(motion), 5.0) == pytest.approx(wanted, rel=5e-3)


def test_stretched_exponential_of_power_one_is_a_maxwell_branch():
    motion, turn = harmonic(AMPLITUDE, 0.0, 5.0, 2.0), 2j * np.pi * 5.0 * 30e-3
    for form in (StretchedExponential(30e-3, 1.0), Maxwell(30e-3)):
        assert complex_stiffness(motion, form.shape(motion), 5.0) == pytest.approx(turn / (1 + turn), rel=1e-4)


def test_stretched_exponential_in_slow_motion_is_a_damper():
    power, time = 0.5, 10e-3
    force = StretchedExponential(time, power).shape(straight(2e-3, 6.0))
    assert force[-1] == pytest.approx(2e-3 * time * gamma(1 / power) / power, rel=1e-4)


@pytest.mark.parametrize("form", [Springpot(0.3), ColeCole(0.1, 0.5), StretchedExponential(1.0, 0.4)])
def test_memory_of_the_preload_is_the_relaxed_force_of_a_step(form):
    still = harmonic(0.0, PRELOAD, 1.0, 1.0)
    steps = round(30.0 / STEP) + 1
    assert form.shape(still)[1] == pytest.approx(PRELOAD * form.modulus(steps)[-1], rel=1e-3)


# --- damping, stiffness, mass, channel ---------------------------------------------------------------------------


@pytest.mark.parametrize(("form", "power"), [(Quadratic(), 2.0), (NearlyQuadratic(1.8), 1.8), (Viscous(), 1.0)])
def test_damping_has_the_loss_stiffness_of_its_power(form, power):
    motion, speed = harmonic(AMPLITUDE, PRELOAD, 4.0, 2.0), 2 * np.pi * 4.0
    loss = 2 / np.sqrt(np.pi) * gamma(power / 2 + 1) / gamma(power / 2 + 1.5) * (speed * AMPLITUDE) ** power / AMPLITUDE
    stiffness = complex_stiffness(motion, form.shape(motion), 4.0)
    assert stiffness == pytest.approx(1j * loss, rel=1e-4, abs=1e-3 * loss)


@pytest.mark.parametrize("form", [Exponential(10e-3), Exponential(-8e-3), Tanh(20e-3, 5e-3), Rational(10e-3, 2.0)])
def test_preload_dependent_damping_never_feeds_energy(form):
    level = form.level(np.linspace(0.0, LOOP_DEPTH, 100))
    assert (level > 0).all()
    assert (np.diff(level) < 0).all() or (np.diff(level) > 0).all()


@pytest.mark.parametrize("form", FORMS["stiffness_curve"])
def test_stiffness_curve_is_felt_where_the_sweeps_go(form, seed):
    curve = form.draw(np.random.default_rng(seed))
    covered = [curve.shape(harmonic(5e-3, preload, 1.0, 1.0)) for preload in (10e-3, 20e-3, 30e-3)]
    at_rest = Motion(*np.zeros((4, 3)))
    assert max(np.ptp(force) for force in covered) > 0
    assert np.array_equal(curve.shape(at_rest), np.zeros(3))


def test_rigid_mass_takes_its_inertia_off_the_stiffness():
    motion = harmonic(AMPLITUDE, PRELOAD, 10.0, 1.0)
    assert complex_stiffness(motion, RigidMass().shape(motion), 10.0) == pytest.approx(-((20 * np.pi) ** 2), rel=1e-6)


def test_mounted_mass_follows_its_transfer_function():
    own, ratio, at = 2 * np.pi * 160.0, 0.05, 2j * np.pi * 25.0
    motion = harmonic(AMPLITUDE, PRELOAD, 25.0, 2.0)
    carried = (own**2 + 2 * ratio * own * at) / (own**2 + 2 * ratio * own * at + at**2)
    stiffness = complex_stiffness(motion, MountedMass(160.0, ratio).shape(motion), 25.0)
    assert stiffness == pytest.approx(at**2 * carried, rel=1e-3)


def test_pure_delay_turns_the_phase_by_its_angle():
    motion, delay = harmonic(AMPLITUDE, PRELOAD, 25.0, 1.0), 0.73e-3
    late = PureDelay().late(motion.time, motion.displacement, delay)
    assert complex_stiffness(motion, late, 25.0) == pytest.approx(np.exp(-2j * np.pi * 25.0 * delay), rel=1e-6)


def test_first_order_lag_has_its_transfer_function():
    motion, delay = harmonic(AMPLITUDE, PRELOAD, 25.0, 1.0), 0.73e-3
    late = FirstOrderLag().late(motion.time, motion.displacement, delay)
    assert complex_stiffness(motion, late, 25.0) == pytest.approx(1 / (1 + 2j * np.pi * 25.0 * delay), rel=1e-3)


# --- bases -------------------------------------------------------------------------------------------------------


def test_prandtl_branch_of_the_base_follows_the_wright_omega_solution():
    # r u + ln u = r + ln 1 - z, u = 1 - F / limit, r = 10: omega(ln r + r - z) / r
    stiffness, limit = 20e3, 10.0
    path = np.linspace(0.0, 4 * limit / stiffness, 5001)
    left = wrightomega(np.log(10.0) + 10.0 - 10.0 * stiffness * path / limit) / 10.0
    assert np.allclose(integrate_prandtl(path, stiffness, limit), limit * (1 - left), atol=1e-3 * limit)


def test_dahl_branch_of_the_base_is_its_differential_equation():
    # dF/dx = stiffness (1 - F / limit) going up, stiffness (1 + F / limit) coming back
    stiffness, limit = 80e3, 12.0
    there = np.linspace(0.0, 0.3e-3, 4001)
    path = np.concatenate([there, there[-2::-1]])
    force = integrate_dahl(path, stiffness, limit)
    middle = 0.5 * (force[1:] + force[:-1])
    slope = np.diff(force) / np.diff(path)
    assert np.allclose(slope, stiffness * (1 - np.sign(np.diff(path)) * middle / limit), atol=1e-5 * stiffness)
    assert force[there.size - 1] == pytest.approx(limit * (1 - np.exp(-there[-1] * stiffness / limit)), rel=1e-9)


@pytest.mark.parametrize("name", sorted(KINDS_OF_BASE.keys() - {"damper", "axle"}))
def test_tires_carry_a_progressive_spring(name, seed):
    base = draw_base(name, np.random.default_rng(seed))
    path = np.linspace(0.0, LOOP_DEPTH, 200)
    still = np.zeros(200)
    tangent = np.diff(base.branches["spring"].force(Motion(path, path, still, still))) / np.diff(path)
    assert (np.diff(tangent) > 0).all()
    assert 150e3 < tangent.min() and tangent.max() < 400e3


def test_a_shock_absorber_only_takes_energy_and_levels_out(seed):
    valves = draw_base("damper", np.random.default_rng(seed)).branches["valves"]
    speed = np.linspace(-0.8, 0.8, 401)
    force = valves.force(Motion(speed, speed, speed, speed))
    slope = np.diff(force)
    assert (force * speed >= 0.0).all()
    assert slope[200] > 1.5 * slope[-1] and slope[200] > 1.5 * slope[0]


@pytest.mark.parametrize("name", sorted(KINDS_OF_BASE.keys() - {"axle"}))
def test_what_a_refit_can_follow_is_left_out_of_the_strength(name, seed):
    """Every number of every branch, changed by a little, leaves nearly nothing."""
    rng = np.random.default_rng(seed)
    base, motion = draw_base(name, rng), drive((2e-3, 20e-3))
    tangents = base.tangents(motion)
    for branch in base.branches.values():
        for changed in branch.tangents(motion):
            left = changed - tangents @ np.linalg.lstsq(tangents, changed, rcond=None)[0]
            assert np.sqrt(np.mean(left**2)) <= 1e-6 * np.sqrt(np.mean(changed**2))


# --- sensor ------------------------------------------------------------------------------------------------------


def test_a_channel_shows_a_force_late_scaled_and_shifted():
    time = np.arange(20000) * STEP
    shown = Channel(2e-3, -3.0, 80e-6).shows(time, 1e3 * np.sin(40.0 * time))
    assert shown[100:] == pytest.approx(1.002e3 * np.sin(40.0 * (time[100:] - 80e-6)) - 3.0, abs=1e-5)


def test_every_run_has_other_errors_within_the_data_sheet(seed, tmp_path):
    """The same case with exact channels and with those that err: gain and zero are found again by regression."""
    for name, sensors in (("exact", False), ("erring", True)):
        draw_case(seed, "spring", "null", sensors=sensors, folder=tmp_path / name)
    gains = []
    for file in sorted((tmp_path / "exact").glob("*.npz")):
        exact, erring = np.load(file)["F"], np.load(tmp_path / "erring" / file.name)["F"]
        gains.append(np.polyfit(exact, erring - exact, 1)[0])
    assert 0.3e-3 < np.std(gains) < 2.5e-3
    assert (
        "sensors: {force: {gain: 0.1 %, zero: 1.5 N, delay: 30 us}}" in (tmp_path / "erring/dataset.yaml").read_text()
    )
    assert "sensors" not in (tmp_path / "exact/dataset.yaml").read_text()


# --- noise -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("memory", "white"), [(0.0, 0.5), (0.6, 0.3), (0.95, 0.05)])
def test_noise_has_its_size_and_colour(memory, white, seed):
    error = Noise(12.0, memory, white).sample(np.random.default_rng(seed), 1_000_000)
    correlation = [np.mean(error[lag:] * error[: error.size - lag]) / np.mean(error**2) for lag in (1, 5)]
    assert np.sqrt(np.mean(error**2)) == pytest.approx(12.0, rel=0.03)
    assert correlation == pytest.approx([(1 - white) * memory, (1 - white) * memory**5], abs=0.03)


def test_null_case_is_the_base_and_its_noise(seed, tmp_path):
    case = draw_case(seed, "ftire", "null", folder=tmp_path)
    truth = case.label.open("nothing")
    base = replace(draw_base("ftire", np.random.default_rng([seed, 0])))
    for name in ("qs", "a05_p10", "a5_p30", "a2_p10_b"):
        plan = next(plan for plan in DESIGNS["full"] if plan.name == name)
        motion, data = drive(plan.path), np.load(tmp_path / f"{name}.npz")
        error = data["F"] - base.force(motion)[::STEPS_PER_SAMPLE]
        jitter = data["x"] * 1e-3 - motion.displacement[::STEPS_PER_SAMPLE]
        assert np.sqrt(np.mean(error**2)) == pytest.approx(truth.noise_rms[name], rel=1e-9)
        assert np.sqrt(np.mean(jitter**2)) == pytest.approx(2e-6, rel=0.1)
    assert truth.effects == ()


# --- cases -------------------------------------------------------------------------------------------------------

EVERY_FORM = [(kind, form) for kind, forms in FORMS.items() for form in forms]


@pytest.mark.parametrize(("kind", "form"), EVERY_FORM, ids=[form.__name__ for _, form in EVERY_FORM])
def test_effect_is_as_strong_as_asked(kind, form, seed):
    rng = np.random.default_rng(seed)
    bench = _Bench((Plan("qs"), Plan("a", 1e-3, 10e-3), Plan("b", 5e-3, 29e-3)), draw_base("kelvin_voigt", rng))
    before = bench.forces
    hidden = bench.hide(form.draw(rng), 3.0, 10.0)
    added = [after - force for after, force in zip(bench.forces, before, strict=True)]
    assert alternating_rms(added[1:]) == pytest.approx(30.0, rel=1e-5)
    assert (hidden.kind, hidden.form) == (kind, form.__name__)
    assert hidden.size > 0
    assert hidden.rms["b"] == pytest.approx(np.sqrt(np.mean(added[2][::STEPS_PER_SAMPLE] ** 2)))


def test_damper_added_to_a_damper_leaves_nothing_and_to_a_spring_all():
    plans = (Plan("a", 1e-3, 10e-3), Plan("b", 5e-3, 20e-3))
    left = {}
    for name in ("spring", "kelvin_voigt"):
        bench = _Bench(plans, draw_base(name, np.random.default_rng(1)))
        left[name] = bench.hide(Viscous(), 1.0, 10.0).strength_left
    assert left["kelvin_voigt"] < 1e-3
    assert left["spring"] == pytest.approx(1.0, abs=0.1)


def test_same_seed_gives_the_same_bytes_and_another_seed_others(seed, tmp_path):
    folders = [
        draw_case(s, design="one_sweep", folder=tmp_path / n).folder
        for s, n in ((seed, "a"), (seed, "b"), (seed + 1, "c"))
    ]
    first, same, other = ({file.name: file.read_bytes() for file in sorted(folder.iterdir())} for folder in folders)
    assert first == same
    assert all(first[name] != other[name] for name in first)


def test_dataset_says_nothing_of_the_truth(tmp_path):
    draw_case(7, "kelvin_voigt", "friction", 3.0, folder=tmp_path)
    text = (tmp_path / "dataset.yaml").read_text()
    assert not re.search("friction|kelvin|strength|null", text)
    assert sorted(np.load(tmp_path / "qs.npz").files) == ["F", "t", "x"]


def test_dataset_lists_every_run_with_its_settings(tmp_path):
    draw_case(7, folder=tmp_path)
    text = (tmp_path / "dataset.yaml").read_text()
    assert text.startswith("format: dashpot-dataset/1\n")
    assert text.count("file: ") == len(list(tmp_path.glob("*.npz"))) == 17
    assert "amplitude: 0.5 mm, preload: 10 mm, start: 1 Hz, stop: 25 Hz" in text
    assert "repeats: a5_p30" in text


def test_one_case_in_five_is_null_and_every_kind_comes_up(tmp_path):
    from truth.case import _draw_kinds

    known = KINDS_OF_BASE["kelvin_voigt"]
    drawn = Counter(tuple(_draw_kinds(known, None, np.random.default_rng(number))) for number in range(2000))
    assert drawn[()] / 2000 == pytest.approx(0.2, abs=0.04)
    assert {kinds[0] for kinds in drawn if kinds} == set(known)


def test_two_effects_are_both_hidden_and_the_late_channel_delays_both(tmp_path):
    truth = draw_case(3, kind="delay+friction", strength=1.0, design="one_sweep", folder=tmp_path).label.open("both")
    assert [effect.kind for effect in truth.effects] == ["friction", "delay"]


def test_an_effect_that_no_run_shows_is_drawn_again_or_refused(tmp_path):
    """A stop beyond 25 mm, and one sweep that goes to 22 mm."""
    drawn = draw_case(140500045, "polynomial", design="one_sweep", folder=tmp_path).label.open("drawn").effects[0]
    assert max(drawn.rms["a2_p20"], drawn.rms["a2_p20_b"]) > 0.0
    with pytest.raises(ValueError, match="expected one that shows in the runs of 'one_sweep', got 'end_stop'"):
        draw_case(1, "polynomial", "end_stop", form="Hertz", design="one_sweep")


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"base": "beam"}, "base: expected one of spring, .*, got 'beam'"),
        ({"kind": "magic"}, "kind: expected one of friction, .*, got 'magic'"),
        ({"kind": "friction", "form": "Maxwell"}, "form: expected one of LuGre, .*, got 'Maxwell'"),
        ({"design": "huge"}, "design: expected one of full, .*, got 'huge'"),
    ],
)
def test_unknown_words_are_refused(asked, said):
    with pytest.raises(ValueError, match=said):
        draw_case(1, **asked)


# --- the seal and the border -------------------------------------------------------------------------------------


def test_label_gives_the_truth_only_for_a_verdict_and_only_once(tmp_path):
    label = draw_case(1, kind="friction", design="one_sweep", folder=tmp_path).label
    for nothing in (None, "", {}):
        with pytest.raises(SealBroken, match="expected a verdict"):
            label.open(nothing)
    assert label.open({"verdict": "explained"}).kinds == ("friction",)
    assert label.verdict == {"verdict": "explained"}
    with pytest.raises(SealBroken, match="a second"):
        label.open({"verdict": "another"})


def test_commitment_proves_the_label_afterwards_and_shows_nothing_before(tmp_path):
    label = draw_case(1, kind="friction", design="one_sweep", folder=tmp_path).label
    assert "friction" not in repr(label) + str(vars(label)["commitment"])
    with pytest.raises(SealBroken):
        _ = label.nonce
    truth = label.open("friction")
    assert proves(label.nonce, truth, label.commitment)
    assert not proves(label.nonce, replace(truth, seed=2), label.commitment)


def test_truth_imports_numpy_scipy_numba_and_the_standard_library_only():
    outside = {
        (file.name, name)
        for file in PACKAGE.glob("**/*.py")
        for node in ast.walk(ast.parse(file.read_text()))
        for name in imported(node)
        if name.split(".")[0] not in ALLOWED
    }
    assert outside == set()


def imported(node):
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    return [node.module] if isinstance(node, ast.ImportFrom) and node.level == 0 else []


def test_drawing_a_case_loads_nothing_of_dashpot(tmp_path):
    program = (
        "import sys; from pathlib import Path; from truth import draw_case;"
        "draw_case(1, design='one_sweep', folder=Path(sys.argv[1]));"
        "print([name for name in sys.modules if name.startswith('dashpot')])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path)], capture_output=True, text=True, cwd=PACKAGE.parent, check=True
    )
    assert done.stdout.strip() == "[]"


# --- axle --------------------------------------------------------------------------------------------------------


def test_an_axle_is_the_transfer_function_of_its_parts():
    """In phase the bar is idle: tire against wheel mass, spring and damper; K* of the platform in the last cycle."""
    numbers = Numbers(wheel=45.0, tire=220e3, loss=150.0, spring=28e3, damping=1500.0, bar=12e3)
    motion = harmonic(2e-3, 0.0, 9.0, 3.0)
    for sides, bar in (((1.0, 1.0), 0.0), ((1.0, -1.0), 24e3)):
        force = platform_forces(numbers, motion, sides, None)[0]
        s = 2j * np.pi * 9.0
        tire, hung = 220e3 + 150.0 * s, 28e3 + bar + 1500.0 * s
        expected = tire * (1.0 - tire / (tire + hung + 45.0 * s**2))
        assert complex_stiffness(motion, force - force.mean(), 9.0) == pytest.approx(expected, rel=1e-3)


def test_what_is_hidden_in_an_axle_acts_between_its_two_ends():
    """A law as stiff as a spring, one slider that never yields, is that spring more, wherever it is."""
    numbers = Numbers(wheel=45.0, tire=220e3, loss=150.0, spring=28e3, damping=1500.0, bar=12e3)
    motion = sweep(3e-3, 0.0, 1.0, 15.0, 1.0)
    for place, name in (("tire", "tire"), ("suspension", "spring"), ("bar", "bar")):
        law = Inner("", "", place, sliders=((5e3, 1e9),))
        found = platform_forces(numbers, motion, (1.0, -0.5), law)
        expected = platform_forces(replace(numbers, **{name: getattr(numbers, name) + 5e3}), motion, (1.0, -0.5), None)
        # what is hidden is relaxed at the beginning, a spring carries the weight
        moved = found - found[:, :1] - (expected - expected[:, :1])
        assert np.sqrt(np.mean(moved**2)) < 0.02 * np.sqrt(np.mean((expected - expected[:, :1]) ** 2))


def test_a_blind_axle_has_its_effect_at_its_strength(seed, tmp_path):
    truth = draw_case(seed, "axle", "friction", 2.0, folder=tmp_path).label.open("something")
    (effect,) = truth.effects
    pooled = np.sqrt(np.mean(np.square(list(effect.rms.values()))))
    assert pooled == pytest.approx(2.0 * truth.noise["rms"], rel=0.02)
    assert len(truth.noise_rms) == 16 and 0.0 < effect.strength_left < 2.1
    assert not re.search("friction|strength|null", (tmp_path / "dataset.yaml").read_text())


def test_an_axle_hides_nothing_that_it_does_not_have(tmp_path):
    with pytest.raises(ValueError, match="kind: expected one of friction, .*, got 'hum'"):
        draw_case(3, "axle", "hum", folder=tmp_path)


def test_two_effects_in_an_axle_are_both_there(seed, tmp_path):
    """By the difference of its forces from those without: an offset, and a law between the ends of a part."""
    truth = draw_case(seed, "axle", "offset+friction", 2.0, folder=tmp_path / "two").label.open("something")
    draw_case(seed, "axle", "null", folder=tmp_path / "none")
    offset, friction = truth.effects

    def changes(run, channel):
        with_them, without = (np.load(tmp_path / kind / f"{run}.npz") for kind in ("two", "none"))
        return with_them[channel] - without[channel]

    name, _, end = offset.parameters["place"].partition("@")
    assert np.mean(changes(name, f"F{end.removeprefix('platform_')[0]}")) == pytest.approx(offset.size, rel=0.3)
    run = max(friction.rms, key=friction.rms.get)
    assert max(np.std(changes(run, channel)) for channel in ("Fl", "Fr")) > 0.5 * friction.rms[run]


def test_a_run_that_was_asked_for_comes_on_top_of_the_others(tmp_path, seed):
    """The specimen, its effect and the noise of the other runs stay as they are."""
    time = np.arange(0.0, 2.0, 2e-3)
    asked = 20e-3 + 1e-3 * np.sin(2.0 * np.pi * 3.0 * time) * np.minimum(time, 1.0)
    before = draw_case(seed, "ftire", "friction", 1.0, folder=tmp_path / "before")
    after = draw_case(seed, "ftire", "friction", 1.0, further=(further(asked, 2e-3),), folder=tmp_path / "after")
    for path in before.folder.glob("*.npz"):
        one, other = np.load(path), np.load(after.folder / path.name)
        assert all(np.array_equal(one[key], other[key]) for key in "txF")
    run = np.load(after.folder / "asked_1.npz")
    assert run["x"] == pytest.approx(1e3 * np.interp(run["t"], time, asked), abs=0.02)
    assert np.corrcoef(run["x"], run["F"])[0, 1] > 0.9
