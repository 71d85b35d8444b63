"""The driven paths: sweeps, steps of frequency, multisines and a triangle; displacement [m] at every sample."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from .rig import Rig

STEPS = 6
ROUNDING = 0.02


def log_sweep(rig: Rig, rng: np.random.Generator) -> np.ndarray:
    """A sine whose frequency rises exponentially."""
    time, (low, high) = _time(rig), rig.band
    growth = np.log(high / low) / time[-1]
    return np.sin(2 * np.pi * low * np.expm1(growth * time) / growth)


def linear_sweep(rig: Rig, rng: np.random.Generator) -> np.ndarray:
    """A sine whose frequency rises evenly."""
    time, (low, high) = _time(rig), rig.band
    return np.sin(2 * np.pi * (low * time + (high - low) * time**2 / (2 * time[-1])))


def stepped_sine(rig: Rig, rng: np.random.Generator) -> np.ndarray:
    """Six frequencies one after the other."""
    samples = _time(rig).size
    steps = np.geomspace(*rig.band, STEPS)[np.arange(samples) * STEPS // samples]
    return np.sin(2 * np.pi * np.cumsum(_rounded(steps, 0.05 * rig.rate)) / rig.rate)


def multisine(rig: Rig, rng: np.random.Generator) -> np.ndarray:
    """All frequencies of the band at once, the higher ones smaller, with random phases."""
    time, (low, high) = _time(rig), rig.band
    frequencies = np.arange(max(round(low * rig.duration), 1), round(high * rig.duration) + 1) / rig.duration
    phases = rng.uniform(0.0, 2 * np.pi, frequencies.size)
    waves = np.sin(2 * np.pi * np.outer(frequencies, time) + phases[:, None])
    path = frequencies**-0.7 @ waves
    return path / np.abs(path).max()


def triangle(rig: Rig) -> np.ndarray:
    """From rest past the farthest deflection and back, at one speed [m]."""
    lowest = min(0.0, min(rig.preloads) - 1.2 * max(rig.amplitudes))
    highest = max(rig.preloads) + 1.3 * max(rig.amplitudes)
    ramp = 1.0 - np.abs(np.linspace(-1.0, 1.0, 2 * _time(rig).size))
    return lowest + (highest - lowest) * _rounded(ramp, ROUNDING * ramp.size)


def derivative(values: np.ndarray, rate: float) -> np.ndarray:
    """The slope of a smooth path given at a sampling rate [Hz]."""
    return make_interp_spline(np.arange(values.size) / rate, values, k=5).derivative()(np.arange(values.size) / rate)


def _time(rig: Rig) -> np.ndarray:
    return np.arange(round(rig.duration * rig.rate)) / rig.rate


def _rounded(values: np.ndarray, width: float) -> np.ndarray:
    window = np.hanning(2 * int(width) + 1)
    return np.convolve(np.pad(values, int(width), mode="edge"), window / window.sum(), "valid")


MOTIONS = (log_sweep, linear_sweep, stepped_sine, multisine)
