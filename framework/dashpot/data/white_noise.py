"""The white part of the noise on a measured signal, without knowing the signal."""

from __future__ import annotations

from functools import cache

import numpy as np

LENGTH = 15
_DEGREE = 6
FASTER = 0.5 * _DEGREE  # periods in a piece, from which on a polynomial of that degree follows no sine
_QUANTILE = 0.25


def white_noise(signal: np.ndarray) -> float:
    """Standard deviation of the white noise on a signal, in its unit; close to zero on a smooth signal.

    A polynomial of degree 6 is taken out of every 15 samples; the residual has 8 degrees of freedom. The lower quartile
    over all pieces counts, so that kinks, steps and fast parts in up to three quarters of the record do not.
    A signal of fewer than 15 samples gives zero.
    """
    rest = _rest(signal, LENGTH)
    return _everywhere(rest, LENGTH) if rest.size else 0.0


def share_everywhere(signal: np.ndarray, length: int) -> float:
    """How much of the fast part of a signal is there at all times: its deviation in quiet pieces over that in all.

    One for steady noise of any colour; less where a force bends: at reversals, valves, stops. The lower quartile of
    pieces of `length` samples counts, as in `white_noise`.
    """
    rest = _rest(signal, length)
    everywhere = _everywhere(rest, length) if rest.size else 0.0
    return min(1.0, everywhere / float(np.sqrt(np.mean(rest) / _freedom(length)))) if everywhere > 0.0 else 1.0


def _everywhere(rest: np.ndarray, length: int) -> float:
    return float(np.sqrt(np.quantile(rest, _QUANTILE) / _chi_square_quantile(_freedom(length))))


def _rest(signal: np.ndarray, length: int) -> np.ndarray:
    """Of each piece the square of what a polynomial leaves of it."""
    pieces = np.reshape(signal[: len(signal) // length * length], (-1, length))
    basis = _polynomial(length)
    return np.asarray(np.sum((pieces - (pieces @ basis) @ basis.T) ** 2, axis=1))


def _freedom(length: int) -> int:
    return length - _DEGREE - 1


@cache
def _polynomial(length: int) -> np.ndarray:
    return np.linalg.qr(np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, length), _DEGREE))[0]


@cache
def _chi_square_quantile(freedom: int) -> float:
    from scipy.special import chdtri

    return float(chdtri(freedom, 1.0 - _QUANTILE))
