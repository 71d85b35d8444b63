"""The noise floor from repeats, from between the orders and from above the motion; truth: noise of known size."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import butter, lfilter, sosfiltfilt
from seeds import seed_of

from dashpot.data.alignment import NotRepeatsError, lag_between, shifted_by
from dashpot.data.noise import (
    UNKNOWN,
    NoiseFloor,
    noise_above_motion,
    noise_from_orders,
    noise_from_repeats,
    noise_from_residual,
    pool_noise,
)
from dashpot.data.order_tracking import follow, harmonics_of
from dashpot.data.repeats import compare_repeats
from dashpot.data.white_noise import white_noise

SAMPLE_TIME = 1e-3
SAMPLES = 20000
DEVIATION = 10.0
TURN = 2.0 * np.pi


@pytest.fixture
def random() -> np.random.Generator:
    seed = seed_of("test_noise")
    return np.random.default_rng(seed)


def noise(random: np.random.Generator, memory: float = 0.0, samples: int = SAMPLES) -> np.ndarray:
    """Autoregressive noise of the first order with standard deviation 10."""
    gain = np.sqrt(1.0 - memory**2) * DEVIATION
    return lfilter([gain], [1.0, -memory], random.normal(size=samples + 3000))[3000:]


def clean(late: float = 0.0, gain: float = 1.0, amplitude: float = 2e-3) -> tuple[np.ndarray, np.ndarray]:
    """Sweep 1 to 25 Hz over a progressive spring, a damper and a Dahl slider, begun `late` samples late.

    The slider is followed on an eightfold grid, exactly over every step.
    """
    time = (np.arange(8 * SAMPLES) / 8 - late) * SAMPLE_TIME
    displacement = 0.015 + gain * amplitude * np.sin(TURN * (time + 0.6 * time**2))
    velocity = np.gradient(displacement, SAMPLE_TIME / 8)
    slider = [0.0]
    for way in np.diff(displacement).tolist():
        side = np.copysign(30.0, way)
        slider.append(side + (slider[-1] - side) * np.exp(-abs(way) / 0.3e-3))
    force = 180e3 * displacement + 1e6 * displacement**2 + 100.0 * velocity + np.array(slider)
    return displacement[::8], force[::8]


def measured(random: np.random.Generator, memory: float = 0.0, **course) -> tuple[np.ndarray, np.ndarray]:
    displacement, force = clean(**course)
    return displacement + random.normal(0.0, 2e-6, SAMPLES), force + noise(random, memory)


@pytest.mark.parametrize(
    "course", [{}, {"late": 0.5}, {"late": 37.3}, {"gain": 1.01}, {"gain": 0.99, "late": -12.6}], ids=str
)
def test_two_repeats_show_the_noise_whatever_their_lag_and_amplitude(course, random):
    floor = noise_from_repeats([measured(random), measured(random, **course)], SAMPLE_TIME)
    assert floor.source == "repeats"
    # 20000 samples tell the deviation to 0.5 %; shifting by half a sample takes up to 1.5 % of white noise.
    assert floor.value == pytest.approx(DEVIATION, rel=0.045)


@pytest.mark.parametrize(("memory", "tolerance"), [(0.9, 0.1), (0.98, 0.25)])
def test_repeats_show_slow_noise_in_full(memory, tolerance, random):
    floor = noise_from_repeats([measured(random, memory) for _ in range(3)], SAMPLE_TIME)
    assert floor.value == pytest.approx(DEVIATION, rel=tolerance)
    assert floor.weight == pytest.approx(2 * SAMPLES, rel=0.01)


def test_without_noise_repeats_show_none_although_lag_and_amplitude_differ():
    runs = [clean(), clean(late=0.37, gain=1.01)]
    floor = noise_from_repeats(runs, SAMPLE_TIME)
    assert floor.value < 2e-3 * np.std(runs[0][1])


def test_a_constant_difference_is_an_offset_and_no_noise(random):
    (x1, f1), (x2, f2) = measured(random), measured(random)
    floor = noise_from_repeats([(x1, f1), (x2, f2 + 20.0)], SAMPLE_TIME)
    assert floor.value == pytest.approx(DEVIATION, rel=0.045)
    assert floor.offset == pytest.approx(20.0 / np.sqrt(2.0), abs=0.5)


def test_repeats_whose_motion_rests_show_no_more_than_their_noise(random):
    time = np.arange(SAMPLES) * SAMPLE_TIME
    swings = [np.clip(1.5 * np.sin(TURN * (time - late) / 20.0), -1.0, 1.0) for late in (0.0, 0.3e-3)]
    displacements = (2.37e-2 + 1e-4 * swings[0], 2.37e-2 + 1.01e-4 * swings[1])
    repeats = [(x, 1e3 * swing + noise(random)) for x, swing in zip(displacements, swings, strict=True)]
    floor = noise_from_repeats(repeats, SAMPLE_TIME)
    assert floor.value == pytest.approx(DEVIATION, rel=0.05)


def test_the_lag_is_found_to_a_hundredth_of_a_sample(random):
    late = random.uniform(-100.0, 100.0)
    lags = compare_repeats([clean(), clean(late=late)], SAMPLE_TIME).lags
    assert lags[1] == pytest.approx(late, abs=0.01)


def test_shifting_keeps_the_power_of_white_noise(random):
    signal = random.normal(size=100000)
    assert np.std(shifted_by(signal, 0.5, 100, 99900)) == pytest.approx(1.0, rel=0.03)


def test_a_lag_longer_than_the_overlap_is_refused():
    signal = np.zeros(1000)
    signal[10] = 1.0
    late = np.zeros(1000)
    late[990] = 1.0
    with pytest.raises(ValueError, match="expected runs that overlap by 48 samples.* got lags .*one trigger"):
        lag_between(signal, late)


def test_runs_of_different_motion_are_no_repeats(random):
    with pytest.raises(NotRepeatsError, match="one motion, got displacements that differ by .* correct `repeats:`"):
        noise_from_repeats([measured(random), measured(random, gain=1.5)], SAMPLE_TIME)


def test_a_single_run_is_no_repeat(random):
    with pytest.raises(NotRepeatsError, match="at least two repeated runs, got 1"):
        noise_from_repeats([measured(random)], SAMPLE_TIME)


@pytest.mark.parametrize(
    ("memory", "runs", "tolerance"), [(0.0, 1, 0.15), (0.5, 1, 0.15), (0.9, 2, 0.3), (0.98, 6, 0.45)]
)
def test_between_the_orders_noise_of_any_colour_shows(memory, runs, tolerance, random):
    # One 20 s run tells 0.98 to 17 % only: the mean over runs is what is stated. Its own bias is about -7 %.
    displacement, force = clean()
    motion = follow(displacement, SAMPLE_TIME)
    floors = [noise_from_orders(force + noise(random, memory), motion) for _ in range(runs)]
    assert {floor.source for floor in floors} == {"residual"}
    assert np.mean([floor.value for floor in floors]) == pytest.approx(DEVIATION, rel=tolerance)


def test_what_is_left_of_a_window_holds_little_of_slow_noise(random):
    # Why noise_from_orders does not use it: windows of four periods swallow what is slower than they are.
    displacement, force = clean()
    left = harmonics_of(force + noise(random, 0.98), follow(displacement, SAMPLE_TIME)).noise
    assert np.median(left) < 0.75 * DEVIATION


def test_a_steady_run_shows_its_noise_too(random):
    displacement = 1e-3 * np.sin(TURN * 10.0 * np.arange(SAMPLES) * SAMPLE_TIME)
    floor = noise_from_orders(2e5 * displacement + noise(random), follow(displacement, SAMPLE_TIME))
    assert floor.value == pytest.approx(DEVIATION, rel=0.2)


def test_without_noise_there_is_none_between_the_orders():
    displacement, force = clean()
    assert noise_from_orders(force, follow(displacement, SAMPLE_TIME)).value < 1e-4 * np.std(force)


def test_a_few_periods_or_blocks_of_different_amplitude_do_not_tell_the_noise(random):
    time = np.arange(4000) * SAMPLE_TIME
    few = np.sin(TURN * time)
    blocks = np.concatenate([a * np.sin(TURN * 5.0 * time[:1000]) for a in (1.0, 1.5, 2.2, 3.3, 5.0)])
    for displacement in (few, blocks):
        motion = follow(displacement, SAMPLE_TIME)
        assert noise_from_orders(displacement + 0.01 * noise(random, 0.0, len(displacement)), motion) == UNKNOWN


def test_a_hold_shows_its_noise_above_the_motion(random):
    samples = 10000
    relaxing = 4000.0 - 20.0 * np.log1p(np.arange(samples) * SAMPLE_TIME)
    floor = noise_above_motion(
        0.01 + random.normal(0.0, 2e-6, samples), relaxing + noise(random, 0.5, samples), SAMPLE_TIME
    )
    assert floor.value == pytest.approx(DEVIATION, rel=0.15)


def band_limited(random: np.random.Generator, highest: float) -> np.ndarray:
    band = butter(6, [0.5, highest], "band", fs=1.0 / SAMPLE_TIME, output="sos")
    signal = sosfiltfilt(band, random.normal(size=SAMPLES))
    return 1e-3 * signal / np.std(signal)


def test_a_random_run_shows_white_noise_and_a_lower_bound_of_slow_noise(random):
    displacement = band_limited(random, 20.0)
    force = 2e5 * displacement + 100.0 * np.gradient(displacement, SAMPLE_TIME)
    assert noise_from_residual(displacement, force + noise(random), SAMPLE_TIME).value == pytest.approx(
        DEVIATION, rel=0.15
    )
    assert noise_from_residual(displacement, force + noise(random, 0.98), SAMPLE_TIME).value < DEVIATION


@pytest.mark.parametrize("slow", [0.0, 0.6])
@pytest.mark.parametrize("law", ["friction", "stop", "valve", "orifice"])
def test_what_a_force_has_at_its_bends_is_no_noise(random, law, slow):
    """The harmonics of a sharp law go on without end: of a friction of 50 N they passed for noise of 15 N."""
    displacement = 2.0 * band_limited(random, 15.0)
    velocity = np.gradient(displacement, SAMPLE_TIME)
    bent = {
        "friction": 50.0 * np.tanh(velocity / 1e-3),
        "stop": 4e5 * np.maximum(displacement - 2e-3, 0.0),
        "valve": 1000.0 * np.arctan(velocity / 0.05),
        "orifice": 450.0 * np.sign(velocity) * np.abs(velocity) ** 0.6,
    }
    quiet = 0.1 * noise(random, slow)
    floor = noise_from_residual(displacement, 2e5 * displacement + bent[law] + quiet, SAMPLE_TIME)
    assert 0.03 * DEVIATION < floor.value < 0.2 * DEVIATION


def test_a_motion_that_fills_the_spectrum_leaves_the_noise_unknown(random):
    displacement = band_limited(random, 300.0)
    assert noise_above_motion(displacement, 2e5 * displacement, SAMPLE_TIME) == UNKNOWN
    assert noise_above_motion(displacement[:100], displacement[:100], SAMPLE_TIME) == UNKNOWN


def test_a_sweep_uses_what_is_between_its_orders(random):
    displacement, force = measured(random)
    expected = noise_from_orders(force, follow(displacement, SAMPLE_TIME))
    assert noise_from_residual(displacement, force, SAMPLE_TIME) == expected


def test_repeats_overrule_residuals_and_pool_by_their_samples():
    repeats = [NoiseFloor(3.0, "repeats", 1.0, 100.0), NoiseFloor(5.0, "repeats", 2.0, 300.0)]
    residual = NoiseFloor(50.0, "residual", 0.0, 1000.0)
    pooled = pool_noise([*repeats, residual, UNKNOWN])
    assert pooled == NoiseFloor(np.sqrt(21.0), "repeats", np.sqrt(3.25), 400.0)
    assert pool_noise([residual, UNKNOWN]) == residual
    assert pool_noise([UNKNOWN]) == UNKNOWN


@pytest.mark.parametrize("deviation", [1e-7, 2e-6, 1e-5])
def test_white_noise_of_a_displacement_is_found(deviation, random):
    displacement, _ = clean()
    assert white_noise(displacement + random.normal(0.0, deviation, SAMPLES)) == pytest.approx(deviation, rel=0.1)


@pytest.mark.parametrize("smooth", ["sweep", "triangle", "constant", "steps"])
def test_a_smooth_motion_has_no_white_noise(smooth):
    turns = np.arange(SAMPLES) * SAMPLE_TIME
    signal = {
        "sweep": np.sin(TURN * (turns + 0.6 * turns**2)),
        "triangle": np.arcsin(np.sin(TURN * turns)),
        "constant": np.ones(SAMPLES),
        "steps": np.floor(turns),
    }[smooth]
    assert white_noise(signal) < 1e-8


def test_fewer_than_fifteen_samples_tell_nothing():
    assert white_noise(np.arange(14.0) ** 3) == 0.0


def test_lower_bounds_count_only_where_there_is_nothing_better():
    """Noise seen above the motion alone is a lower bound; one run seen between its orders outweighs many of them."""
    bounds = [NoiseFloor(1.0, "residual", weight=1e6, lower_bound=True)] * 3
    sound = NoiseFloor(5.0, "residual", weight=1e3)
    assert pool_noise([*bounds, sound]).value == pytest.approx(5.0)
    assert pool_noise(bounds).value == pytest.approx(1.0)
    assert pool_noise(bounds).lower_bound
