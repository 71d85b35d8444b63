"""Up to which frequency a motion shows in the force."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

TAPERS, BANDWIDTH = 9, 8.0  # all but free of leakage; half the width in lines of the band of each
FEWEST = 128  # samples of a record, and of a piece
STEADY, PASSING = 1 << 15, 1 << 12  # samples of a piece at most: for what goes on all along, and for a sweep
PART = 8  # of a record: a sweep is at each frequency for less
BY_CHANCE = 0.01  # of records of which some line seems coherent that is not


def highest_coherent(x: Array, force: Array) -> float | None:
    """The highest frequency, in periods a sample, at which a path (n,) and the force (n,) are coherent.

    That is at any time, or all along: a sweep is at each frequency but for a while, and at other times there are the
    harmonics of its force. None where none is, or where the record is too short to tell. The squared coherence of two
    signals that have nothing in common, averaged over m independent spectra, exceeds c with a probability of
    (1 - c)^(m - 1). Sources: Thomson, Proceedings of the IEEE 70 (1982) 1055, for spectra by several tapers; Carter,
    Knapp and Nuttall, IEEE Transactions on Audio and Electroacoustics 21 (1973) 337, for the distribution.
    """
    if x.size < FEWEST:
        return None
    spectra = list(_spectra(x, force))
    lines = sum(one.coherence.size for one in spectra)
    return max((each for each in (one.highest(lines) for one in spectra) if each is not None), default=None)


@dataclass(frozen=True, eq=False)
class _Spectrum:
    """A squared ``coherence`` (f,) of so many ``independent`` spectra, which show a line on so many beside it."""

    coherence: Array
    independent: float
    beside: float = 0.0

    def highest(self, lines: int) -> float | None:
        """The highest frequency of which it shows more than chance, of so many ``lines`` in all; None for none."""
        least = 1.0 - (BY_CHANCE / lines) ** (1.0 / (self.independent - 1.0))
        # next to the Nyquist frequency spectra repeat themselves, so that fewer of them are independent
        coherent = np.flatnonzero(self.coherence[: -int(BANDWIDTH)] > least)
        if not coherent.size:
            return None
        return float(0.5 * max(coherent[-1] - self.beside, 0.0) / (self.coherence.size - 1))


def _spectra(x: Array, force: Array) -> Iterator[_Spectrum]:
    """Those of all long pieces together, whose bands are narrow, and of each short one, whose bands are not."""
    length = min(x.size, STEADY)
    yield _Spectrum(_coherence(np.sum([*_products(x, force, length)], axis=0)), TAPERS * x.size / length)
    short = min(x.size // PART, PASSING)
    if short >= FEWEST:
        for products in _products(x, force, short):
            yield _Spectrum(_coherence(products), TAPERS, BANDWIDTH)


def _products(x: Array, force: Array, length: int) -> Iterator[NDArray[np.complex128]]:
    """Cross-spectrum and powers (3, f) of both signals in pieces, summed over the tapers.

    The pieces overlap by half, or a little more, from one end to the other.
    """
    from scipy.signal import detrend

    steps = -(-2 * (x.size - length) // length)
    for start in np.linspace(0, x.size - length, steps + 1).astype(int):
        pieces = (detrend(signal[start : start + length]) for signal in (x, force))
        path, answer = (np.fft.rfft(_tapers(length) * piece) for piece in pieces)
        pairs = (path, answer), (path, path), (answer, answer)
        yield np.array([np.sum(one * other.conj(), axis=0) for one, other in pairs])


def _coherence(products: NDArray[np.complex128]) -> Array:
    """The squared coherence (f,)."""
    across, own, others = products
    with np.errstate(invalid="ignore", divide="ignore"):  # lines without any power
        found: Array = np.abs(across) ** 2 / (own * others).real
    return found


@lru_cache(maxsize=8)
def _tapers(length: int) -> Array:
    """Discrete prolate spheroidal sequences (tapers, length)."""
    from scipy.signal.windows import dpss

    found: Array = dpss(length, BANDWIDTH, TAPERS)
    return found
