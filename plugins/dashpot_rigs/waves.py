"""Motions put together in closed form: blocks of sines, stations, random profiles, on a moving middle."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.rig import PrescribedPath
from dashpot_rigs.smooth_step import smooth_step

Array = NDArray[np.float64]
Block = tuple[float, float, float]
"""Amplitude (m), frequency (Hz), and whole cycles at full amplitude."""

FADING = 1.0  # cycle before and after each block, in which its amplitude rises and falls


def require_sampling(frequency: float, sampling: float) -> None:
    """ValueError for a sine that has too few samples."""
    if sampling < 20.0 * frequency:
        raise ValueError(f"sampling: expected at least 20 samples a cycle of {frequency:g} Hz, got {sampling:g} Hz")


def sine_blocks(blocks: Sequence[Block], sample_time: float) -> PrescribedPath:
    """One block of a sine after the other around zero, in m; between two blocks the motion rests for an instant."""
    lengths = [(cycles + 2.0 * FADING) / frequency for _, frequency, cycles in blocks]
    begins = np.concatenate([[0.0], np.cumsum(lengths)])
    time = sample_time * np.arange(round(begins[-1] / sample_time) + 1, dtype=float)
    path = np.zeros((3, time.size))
    for (amplitude, frequency, _), begin, length in zip(blocks, begins, lengths, strict=False):
        inside = (time >= begin) & (time <= begin + length)
        own = time[inside] - begin
        turn = 2.0 * np.pi * frequency
        sine, cosine = np.sin(turn * own), np.cos(turn * own)
        wave = amplitude * np.stack([sine, turn * cosine, -(turn**2) * sine])
        path[:, inside] = product(plateau(own, length, FADING / frequency), wave)
    return PrescribedPath(*path)


def stations(places: Sequence[float], ramp: float, dwell: float, sample_time: float) -> PrescribedPath:
    """From place to place (m), each way in ``ramp`` s, with ``dwell`` s at each."""
    duration = len(places) * dwell + (len(places) - 1) * ramp
    time = sample_time * np.arange(round(duration / sample_time) + 1, dtype=float)
    path = np.zeros((3, time.size))
    path[0] = places[0]
    for number, (old, new) in enumerate(zip(places[:-1], places[1:], strict=True), 1):
        path += (new - old) * np.stack(smooth_step(time - number * dwell - (number - 1) * ramp, ramp))
    return PrescribedPath(*path)


def random_profile(
    exponent: float, band: tuple[float, float], duration: float, sample_time: float, seed: int
) -> PrescribedPath:
    """A random motion of an RMS of 1 m whose power density falls with frequency^exponent within the band (Hz).

    It is a sum of sines of all multiples of one over the duration with random phases, so that its rates are exact.
    """
    count = round(duration / sample_time)
    frequency = np.fft.rfftfreq(count, sample_time)
    inside = (frequency >= band[0]) & (frequency <= band[1])
    size = np.zeros(frequency.size, complex)
    phases = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, frequency.size)
    size[inside] = frequency[inside] ** (-0.5 * exponent) * np.exp(1j * phases[inside])
    size /= np.sqrt(2.0 * np.sum(np.abs(size) ** 2)) / count
    turn = 2j * np.pi * frequency
    return PrescribedPath(*(np.fft.irfft(size * turn**order, count) for order in range(3)))


def plateau(time: Array, length: float, fade: float) -> Array:
    """A level with its first and second rate (3, n): it rises from 0 to 1 and falls again within ``length`` s."""
    rising, falling = np.stack(smooth_step(time, fade)), np.stack(smooth_step(time - length + fade, fade))
    return rising - falling


def product(level: Array, wave: Array) -> Array:
    """Level times wave (3, n), each with its first and second rate."""
    return np.stack(
        [
            level[0] * wave[0],
            level[1] * wave[0] + level[0] * wave[1],
            level[2] * wave[0] + 2.0 * level[1] * wave[1] + level[0] * wave[2],
        ]
    )


def around(path: PrescribedPath, middle: float | PrescribedPath, factor: float = 1.0) -> PrescribedPath:
    """A path times a factor, around a place (m) or another motion."""
    if isinstance(middle, float):
        middle = PrescribedPath(np.full_like(path.displacement, middle), *np.zeros((2, path.displacement.size)))
    return PrescribedPath(
        middle.displacement + factor * path.displacement,
        middle.velocity + factor * path.velocity,
        middle.acceleration + factor * path.acceleration,
    )


def faded(path: PrescribedPath, fade: float, sample_time: float) -> PrescribedPath:
    """A path whose beginning and end fade to rest at zero."""
    time = sample_time * np.arange(path.displacement.size, dtype=float)
    wave = np.stack([path.displacement, path.velocity, path.acceleration])
    return PrescribedPath(*product(plateau(time, float(time[-1]), fade), wave))


def millimetres(length: float) -> str:
    """A length in a name: 0.5 mm is `0p5`, -2 mm is `m2`."""
    return plain(1e3 * length)


def plain(number: float) -> str:
    """A number in a name: 0.5 is `0p5`, -2 is `m2`."""
    return f"{number:.6g}".replace(".", "p").replace("-", "m").replace("+", "")
