"""Dynamic stiffness of sweeps and harmonic runs; truth: closed forms, and a Maxwell element integrated to 1e-10."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some
from scipy.integrate import solve_ivp
from scipy.signal import butter, lfilter, sosfiltfilt
from scipy.special import ive
from seeds import seed_of

from dashpot.data.average import average_bands, average_directions, split_directions
from dashpot.data.order_tracking import dynamic_stiffness, follow, harmonics_of
from dashpot.data.phase import NotOscillatingError, track_phase

SAMPLE_TIME = 1e-3
TURN = 2.0 * np.pi
# sin 2 pi 5 t with 200 samples per period
STEADY = np.arange(4000) * SAMPLE_TIME
SINE, COSINE, OMEGA = np.sin(TURN * 5.0 * STEADY), np.cos(TURN * 5.0 * STEADY), TURN * 5.0


@pytest.fixture
def random() -> np.random.Generator:
    seed = seed_of("test_order_tracking")
    return np.random.default_rng(seed)


def linear_sweep(start: float, stop: float, duration: float):
    """Frequency and phase of a linear sweep as functions of time."""
    rate = (stop - start) / duration
    return lambda t: start + rate * t, lambda t: TURN * (start * t + 0.5 * rate * t**2)


class Solid:
    """Spring, damper and Maxwell element in parallel."""

    def __init__(self, random: np.random.Generator):
        self.spring, self.damper = random.uniform(150e3, 300e3), random.uniform(0.0, 200.0)
        self.branch, self.relaxation = random.uniform(5e3, 40e3), np.exp(random.uniform(np.log(6e-3), np.log(0.1)))

    def stiffness(self, frequency: np.ndarray) -> np.ndarray:
        s = 1j * TURN * frequency
        return self.spring + s * self.damper + self.branch * s * self.relaxation / (1.0 + s * self.relaxation)

    def curvature(self, frequency: np.ndarray) -> np.ndarray:
        """Second derivative of the stiffness by angular frequency."""
        return 2.0 * self.branch * self.relaxation**2 / (1.0 + 1j * TURN * frequency * self.relaxation) ** 3

    def force(self, law, amplitude: float, duration: float) -> tuple[np.ndarray, np.ndarray]:
        frequency, phase = law
        time = np.arange(0.0, duration, SAMPLE_TIME)

        def velocity(t):
            return amplitude * TURN * frequency(t) * np.cos(phase(t))

        maxwell = solve_ivp(
            lambda t, force: self.branch * velocity(t) - force / self.relaxation,
            (0.0, duration),
            [0.0],
            method="DOP853",
            t_eval=time,
            rtol=1e-10,
            atol=1e-9,
        ).y[0]
        displacement = amplitude * np.sin(phase(time))
        return displacement, self.spring * displacement + self.damper * velocity(time) + maxwell


def rate_bias(solid: Solid, frequency: np.ndarray, rate: float) -> np.ndarray:
    """What the sweep itself does, |beta / 2 K''|: physics 3.4."""
    return np.abs(0.5 * TURN * rate * solid.curvature(frequency))


def window_bias(solid: Solid, frequency: np.ndarray, rate: float, periods: float) -> np.ndarray:
    """What averaging over a Hann window does: half the curvature times the variance of frequency inside."""
    spread = np.sqrt(1.0 / 12.0 - 0.5 / np.pi**2) * periods / frequency
    return np.abs(0.5 * solid.curvature(frequency) * (TURN * rate * spread) ** 2)


def settled(found):
    """Without the first second, in which the Maxwell element forgets how it began."""
    return found.select(found.time > 1.0 + 0.5 * found.periods / found.frequency)


@pytest.mark.parametrize("periods", [3.0, 4.0, 6.0])
@pytest.mark.parametrize(("start", "stop"), [(1.0, 25.0), (25.0, 1.0)])
def test_a_sweep_shows_the_complex_stiffness_within_the_bias_of_its_rate(start, stop, periods, random):
    solid = Solid(random)
    displacement, force = solid.force(linear_sweep(start, stop, 20.0), 2e-3, 20.0)
    found = settled(dynamic_stiffness(displacement, force, SAMPLE_TIME, periods=periods))
    error = np.abs(found.storage + 1j * found.loss - solid.stiffness(found.frequency))
    bias = rate_bias(solid, found.frequency, 1.2) + window_bias(solid, found.frequency, 1.2, periods)
    assert found.frequency.min() < 3.5 and found.frequency.max() > 23.0
    assert np.all(error <= 1.3 * bias + 1e-5 * found.magnitude)


def test_the_mean_of_both_directions_is_free_of_the_bias_of_the_rate(random):
    solid = Solid(random)
    up = dynamic_stiffness(*solid.force(linear_sweep(2.0, 25.0, 10.0), 2e-3, 10.0), SAMPLE_TIME)
    down = dynamic_stiffness(*solid.force(linear_sweep(25.0, 2.0, 10.0), 2e-3, 10.0), SAMPLE_TIME)
    both = average_directions(settled(up), settled(down))
    error = np.abs(both.storage + 1j * both.loss - solid.stiffness(both.frequency))
    assert np.all(error <= 1.3 * window_bias(solid, both.frequency, 2.3, 4.0) + 1e-5 * both.magnitude)


def test_a_dahl_slider_has_the_stiffness_of_the_bessel_function(random):
    limit, ratio, amplitude = random.uniform(10, 100), random.uniform(0.5, 8.0), random.uniform(0.5, 5.0) * 1e-3
    displacement = amplitude * SINE
    way = (amplitude + np.where(COSINE >= 0.0, displacement, -displacement)) * ratio / amplitude
    force = np.where(COSINE >= 0.0, 1.0, -1.0) * limit * (1.0 - (1.0 + np.tanh(ratio)) * np.exp(-way))
    found = dynamic_stiffness(displacement, force, SAMPLE_TIME)
    # I1(a) / cosh a, written with the scaled Bessel function
    storage = 4.0 * limit * ive(1, ratio) / (amplitude * (1.0 + np.exp(-2.0 * ratio)))
    loss = 4.0 * limit / (np.pi * amplitude) * (1.0 - np.tanh(ratio) / ratio)
    np.testing.assert_allclose(found.storage, storage, rtol=2e-3)
    np.testing.assert_allclose(found.loss, loss, rtol=2e-3)


def test_a_jenkin_slider_has_its_textbook_stiffness(random):
    limit, ratio, amplitude = random.uniform(10, 100), random.uniform(1.5, 10.0), random.uniform(0.5, 5.0) * 1e-3
    displacement = amplitude * SINE
    way = (amplitude + np.where(COSINE >= 0.0, displacement, -displacement)) * ratio / amplitude
    force = np.where(COSINE >= 0.0, 1.0, -1.0) * limit * np.minimum(way - 1.0, 1.0)
    found = dynamic_stiffness(displacement, force, SAMPLE_TIME)
    slip = np.arccos(1.0 - 2.0 / ratio)
    np.testing.assert_allclose(
        found.storage, limit * ratio / amplitude / np.pi * (slip - np.sin(2 * slip) / 2), rtol=2e-3
    )
    np.testing.assert_allclose(found.loss, 4.0 * limit / (np.pi * amplitude) * (1.0 - 1.0 / ratio), rtol=2e-3)


# law, then r0, a1, b1, a2, b2, a3, b3 in units of the strongest power of X and omega X (physics 4)
DICTIONARY = {
    "x^2": (lambda x, v: x**2, 0.5, 0, 0, 0, -0.5, 0, 0),
    "x^3": (lambda x, v: x**3, 0, 0.75, 0, 0, 0, -0.25, 0),
    "x v": (lambda x, v: x * v, 0, 0, 0, 0.5, 0, 0, 0),
    "x^2 v": (lambda x, v: x**2 * v, 0, 0, 0.25, 0, 0, 0, -0.25),
    "|v|": (lambda x, v: np.abs(v), 2 / np.pi, 0, 0, 0, 4 / (3 * np.pi), 0, 0),
    "v |v|": (lambda x, v: v * np.abs(v), 0, 0, 8 / (3 * np.pi), 0, 0, 0, 8 / (15 * np.pi)),
    "v^3": (lambda x, v: v**3, 0, 0, 0.75, 0, 0, 0, 0.25),
    "sgn v": (lambda x, v: np.sign(v), 0, 0, 4 / np.pi, 0, 0, 0, -4 / (3 * np.pi)),
}


@pytest.mark.parametrize("law", DICTIONARY)
def test_harmonics_have_the_phase_of_the_motion(law, random):
    start = random.uniform(0.0, TURN)
    angle = TURN * 1.25 * np.arange(8000) * SAMPLE_TIME + start
    function, offset, *expected = DICTIONARY[law]
    found = dynamic_stiffness(np.sin(angle), function(np.sin(angle), np.cos(angle)), SAMPLE_TIME)
    seen = np.stack([found.sine[:, :3], found.cosine[:, :3]], axis=2).reshape(len(found), 6)
    # A step between samples is misplaced by up to half a sample, pi / 800 of phase, times its first harmonic 4 / pi.
    np.testing.assert_allclose(found.offset, offset, atol=0.006)
    np.testing.assert_allclose(seen, np.tile(expected, (len(found), 1)), atol=0.006)


def test_windows_know_amplitude_preload_frequency_and_time(random):
    amplitude, preload, frequency = random.uniform(0.5e-3, 5e-3), random.uniform(0, 0.03), random.uniform(1.0, 25.0)
    displacement = preload + amplitude * np.sin(TURN * frequency * np.arange(8000) * SAMPLE_TIME)
    found = dynamic_stiffness(displacement, 2e5 * displacement, SAMPLE_TIME)
    np.testing.assert_allclose(found.amplitude, amplitude, rtol=1e-6)
    np.testing.assert_allclose(found.preload, preload, atol=1e-8)
    np.testing.assert_allclose(found.frequency, frequency, rtol=1e-4)
    np.testing.assert_allclose(np.diff(found.time), 0.25 / frequency, atol=2e-3)
    np.testing.assert_allclose(found.offset, 2e5 * preload, rtol=1e-6, atol=1e-2)


def test_ramps_and_holds_around_a_sweep_are_left_out(random):
    _, phase = linear_sweep(1.0, 25.0, 20.0)
    preload, amplitude = 0.02, 0.25e-3
    ramp, hold = np.linspace(0.0, preload, 2000), np.full(3000, preload)
    sweep = preload + amplitude * np.sin(phase(np.arange(20000) * SAMPLE_TIME))
    displacement = np.concatenate([ramp, hold, sweep, hold, ramp[::-1]]) + random.normal(0.0, 2e-6, 30000)
    found = dynamic_stiffness(displacement, 2e5 * displacement, SAMPLE_TIME)
    assert found.time.min() > 5.5 and found.time.max() < 25.0
    np.testing.assert_allclose(found.amplitude, amplitude, rtol=0.02)


@pytest.mark.parametrize("memory", [0.0, 0.9, 0.98])
def test_confidence_is_the_scatter_of_the_stiffness_under_noise_of_any_colour(memory, random):
    _, phase = linear_sweep(2.0, 25.0, 15.0)
    displacement = 1e-3 * np.sin(phase(np.arange(15000) * SAMPLE_TIME))
    motion = follow(displacement, SAMPLE_TIME)
    scores = []
    for _ in range(40):
        noise = lfilter([np.sqrt(1.0 - memory**2)], [1.0, -memory], random.normal(0.0, 10.0, 18000))[3000:]
        found = harmonics_of(2e5 * displacement + noise, motion)
        scores += [(found.storage - 2e5) / found.confidence, found.loss / found.confidence]
    assert 0.8 < np.sqrt(np.mean(np.square(scores))) < 1.25


def test_the_residual_of_a_model_shows_what_it_lacks(random):
    solid = Solid(random)
    displacement, force = solid.force(linear_sweep(2.0, 25.0, 10.0), 2e-3, 10.0)
    motion = follow(displacement, SAMPLE_TIME)
    missing = harmonics_of(force - solid.spring * displacement, motion)
    whole = harmonics_of(force, motion)
    np.testing.assert_allclose(missing.storage, whole.storage - solid.spring, atol=1e-3)
    np.testing.assert_allclose(missing.loss, whole.loss, atol=1e-3)


@given(first=some.floats(-1e3, 1e3), second=some.floats(-1e3, 1e3))
@settings(max_examples=25, deadline=None)
def test_the_harmonics_of_a_sum_are_the_sum_of_the_harmonics(first, second):
    motion = follow(SINE, SAMPLE_TIME)
    one, other = harmonics_of(SINE**3, motion), harmonics_of(np.abs(COSINE), motion)
    both = harmonics_of(first * SINE**3 + second * np.abs(COSINE), motion)
    np.testing.assert_allclose(both.sine, first * one.sine + second * other.sine, atol=1e-8)
    np.testing.assert_allclose(both.cosine, first * one.cosine + second * other.cosine, atol=1e-8)


def test_the_phase_is_followed_through_noise(random):
    _, phase = linear_sweep(1.0, 25.0, 20.0)
    true = phase(np.arange(20000) * SAMPLE_TIME)
    angle = track_phase(0.01 + 2e-3 * np.sin(true) + random.normal(0.0, 5e-6, 20000))
    known = np.isfinite(angle)
    error = np.unwrap(angle[known] - true[known])
    assert known.mean() > 0.99
    assert np.std(error) < 5e-3


def test_a_frequency_law_replaces_the_measured_phase(random):
    frequency, phase = linear_sweep(1.0, 25.0, 20.0)
    time = np.arange(20000) * SAMPLE_TIME
    displacement = 1e-3 * np.sin(phase(time) + 0.7)
    found = dynamic_stiffness(displacement, 2e5 * displacement, SAMPLE_TIME, frequency=frequency(time))
    np.testing.assert_allclose(found.storage, 2e5, rtol=1e-6)
    np.testing.assert_allclose(found.sweep_rate, 1.2, rtol=1e-3)
    with pytest.raises(ValueError, match="expected a frequency law in Hz above zero"):
        dynamic_stiffness(displacement, displacement, SAMPLE_TIME, frequency=np.zeros(20000))


def test_orders_above_the_nyquist_frequency_are_unknown():
    time = np.arange(2000) * 0.01
    displacement = np.sin(TURN * 10.0 * time + 0.1)
    found = dynamic_stiffness(displacement, 2.0 * displacement, 0.01)
    np.testing.assert_allclose(found.storage, 2.0, rtol=1e-6)
    assert np.all(np.isfinite(found.sine[:, :3])) and np.all(np.isnan(found.sine[:, 4:]))


def test_three_periods_are_enough_and_fewer_are_not():
    time = np.arange(3300) * SAMPLE_TIME
    found = dynamic_stiffness(np.sin(TURN * time), np.cos(TURN * time), SAMPLE_TIME)
    assert found.periods < 4.0
    np.testing.assert_allclose(found.loss, 1.0, rtol=1e-3)
    with pytest.raises(NotOscillatingError, match="expected an oscillation"):
        dynamic_stiffness(np.sin(TURN * time[:1500]), time[:1500], SAMPLE_TIME)
    with pytest.raises(NotOscillatingError, match="expected at least two periods"):
        dynamic_stiffness(np.sin(TURN * time[:1500]), time[:1500], SAMPLE_TIME, frequency=np.ones(1500))


@pytest.mark.parametrize("motion", ["random", "multisine", "hold", "ramp", "rest"])
def test_a_motion_without_one_phase_is_refused_with_advice(motion, random):
    time = np.arange(20000) * SAMPLE_TIME
    band = butter(4, [0.5, 25.0], "band", fs=1000.0, output="sos")
    displacement = {
        "random": sosfiltfilt(band, random.normal(size=20000)),
        "multisine": sum(np.sin(TURN * (k * time + random.uniform())) for k in range(1, 26)),
        "hold": random.normal(0.0, 1e-6, 20000),
        "ramp": 1e-3 * time + random.normal(0.0, 1e-6, 20000),
        "rest": np.zeros(20000),
    }[motion]
    with pytest.raises(NotOscillatingError, match="expected .* got .*(leave the run out|use a sweep)"):
        dynamic_stiffness(displacement, displacement, SAMPLE_TIME)


def test_bands_average_what_falls_into_them(random):
    solid = Solid(random)
    found = dynamic_stiffness(*solid.force(linear_sweep(2.0, 25.0, 10.0), 2e-3, 10.0), SAMPLE_TIME)
    bands = average_bands(found, np.array([0.1, 0.2, 5.0, 10.0, 20.0, 50.0]))
    inside = (found.frequency >= 5.0) & (found.frequency < 10.0)
    assert len(bands) == 4
    assert bands.storage[1] == pytest.approx(found.storage[inside].mean())
    assert bands.sine.shape == (4, 7)
    with pytest.raises(ValueError, match="expected bands that hold some of 3.* Hz, got edges 100 to 200 Hz"):
        average_bands(found, np.array([100.0, 200.0]))


def test_the_confidence_of_a_band_counts_windows_that_do_not_overlap(random):
    _, phase = linear_sweep(2.0, 25.0, 15.0)
    displacement = 1e-3 * np.sin(phase(np.arange(15000) * SAMPLE_TIME))
    motion, edges = follow(displacement, SAMPLE_TIME), np.arange(3.0, 25.0, 2.0)
    scores = []
    for _ in range(25):
        found = average_bands(harmonics_of(2e5 * displacement + random.normal(0.0, 10.0, 15000), motion), edges)
        scores += [(found.storage - 2e5) / found.confidence, found.loss / found.confidence]
    # 500 independent numbers
    assert 0.8 < np.sqrt(np.mean(np.square(scores))) < 1.25


def test_up_and_down_in_one_run_are_told_apart():
    up, down = linear_sweep(2.0, 20.0, 10.0), linear_sweep(20.0, 2.0, 10.0)
    time = np.arange(10000) * SAMPLE_TIME
    displacement = np.sin(np.concatenate([up[1](time), up[1](10.0) + down[1](time)]))
    rising, falling = split_directions(dynamic_stiffness(displacement, displacement, SAMPLE_TIME))
    assert rising.time.max() == pytest.approx(10.0, abs=0.3)
    assert falling.time.min() == pytest.approx(10.0, abs=0.3)
    with pytest.raises(ValueError, match="expected two sweeps over a common range"):
        average_directions(rising.select(rising.frequency < 5.0), falling.select(falling.frequency > 10.0))
