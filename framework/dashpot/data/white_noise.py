"""The white part of the noise on a measured signal, without knowing the signal."""

from __future__ import annotations

from functools import cache

import numpy as np

_LENGTH = 15
_DEGREE = 6
_QUANTILE = 0.25


def white_noise(signal: np.ndarray) -> float:
    """Standard deviation of the white noise on a signal, in its unit; close to zero on a smooth signal.

    A polynomial of degree 6 is taken out of every 15 samples; the residual has 8 degrees of freedom. The lower quartile
    over all pieces counts, so that kinks, steps and fast parts in up to three quarters of the record do not.
    A signal of fewer than 15 samples gives zero.
    """
    pieces = len(signal) // _LENGTH
    if pieces == 0:
        return 0.0
    rest = np.reshape(signal[: pieces * _LENGTH], (pieces, _LENGTH)) @ _rest_of_polynomial()
    return float(np.sqrt(np.quantile(np.sum(rest**2, axis=1), _QUANTILE) / _chi_square_quantile()))


@cache
def _rest_of_polynomial() -> np.ndarray:
    polynomial, _ = np.linalg.qr(np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, _LENGTH), _DEGREE))
    return np.eye(_LENGTH) - polynomial @ polynomial.T


@cache
def _chi_square_quantile() -> float:
    from scipy.special import chdtri

    return float(chdtri(_LENGTH - _DEGREE - 1, 1.0 - _QUANTILE))
