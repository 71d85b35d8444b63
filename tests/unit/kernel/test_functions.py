"""The long functions of a kernel against numpy, scipy and numbers of many digits."""

from __future__ import annotations

from collections.abc import Callable

import mpmath
import numpy as np
import pytest
from scipy.special import wrightomega
from seeds import seed_of

from dashpot.kernel.ir.layout import LANES
from dashpot.kernel.targets.llvm import functions
from dashpot.kernel.targets.llvm.assembly import Assembly, Bundle
from dashpot.kernel.targets.llvm.native import load_native
from dashpot.kernel.targets.llvm.source import whole

VECTORS = 2


@pytest.fixture(scope="module")
def run():
    """``run(name, x)`` or ``run(name, x, y)``: a function on arrays."""
    return lambda name, *arguments: mapped(getattr(functions, name), *arguments)


def mapped(function: Callable[..., Bundle | functions.Rare], *arguments: np.ndarray) -> np.ndarray:
    """A function of bundles on arrays, two vectors at once."""
    a, names = Assembly(), [f"%x{number}" for number in range(len(arguments))]
    width, size = LANES * VECTORS, arguments[0].size
    with a.loop(0, "%samples", width) as k:
        places = {
            name: [a.address(a.address(name, k), LANES * part) for part in range(VECTORS)] for name in (*names, "%out")
        }
        answer = function(*(a.load(places[name]) for name in names))
        a.store(answer.amended() if isinstance(answer, functions.Rare) else answer, places["%out"])
    a.do("ret void")
    text = whole("run", ["i64 %samples", "ptr %out", *(f"ptr {name}" for name in names)], a)
    full = [np.resize(np.asarray(argument, dtype=float), size + -size % width) for argument in arguments]
    out = np.empty(full[0].size)
    load_native(text, 2 + len(arguments))(out.size, out, *full)
    return out[:size]


RNG = np.random.default_rng(seed_of("test_functions"))
WIDE = np.concatenate(
    [
        RNG.uniform(-700.0, 700.0, 20_000),
        RNG.uniform(-1.0, 1.0, 20_000),
        RNG.choice([-1.0, 1.0], 5000) * 10.0 ** RNG.uniform(-300.0, 2.0, 5000),
    ]
)


def test_exp_is_good_to_fourteen_digits(run):
    assert np.max(np.abs(run("exp", WIDE) / np.exp(WIDE) - 1.0)) < 1e-14


def test_exp_ends_in_very_small_and_very_large_numbers(run):
    low, high, zero, one = run("exp", np.array([-1e4, 1e4, 0.0, 1.0]))
    assert 0.0 <= low < 1e-300 and high > 1e300 and zero == 1.0 and one == pytest.approx(np.e, rel=1e-15)
    assert run("exp", np.array([-np.inf]))[0] < 1e-300 < 1e300 < run("exp", np.array([np.inf]))[0]


def test_log_is_good_to_fourteen_digits(run):
    x = 10.0 ** RNG.uniform(-307.0, 308.0, 40_000)
    assert np.max(np.abs(run("log", x) / np.log(x) - 1.0)) < 1e-14
    near = 1.0 + RNG.uniform(-0.3, 0.4, 20_000)
    assert np.max(np.abs(run("log", near) - np.log(near)) / np.abs(np.log(near))) < 1e-14


def test_log_of_what_has_none(run):
    zero, negative, infinite = run("log", np.array([0.0, -1.0, np.inf]))
    assert zero == -np.inf and np.isnan(negative) and infinite == np.inf


def test_wrightomega_is_good_to_fourteen_digits(run):
    x = np.concatenate([RNG.uniform(-40.0, 40.0, 40_000), 10.0 ** RNG.uniform(0.0, 12.0, 10_000)])
    assert np.max(np.abs(run("wrightomega", x) / wrightomega(x) - 1.0)) < 1e-14


def test_wrightomega_vanishes_far_below(run):
    assert np.all(run("wrightomega", np.array([-700.0, -800.0, -1e6])) < 1e-300)


DENORMAL_AND_UP = RNG.choice([-1.0, 1.0], 1500) * 10.0 ** RNG.uniform(-323.0, 0.0, 1500)
ORDINARY = RNG.uniform(-3.0, 3.0, 1500)
PLACES = {
    "expm1": [DENORMAL_AND_UP, ORDINARY, RNG.uniform(-50.0, 709.7, 1500)],
    "tanh": [DENORMAL_AND_UP, ORDINARY, RNG.uniform(-30.0, 30.0, 1500)],
    "log1p": [
        DENORMAL_AND_UP,
        np.abs(ORDINARY),
        10.0 ** RNG.uniform(0.0, 308.0, 1500),
        -1.0 + np.geomspace(1e-15, 0.9, 1500),
    ],
}


def units_away(found: np.ndarray, exact: Callable[..., mpmath.mpf], *arguments: np.ndarray) -> float:
    """The largest distance from the exact value, in units of the last place of that."""
    with mpmath.workprec(160):
        away = []
        for number, *given in zip(found, *arguments, strict=True):
            truth = exact(*map(mpmath.mpf, given))
            away.append(float(abs(mpmath.mpf(number) - truth) / np.spacing(abs(float(truth)))))
    return max(away)


@pytest.mark.parametrize("name", PLACES)
def test_a_function_near_zero_is_good_to_its_last_places_everywhere(run, name):
    x = np.concatenate(PLACES[name])
    assert units_away(run(name, x), getattr(mpmath, name), x) < 2.5


def test_a_power_is_good_to_its_last_places_everywhere(run):
    # numbers of every size and near one, denormal numbers and powers among them
    x = np.concatenate([10.0 ** RNG.uniform(-323.0, 308.0, 2000), RNG.uniform(0.5, 2.0, 2000)])
    y = RNG.uniform(-744.0, 709.0, x.size) / np.log(x)
    assert units_away(run("power", x, y), mpmath.power, x, y) < 1.5


STRANGE = np.array(
    [
        -np.inf,
        -1e300,
        -3.0,
        -2.5,
        -1.0,
        -0.5,
        -1e-310,
        -0.0,
        0.0,
        1e-310,
        0.5,
        1.0,
        2.0,
        2.5,
        3.0,
        1e300,
        np.inf,
        np.nan,
    ]
)


@pytest.mark.parametrize(("name", "count"), [("expm1", 1), ("tanh", 1), ("log1p", 1), ("power", 2)])
def test_at_infinities_zeros_and_branch_points_a_function_is_what_numpy_has(run, name, count):
    arguments = [grid.ravel() for grid in np.meshgrid(*[STRANGE] * count)]
    with np.errstate(all="ignore"):
        expected = getattr(np, name)(*arguments)
    found = run(name, *arguments)
    assert np.allclose(found, expected, rtol=1e-15, atol=1e-323, equal_nan=True)
    known = ~np.isnan(expected)
    assert np.array_equal(np.signbit(found[known]), np.signbit(expected[known]))


def test_rare_numbers_leave_their_neighbours_as_they_are(run):
    x, y = np.array([2.0, -2.0, 0.0, np.nan, 3.0, 1e-320, 2.0, 9.0]), np.array([0.5, 3.0, 1.5, 1.0, 0.5, 0.5, 0.5, 0.5])
    alone = np.array([run("power", x[k : k + 1], y[k : k + 1])[0] for k in range(x.size)])
    assert np.array_equal(run("power", x, y), alone, equal_nan=True)


@pytest.mark.parametrize("name", ["exp", "expm1", "log", "log1p", "tanh", "wrightomega", "sign"])
def test_nan_passes(run, name):
    assert np.isnan(run(name, np.array([np.nan]))[0])


@pytest.mark.parametrize(("name", "expected"), [("minimum", np.minimum), ("maximum", np.maximum)])
def test_the_smaller_and_the_larger_of_two_as_numpy_has_it(run, name, expected):
    x, y = (
        grid.ravel() for grid in np.meshgrid([-np.inf, -1.0, 0.0, 2.0, np.inf, np.nan], [-1.0, 0.5, np.nan, np.inf])
    )
    assert np.array_equal(run(name, x, y), expected(x, y), equal_nan=True)


def test_the_sign_as_numpy_has_it(run):
    x = np.array([-np.inf, -2.0, -0.0, 0.0, 1e-300, 3.0, np.inf, np.nan])
    assert np.array_equal(run("sign", x), np.sign(x), equal_nan=True)
