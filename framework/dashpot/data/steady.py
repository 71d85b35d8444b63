"""A steady sine of which the fundamental of the force is known alone, as a row of a stiffness table tells it.

It is a run like any other: its motion is the sine, from rest at the preload on until all that rings or slides has
settled, and its force is the fundamental. What a model has more, its mean and its harmonics, no table tells; so a
simulated force is seen through `fundamental_of`, too.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STEADY = "steady"  # the kind of such a run
SAMPLES = 100  # in a period
PERIODS_SEEN = 3  # of which the fundamental is taken
FEWEST_PERIODS, SETTLING = 7, 1.0  # before these; s


def steady_samples(frequency: float) -> int:
    """The samples of a run at a frequency in Hz, in whole periods."""
    return (max(FEWEST_PERIODS, int(np.ceil(SETTLING * frequency))) + PERIODS_SEEN) * SAMPLES


def sine(samples: int) -> Array:
    """A sine (samples,) of amplitude 1 that begins at zero."""
    return np.sin(2.0 * np.pi * np.arange(samples) / SAMPLES)


def cosine(samples: int) -> Array:
    """A cosine (samples,) of amplitude 1, the rate of the sine over its angular frequency."""
    return np.cos(2.0 * np.pi * np.arange(samples) / SAMPLES)


def harmonic_of(force: Array) -> NDArray[np.complex128]:
    """The fundamental of forces (..., n) in N over the last periods: in phase with the sine, and i times ahead of it.

    Under a Hann window, which parts it from mean and harmonics, and from most of what still relaxes.
    """
    count = PERIODS_SEEN * SAMPLES
    first = force.shape[-1] - count
    window = 1.0 - np.cos(2.0 * np.pi * np.arange(count) / count)
    weights = 2.0 / count * window * (sine(force.shape[-1]) + 1j * cosine(force.shape[-1]))[first:]
    return np.asarray(np.asarray(force)[..., first:] @ weights)


def parts_of(period: Array) -> Array:
    """The fundamental (..., 2) in N of one period (..., n) that begins at a zero: in phase with the sine, and ahead.

    The two values have the root mean square of the period.
    """
    count = period.shape[-1]
    return np.asarray(period @ np.array([sine(count), cosine(count)]).T * (2.0 / count))


def fundamental_of(force: Array) -> Array:
    """Forces (..., n) in N as a table knows them: their fundamental, without mean and harmonics."""
    found, count = harmonic_of(force), force.shape[-1]
    return np.asarray(found.real[..., None] * sine(count) + found.imag[..., None] * cosine(count))
