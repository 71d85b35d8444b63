"""The laws of the fixed works as somebody would write them by hand for an integrator, in numba or in CasADi."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from dashpot.model.network import Characteristic

Array = NDArray[np.float64]

SHARPNESS = 10.0


@dataclass(frozen=True, eq=False)
class Equations:
    """``rate(t, y, dy)`` fills dy, ``force(t, y)`` are the forces that are measured; ``start`` is the state at
    rest, ``size`` what is small for a state: its absolute tolerance over the relative one.
    """

    rate: Callable[..., None]
    force: Callable[..., tuple[float, ...]]
    start: Array
    size: Array


@dataclass(frozen=True)
class Tongue:
    """What the laws are written in: how a function is made of Python's text, and what is chosen by a condition."""

    symbolic: bool
    compiled: Callable[[Callable[..., Any]], Callable[..., Any]]
    read: Callable[..., Any]
    dahl: Callable[..., Any]
    prandtl: Callable[..., Any]
    smaller: Callable[[Any, Any], Any]


def dahl(force, v, law):  # noqa: ANN001, ANN201
    """dF/dt of a Dahl slider."""
    return law[0] * (v - abs(v) * force / law[1])


@cache
def numba_tongue() -> Tongue:
    """Compiled functions of numbers."""
    compiled = njit(error_model="numpy")

    @compiled
    def prandtl(force, v, law):  # noqa: ANN001, ANN202
        left = max(1.0 - (force if v > 0.0 else -force) / law[1], 0.0)
        return v * law[0] * SHARPNESS * left / (1.0 + SHARPNESS * left)

    @compiled
    def read(table, x):  # noqa: ANN001, ANN202
        number = 0
        while number < table.shape[0] - 1 and x >= table[number + 1, 0]:
            number += 1
        u = x - table[max(number, 1), 0]
        return table[number, 4] + u * (table[number, 3] + u * (table[number, 2] + u * table[number, 1]))

    return Tongue(False, compiled, read, compiled(dahl), prandtl, compiled(lambda a, b: min(a, b)))


@cache
def casadi_tongue() -> Tongue:
    """Expressions of CasADi."""
    import casadi

    casadi.GlobalOptions.setNumpyMode(-1)  # np.sin of an expression is an expression

    def prandtl(force: Any, v: Any, law: Any) -> Any:
        left = casadi.fmax(1.0 - casadi.sign(v) * force / law[1], 0.0)
        return v * law[0] * SHARPNESS * left / (1.0 + SHARPNESS * left)

    def read(table: Array, x: Any) -> Any:
        knots = np.append(table[1, 0], table[1:, 0])
        start, *powers = (casadi.pw_const(x, table[1:, 0], row) for row in (knots, *table.T[1:]))
        u, (cubic, square, slope, height) = x - start, powers
        return height + u * (slope + u * (square + u * cubic))

    return Tongue(True, lambda function: function, read, dahl, prandtl, casadi.fmin)


def table_of(curve: Characteristic, held: bool) -> Array:
    """The rows of a table, knot and coefficients; before the first and after the last it is straight, or held."""
    cubic = PchipInterpolator(curve.at, [value.number for value in curve.values])
    ends = [0.0 if held else float(cubic.derivative()(curve.at[k])) for k in (0, -1)]
    low, *_, high = (value.number for value in curve.values)
    rows = [[-np.inf, 0.0, 0.0, ends[0], low]]
    rows += [[at, *piece] for at, piece in zip(curve.at, cubic.c.T.tolist(), strict=False)]
    return np.array([*rows, [curve.at[-1], 0.0, 0.0, ends[1], high]])
