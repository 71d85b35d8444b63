"""Where the force is measured too, what of a displacement is too fast to show in it is no motion.

The truth is the motion in closed form; disturbances are those of rigs: the jitter of a clock, mains hum, noise.
"""

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.coherence import highest_coherent
from dashpot.data.drive import drive_from_samples
from dashpot.data.smoothing import best_rates, sensor_noise, smooth_path

RATE, COUNT = 300.0, 6000
TIME = np.arange(COUNT) / RATE
STIFFNESS, DAMPING, NOISE = 4e3, 900.0, 1.5  # of a damper on a dynamometer
INSIDE = slice(COUNT // 10, -COUNT // 10)


def sine(hertz, amplitude=25e-3):
    angle = 2.0 * np.pi * hertz * TIME
    return amplitude * np.sin(angle), amplitude * 2.0 * np.pi * hertz * np.cos(angle)


def measured_force(x, v, rng):
    return STIFFNESS * x + DAMPING * v + NOISE * rng.standard_normal(COUNT)


def hum(x, v, rng):
    return x + 30e-6 * np.sin(2.0 * np.pi * 60.0 * TIME + rng.uniform(0.0, 6.0)) + 1e-6 * rng.standard_normal(COUNT)


def noise(x, v, rng):
    return x + 1e-6 * rng.standard_normal(COUNT)


def jitter(x, v, rng):
    """Samples that were taken up to half a millisecond late or early."""
    return x + v * rng.uniform(-5e-4, 5e-4, COUNT)


def white(x, v, rng):
    return x + 20e-6 * rng.standard_normal(COUNT)


def relative_error(velocity, v):
    return np.sqrt(np.mean((velocity - v)[INSIDE] ** 2) / np.mean(v[INSIDE] ** 2))


@pytest.mark.parametrize("hertz", [0.25, 1.0, 4.0])
@pytest.mark.parametrize("disturbed", [hum, jitter, white])
def test_what_does_not_show_in_the_force_is_taken_off(disturbed, hertz):
    alone, found = errors_of(*sine(hertz), disturbed, f"{disturbed.__name__} {hertz}")
    assert found < 1.001 * alone and found < 4e-3
    if disturbed is hum:  # which stands out of the noise as a motion does; the noise beside it stays
        quiet, _ = errors_of(*sine(hertz), noise, f"noise {hertz}")
        assert found < 0.02 * alone + quiet


def errors_of(x, v, disturbed, name):
    """The relative error of the velocity without and beside the force."""
    rng = np.random.default_rng(seed_of(f"beside force {name}"))
    shown, force = disturbed(x, v, rng), measured_force(x, v, rng)
    alone = relative_error(drive_from_samples(1.0 / RATE, shown).velocity, v)
    found = relative_error(drive_from_samples(1.0 / RATE, shown, force=force).velocity, v)
    print(f"{name}: {100.0 * alone:.2g} % alone, {100.0 * found:.2g} % beside the force")
    return alone, found


@pytest.mark.parametrize("hertz", [10.0, 25.0, 60.0])
@pytest.mark.parametrize("disturbed", [hum, jitter, white])
def test_a_fast_motion_that_shows_in_the_force_stays(disturbed, hertz):
    slow, fast = sine(1.0), sine(hertz, 0.2e-3)
    alone, found = errors_of(slow[0] + fast[0], slow[1] + fast[1], disturbed, f"{disturbed.__name__} fast {hertz}")
    assert found < 1.2 * alone  # the noise of a jitter is not the same all along


@pytest.mark.parametrize("hertz", [2.0, 20.0, 80.0])
def test_the_highest_coherent_frequency_is_that_of_the_motion(hertz):
    rng = np.random.default_rng(seed_of(f"coherent {hertz}"))
    x, v = sine(hertz)
    found = highest_coherent(white(x, v, rng), measured_force(x, v, rng))
    assert found * RATE == pytest.approx(hertz, abs=1.1 * 16 * RATE / COUNT)


@pytest.mark.parametrize("gap", [0.0, 0.4], ids=["spring", "play"])
@pytest.mark.parametrize("count", [6_000, 20_000, 40_000, 99_000])
def test_a_sweep_keeps_its_fast_end(count, gap):
    """At its frequency there are harmonics of earlier times in the force, which a path with play does not have."""
    rate, first, last = 1000.0, 1.0, 25.0
    rng = np.random.default_rng(seed_of(f"sweep {count} {gap}"))
    time, octaves = np.arange(count) / rate, np.log(last / first) * rate / count
    hertz = first * np.exp(octaves * time)
    angle = 2.0 * np.pi * (hertz - first) / octaves
    x, v = 0.5e-3 * np.sin(angle), 0.5e-3 * 2.0 * np.pi * hertz * np.cos(angle)
    force = 300e3 * (x - np.clip(x, -gap * 0.5e-3, gap * 0.5e-3)) + 2.0 * rng.standard_normal(count)
    shown = x + 1e-6 * rng.standard_normal(count)
    found = drive_from_samples(1.0 / rate, shown, force=force).velocity
    fast = slice(-count // 4, -100)
    assert highest_coherent(shown, force) * rate == pytest.approx(last, rel=0.15)
    assert np.sqrt(np.mean((found - v)[fast] ** 2) / np.mean(v[fast] ** 2)) < 0.01


@pytest.mark.parametrize("last", [20.0, 50.0])
def test_the_fast_end_of_a_long_sweep_has_shorter_windows(last):
    """Half a minute in which all but a tenth is slow: one window for all loses several per cent of the fast end."""
    rate, count, first = 1000.0, 30_000, 0.5
    rng = np.random.default_rng(seed_of(f"long sweep {last}"))
    octaves = np.log(last / first) * rate / count
    hertz = first * np.exp(octaves * np.arange(count) / rate)
    angle = 2.0 * np.pi * (hertz - first) / octaves
    x, v = 1e-3 * np.sin(angle), 1e-3 * 2.0 * np.pi * hertz * np.cos(angle)
    shown = x + 1e-6 * rng.standard_normal(count)
    force = 150e3 * x + 300.0 * v + rng.standard_normal(count)
    found = drive_from_samples(1.0 / rate, shown, force=force)
    best = best_rates(shown, sensor_noise(shown), highest_coherent(shown, force))
    alike = smooth_path(1.0 / rate, shown, best.half)[1]
    fast, slow = slice(-count // 20, -100), slice(100, count // 2)
    assert np.std((found.velocity - v)[fast]) < 0.01 * np.std(v[fast])
    assert np.std((found.velocity - v)[fast]) < 0.5 * np.std((alike - v)[fast])
    assert np.array_equal(found.velocity[slow], alike[slow])


@pytest.mark.parametrize("seed", range(3))
def test_noise_that_goes_with_the_speed_is_no_motion(seed):
    """Under the jitter of a clock windows of other widths differ by more at times, and no motion is lost.

    How much noise there is, is known as a mean over a window only: the error may grow by half, and not 1.8 to 9 times.
    """
    rng = np.random.default_rng(seed_of(f"with the speed {seed}"))
    x, v = sine(0.5)
    shown = jitter(x, v, rng)
    alike = smooth_path(1.0 / RATE, shown, best_rates(shown, sensor_noise(shown)).half)[1]
    found = drive_from_samples(1.0 / RATE, shown).velocity
    assert relative_error(found, v) < 1.6 * relative_error(alike, v)


@pytest.mark.parametrize("speed", [2e-3, 10e-3])
def test_the_corners_of_a_triangle_have_shorter_windows(speed):
    """Of the error a fifth goes and more; what happens between two samples no window tells."""
    rate, travel = 1000.0, 8e-3
    count = int(6.0 * travel / speed * rate)
    rng = np.random.default_rng(seed_of(f"triangle {speed}"))
    way = (speed * (np.arange(count) + 0.5) / rate) % (2.0 * travel)
    x, v = travel - np.abs(way - travel), speed * np.where(way < travel, 1.0, -1.0)
    shown = x + 1e-6 * rng.standard_normal(count)
    found = drive_from_samples(1.0 / rate, shown)
    alike = smooth_path(1.0 / rate, shown, best_rates(shown, sensor_noise(shown)).half)[1]
    assert np.std(found.velocity - v) < 0.8 * np.std(alike - v)


@pytest.mark.parametrize("seed", range(5))
def test_noise_shortens_next_to_no_window(seed):
    """A steady random motion: the narrower windows differ from the others by chance alone."""
    rng = np.random.default_rng(seed_of(f"steady {seed}"))
    angles, hertz = rng.uniform(0.0, 2.0 * np.pi, (40, 1)), rng.uniform(0.5, 10.0, (40, 1))
    angle = 2.0 * np.pi * hertz * TIME + angles
    x, v = (1e-3 * np.sin(angle)).mean(axis=0), (2e-3 * np.pi * hertz * np.cos(angle)).mean(axis=0)
    shown = x + 1e-6 * rng.standard_normal(COUNT)
    best = best_rates(shown, sensor_noise(shown))
    alike, found = smooth_path(1.0 / RATE, shown, best.half)[1], drive_from_samples(1.0 / RATE, shown).velocity
    assert best.smooth and best.narrower
    assert np.std(found - v) < 1.01 * np.std(alike - v)


def test_signals_that_have_nothing_in_common_are_coherent_by_chance_in_one_of_a_hundred_records():
    rng = np.random.default_rng(seed_of("by chance"))
    found = sum(highest_coherent(*rng.standard_normal((2, 500))) is not None for _ in range(1000))
    assert 1 <= found <= 22  # 10 expected; more than 22 in three of ten thousand
    found = sum(highest_coherent(*rng.standard_normal((2, 9000))) is not None for _ in range(100))
    assert found <= 6  # one expected


def test_a_short_or_silent_record_tells_nothing():
    assert highest_coherent(*np.random.default_rng(0).standard_normal((2, 100))) is None
    assert highest_coherent(sine(1.0)[0], np.zeros(COUNT)) is None


@pytest.mark.parametrize("kink", [False, True])
def test_a_clean_motion_keeps_its_spline(kink):
    """What happens once and is soon over is lost in the noise of the force as a spectrum, but not to a clean sensor."""
    x, v = sine(20.0)
    if kink:
        x = x * np.minimum(1.0, TIME / 0.21)
    force = measured_force(x, v, np.random.default_rng(seed_of("clean")))
    clean = drive_from_samples(1.0 / RATE, x, force=force)
    assert np.array_equal(clean.velocity, drive_from_samples(1.0 / RATE, x).velocity)
