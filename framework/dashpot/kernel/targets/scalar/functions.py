"""Functions that mathematics libraries do not have, and tables."""

from __future__ import annotations

from collections.abc import Sequence
from math import log

from dashpot.kernel.targets.omega import OMEGA_BOTTOM, OMEGA_HIGH, OMEGA_LOW, OMEGA_TOP
from dashpot.kernel.targets.scalar.code import Arguments, Code

X: Arguments = [("number", "x")]
PAIR: Arguments = [("number", "a"), ("number", "b")]
TABLE: Arguments = [("array", "s"), ("count", "t"), ("count", "first"), ("count", "count"), ("number", "x")]
STEEPER = 3.0
NEAR, TERMS = 0.3, 11  # the series of log1p is used up to there; z^2 < 0.0312, so that 11 terms leave less than 1e-17


def write_functions(code: Code, used: set[str]) -> None:
    """Those of the functions that are ``used``."""
    for name, write in (("minimum", _smaller), ("maximum", _larger), ("sign", _sign), ("wrightomega", _omega)):
        if name in used:
            write(code)
    for name, write in (("expm1", _expm1), ("log1p", _log1p)):
        if name in used & code.lacking:
            write(code)


def _smaller(code: Code) -> None:
    _chosen(code, "smaller", "<", "The smaller one, NaN if one is.")


def _larger(code: Code) -> None:
    _chosen(code, "larger", ">", "The larger one, NaN if one is.")


def _chosen(code: Code, name: str, how: str, about: str) -> None:
    with code.function("number", name, PAIR, about):
        with code.when(f"(a {how} b) | (a != a)"):
            code.answer("a")
        code.answer("b")


def _sign(code: Code) -> None:
    with code.function("number", "side", X, "-1, 0, 1 or NaN."):
        with code.when("x > 0.0"):
            code.answer("1.0")
        with code.when("x < 0.0"):
            code.answer("-1.0")
        code.answer("x")


def _expm1(code: Code) -> None:
    with code.function("number", "expm1", X, "exp(x) - 1 without loss of digits near zero."):
        with code.when("fabs(x) > 1.0"):
            code.answer("exp(x) - 1.0")
        code.answer("2.0 * exp(0.5 * x) * sinh(0.5 * x)")


def _log1p(code: Code) -> None:
    with code.function("number", "log1p", X, "log(1 + x) without loss of digits near zero."):
        with code.when(f"fabs(x) > {NEAR}"):
            code.answer("log(1.0 + x)")
        code.let("z", "x / (2.0 + x)")  # log(1 + x) = 2 artanh(z)
        series = _polynomial([1.0 / (2 * k + 1) for k in range(TERMS)], "(z * z)")
        code.answer(f"2.0 * z * {series}")


def _omega(code: Code) -> None:
    with code.function("number", "omega", X, "The solution y of y + log(y) = x."):
        for name in ("y", "start", "b", "m"):
            code.let(name, "0.0")
        code.let("low", "x")
        with code.when(f"x > {OMEGA_HIGH}"):
            code.set("y", "x - log(x)")
            for _ in range(3):
                code.set("y", "y * (1.0 + x - log(y)) / (1.0 + y)")
            with code.when("x > 1e300"):
                code.set("y", "x")
        with code.otherwise():
            with code.when(f"x < {OMEGA_LOW}"):
                code.set("low", f"{OMEGA_LOW}")
            part = f"{_polynomial(OMEGA_TOP, 'low')} / {_polynomial(OMEGA_BOTTOM, 'low')}"
            code.set("start", f"{log(2.0)!r} * ({part}) + (x - low)")
            code.set("y", "exp(start)")
            code.set("b", "1.0 / (1.0 + y)")
            code.set("m", "(x - start - y) * b")
            code.set("y", "y * (1.0 + m * (1.0 + b * m * (0.5 + m * (0.5 * b - 1.0 / 3.0))))")
        code.answer("y")


def _polynomial(coefficients: Sequence[float], x: str) -> str:
    *others, total = map(repr, coefficients)
    for coefficient in reversed(others):
        total = f"({coefficient} + {x} * {total})"
    return total


def write_tables(code: Code, orders: set[int]) -> None:
    """The value of a table, or its derivatives."""
    for order, value in enumerate(
        (
            "s[c] + u * (s[c + 1] + u * (s[c + 2] + u * s[c + 3]))",
            "s[c + 1] + u * (2.0 * s[c + 2] + 3.0 * u * s[c + 3])",
            "2.0 * s[c + 2] + 6.0 * u * s[c + 3]",
        )
    ):
        if order not in orders:
            continue
        with code.function("number", f"table{order}", TABLE, "A table at x, or its first or second derivative."):
            code.let("k", "first", "count")
            with code.loop("j", "first + 1", "first + count + 1"), code.when("x >= knots[j]"):
                code.set("k", "k + 1")  # a sum, for which compilers compare with several knots at once
            code.let("u", "x - knots[k]")
            code.let("c", "t + 4 * k", "count")
            code.answer(value)


def write_tabulate(code: Code) -> None:
    """The monotone cubic through the values of a table; see ``kernel.curves``."""
    _write_slope(code)
    arguments: Arguments = [
        ("array", "s"),
        ("count", "t"),
        ("array", "p"),
        ("count", "q"),
        ("count", "first"),
        ("count", "count"),
        ("number", "outside"),
    ]
    with code.function("nothing", "tabulate", arguments, "The cubics of a table whose values begin at p[q]."):
        code.let("c", "t + 4 * first", "count")
        with code.loop("k", 0, "count"):
            code.set("c", "c + 4")
            code.set("s[c]", "p[q + k]")
            code.set("s[c + 1]", "slope(p, q, first, count, k)")
        code.let("before", "t + 4 * first", "count")
        code.set("s[before]", "p[q]")
        code.set("s[before + 1]", "outside * s[before + 5]")
        with code.loop("k", 0, "count - 1"):
            code.set("c", "before + 4 * k + 4")
            code.let("width", "knots[first + k + 2] - knots[first + k + 1]")
            code.let("rise", "(p[q + k + 1] - p[q + k]) / width")
            code.set("s[c + 2]", "(3.0 * rise - 2.0 * s[c + 1] - s[c + 5]) / width")
            code.set("s[c + 3]", "(s[c + 1] + s[c + 5] - 2.0 * rise) / (width * width)")
        code.set("c", "before + 4 * count")
        code.set("s[c + 1]", "outside * s[c + 1]")


def _write_slope(code: Code) -> None:
    arguments: Arguments = [("array", "p"), ("count", "q"), ("count", "first"), ("count", "count"), ("count", "k")]
    with code.function("number", "slope", arguments, "The slope at a knot: Fritsch and Butland (1984)."):
        code.let("j", "k", "count")
        with code.when("j > 0"):
            code.set("j", "j - 1")
        code.let("i", "j + 1", "count")
        with code.when("i > count - 2"):
            code.set("i", "count - 2")
            with code.when("j > 0"):
                code.set("j", "i - 1")
        _let_segment(code, "0", "j")
        _let_segment(code, "1", "i")
        code.let("m", "r0")
        with code.when("count > 2"):
            with code.when("k == count - 1"):
                for one, other in (("w0", "w1"), ("r0", "r1")):
                    code.set("m", one)
                    code.set(one, other)
                    code.set(other, "m")
            with code.when("(k == 0) | (k == count - 1)"):
                _set_end_slope(code)
            with code.otherwise():
                _set_inner_slope(code)
        code.answer("m")


def _set_inner_slope(code: Code) -> None:
    """The harmonic mean of both sides; zero where they differ in sign."""
    left, right = "(2.0 * w1 + w0)", "(w1 + 2.0 * w0)"
    with code.when("r0 * r1 <= 0.0"):
        code.set("m", "0.0")
    with code.otherwise():
        code.set("m", f"({left} + {right}) / ({left} / r0 + {right} / r1)")


def _set_end_slope(code: Code) -> None:
    """Through three points, as long as the curve stays monotone."""
    code.set("m", "((2.0 * w0 + w1) * r0 - w0 * r1) / (w0 + w1)")
    with code.when("m * r0 <= 0.0"):
        code.set("m", "0.0")
    with code.when(f"(r0 * r1 <= 0.0) & (fabs(m) > {STEEPER} * fabs(r0))"):
        code.set("m", f"{STEEPER} * r0")


def _let_segment(code: Code, number: str, name: str) -> None:
    code.let(f"w{number}", f"knots[first + {name} + 2] - knots[first + {name} + 1]")
    code.let(f"r{number}", f"(p[q + {name} + 1] - p[q + {name}]) / w{number}")
