"""How alike two signals are."""

from __future__ import annotations

import numpy as np


def correlation(first: np.ndarray, second: np.ndarray) -> float:
    """The correlation coefficient of two signals (n,), 0 when one of them does not change or is empty."""
    if not first.size:
        return 0.0
    signals = [values - np.mean(values) for values in (first, second)]
    sizes = [float(np.max(np.abs(signal))) for signal in signals]
    if min(sizes) < np.finfo(float).tiny:
        return 0.0
    one, other = (signal / size for signal, size in zip(signals, sizes, strict=True))
    return float(one @ other / np.sqrt((one @ one) * (other @ other)))
