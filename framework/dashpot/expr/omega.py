"""The Wright omega function in plain numpy: importing a library for it would take longer than most commands."""

from __future__ import annotations

from typing import Any

import numpy as np

LOW, HIGH = -40.0, 1e100  # outside which y is exp(x), or x, to the last place
STEPS = 3


def wrightomega(x: Any) -> Any:
    """The solution y of y + ln y = x, by the iteration of fourth order of Fritsch, Shafer and Crowley.

    Source: Lawrence, Corless and Jeffrey, ACM Trans. Mathematical Software 38 (2012) 20.
    """
    x = np.asarray(x, dtype=float)
    # a start that is right to a tenth, also where the other form would overflow
    inner = np.clip(x, LOW, HIGH)
    y = np.where(inner > 1.0, inner - np.log(np.maximum(inner, 1.0)), np.log1p(np.exp(np.minimum(inner, 1.0) - 0.6)))
    y = np.where(inner < -2.0, np.exp(np.minimum(inner, 0.0)), y)
    for _ in range(STEPS):
        r = inner - y - np.log(y)
        t = (1.0 + y) * (1.0 + y + 2.0 / 3.0 * r)
        y = y * (1.0 + r / (1.0 + y) * (t - 0.5 * r) / (t - r))
    return np.where(x < LOW, np.exp(np.minimum(x, 0.0)), np.where(x > HIGH, x, y))[()]
