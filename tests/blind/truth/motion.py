"""What the rig does to the specimen: displacement with its exact derivatives on a fine grid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

SAMPLING = 1000
STEPS_PER_SAMPLE = 8
STEP = 1.0 / (SAMPLING * STEPS_PER_SAMPLE)
RANDOM_SPACING = 0.1 * np.sqrt(1.03)  # Hz; no period within a run


@dataclass(frozen=True)
class Motion:
    """A driven path; every array has shape (steps,), SI units, and starts at rest."""

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray

    @property
    def travelled(self) -> np.ndarray:
        """Displacement from where the path began [m]."""
        return self.displacement - self.displacement[0]


def at_samples(fine: np.ndarray) -> np.ndarray:
    """The values at the sample times of the rig."""
    return fine[::STEPS_PER_SAMPLE]


def sweep(amplitude: float, preload: float, start: float, stop: float, duration: float, fade: float = 0.25) -> Motion:
    """A sine of linearly rising frequency [Hz] around `preload` [m], faded in over `fade` [s]."""
    time = _grid(duration)
    rate = 2 * np.pi * (stop - start) / duration
    speed = 2 * np.pi * start + rate * time
    angle = 2 * np.pi * start * time + rate * time**2 / 2
    sine, cosine = np.sin(angle), np.cos(angle)
    level, slope, bend = _fade(time, fade)
    return Motion(
        time,
        preload + amplitude * level * sine,
        amplitude * (slope * sine + level * speed * cosine),
        amplitude * (bend * sine + (2 * slope * speed + level * rate) * cosine - level * speed**2 * sine),
    )


def harmonic(amplitude: float, preload: float, frequency: float, duration: float, fade: float = 0.25) -> Motion:
    """A sine of one frequency [Hz]."""
    return sweep(amplitude, preload, frequency, frequency, duration, fade)


def sum_of_sines(
    preload: float, waves: Sequence[tuple[float, float, float]], duration: float, fade: float = 0.25
) -> Motion:
    """Sines (amplitude [m], frequency [Hz], phase [rad]) around `preload` [m], faded in together over `fade` [s]."""
    time = _grid(duration)
    path, speed, bend = np.zeros((3, time.size))
    for amplitude, frequency, phase in waves:
        pulsation = 2 * np.pi * frequency
        sine, cosine = np.sin(pulsation * time + phase), np.cos(pulsation * time + phase)
        path += amplitude * sine
        speed += amplitude * pulsation * cosine
        bend -= amplitude * pulsation**2 * sine
    level, slope, curve = _fade(time, fade)
    return Motion(
        time,
        preload + level * path,
        slope * path + level * speed,
        curve * path + 2 * slope * speed + level * bend,
    )


def random_waves(rms: float, low: float, high: float, draw: int) -> list[tuple[float, float, float]]:
    """Waves of one speed from `low` to `high` [Hz] with random phases, together of a root mean square [m]."""
    frequencies = np.arange(low, high, RANDOM_SPACING)
    phases = np.random.default_rng(draw).uniform(0.0, 2 * np.pi, frequencies.size)
    amplitudes = rms * np.sqrt(2.0 / np.sum(frequencies**-2.0)) / frequencies
    return list(zip(amplitudes.tolist(), frequencies.tolist(), phases.tolist(), strict=True))


def triangle(depth: float, duration: float, corner: float = 0.1) -> Motion:
    """Zero to `depth` [m] and back at one speed; the corners are rounded over `corner` [s]."""
    time = _grid(duration)
    speed = depth / (duration / 2 - 11 / 16 * corner)
    turns = ((0.0, speed), (duration / 2 - corner / 2, -2 * speed), (duration - corner, speed))
    parts = [[change * part for part in _ramp(time - begin, corner)] for begin, change in turns]
    displacement, velocity, acceleration = (sum(column) for column in zip(*parts, strict=True))
    return Motion(time, displacement, velocity, acceleration)


def along(displacement: np.ndarray, dt: float) -> Motion:
    """A displacement (n,) given every `dt` [s]; the rig rounds its corners."""
    time = _grid((displacement.size - 1) * dt)
    path = CubicSpline(np.arange(displacement.size) * dt, displacement, bc_type="clamped")
    return Motion(time, path(time), path(time, 1), path(time, 2))


def _grid(duration: float) -> np.ndarray:
    samples = round(duration * SAMPLING)
    return np.arange((samples - 1) * STEPS_PER_SAMPLE + 1) * STEP


def _fade(time: np.ndarray, length: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Level, slope and bend of 10 u^3 - 15 u^4 + 6 u^5."""
    u = np.clip(time / length, 0.0, 1.0)
    level = u**3 * (10 - 15 * u + 6 * u**2)
    return level, 30 * (u * (1 - u)) ** 2 / length, 60 * u * (1 - u) * (1 - 2 * u) / length**2


def _ramp(time: np.ndarray, length: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The step 3 u^2 - 2 u^3 in velocity: its integral, itself, its derivative."""
    u = np.clip(time / length, 0.0, 1.0)
    after = np.maximum(time - length, 0.0)
    return length * (u**3 - u**4 / 2) + after, u * u * (3 - 2 * u), 6 * u * (1 - u) / length
