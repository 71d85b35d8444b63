"""Up to which frequency a motion shows in the force."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

TAPERS, BANDWIDTH = 9, 8.0  # all but free of leakage; half the width in lines of the band of each
FEWEST, LONGEST = 128, 1 << 15  # samples of a piece
BY_CHANCE = 0.01  # of records of which some line seems coherent that is not


def highest_coherent(x: Array, force: Array) -> float | None:
    """The highest frequency, in periods a sample, at which a path (n,) and the force (n,) are coherent.

    None where none is, or where the record is too short to tell. The squared coherence of two signals that have nothing
    in common, averaged over m independent spectra, exceeds c with a probability of (1 - c)^(m - 1). Sources: Thomson,
    Proceedings of the IEEE 70 (1982) 1055, for spectra by several tapers; Carter, Knapp and Nuttall, IEEE Transactions
    on Audio and Electroacoustics 21 (1973) 337, for the distribution.
    """
    length = min(x.size, LONGEST)
    if length < FEWEST:
        return None
    across, own, others = _spectra(x, force, length)
    with np.errstate(invalid="ignore", divide="ignore"):  # lines without any power
        found = np.abs(across) ** 2 / (own * others)
    independent = TAPERS * (x.size // length)
    least = 1.0 - (BY_CHANCE / found.size) ** (1.0 / (independent - 1.0))
    # next to the Nyquist frequency spectra repeat themselves, so that fewer of them are independent
    coherent = np.flatnonzero(found[: -int(BANDWIDTH)] > least)
    return float(coherent[-1] / length) if coherent.size else None


def _spectra(x: Array, force: Array, length: int) -> tuple[NDArray[np.complex128], Array, Array]:
    """The cross-spectrum (f,) of two signals, and the power of each, summed over pieces and tapers."""
    from scipy.signal import detrend

    across, own, others = np.zeros(length // 2 + 1, dtype=complex), *np.zeros((2, length // 2 + 1))
    for start in range(0, x.size - length + 1, length):
        path, answer = (np.fft.rfft(_tapers(length) * detrend(signal[start : start + length])) for signal in (x, force))
        across += np.sum(path * answer.conj(), axis=0)
        own += np.sum(np.abs(path) ** 2, axis=0)
        others += np.sum(np.abs(answer) ** 2, axis=0)
    return across, own, others


@lru_cache(maxsize=8)
def _tapers(length: int) -> Array:
    """Discrete prolate spheroidal sequences (tapers, length)."""
    from scipy.signal.windows import dpss

    found: Array = dpss(length, BANDWIDTH, TAPERS)
    return found
