"""The friction laws of every exponent against an integration over one monotone step."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from verification.truth.laws import dahl_slope, prandtl_slope

from dashpot import Motion, load_registry

EXPONENTS = [0.0, 0.5, 1.0, 1.5, 2.0]
STIFFNESS, LIMIT = 6e4, 15.0
YIELDING = LIMIT / STIFFNESS


def step(element, travel, force, **numbers):
    """The element's own answer to a single step; a side of 0 says that it has not moved before."""
    x = Motion(2e-3, 2e-3 + travel, np.nan, np.nan, np.nan)
    z = SimpleNamespace(force=np.float64(force), side=0.0, reach=0.0)
    with np.errstate(all="ignore"):
        return float(load_registry().elements[element]().step(x, z, SimpleNamespace(**numbers), np.nan).force)


def integrate(slope, travel, force):
    """dF/dx over a travel; where the slider is fully slipping the force stays."""
    side = np.sign(travel)

    def slips(x, f):
        return 1.0 - side * f[0] / LIMIT

    slips.terminal = True
    # sign and root have no derivative where slipping begins: the event ends the integration there
    found = solve_ivp(
        lambda x, f: side * slope(f, side),
        (0.0, abs(travel)),
        [force],
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        events=slips if abs(side * force - LIMIT) > 1e-9 else None,
        max_step=max(abs(travel) / 20.0, 1e-12),
    )
    assert found.success
    return side * LIMIT if found.status == 1 else float(found.y[0, -1])


@pytest.mark.parametrize("start", [-1.0, -0.6, 0.0, 0.5, 0.95, 1.6, -2.3])
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_a_dahl_step_of_any_exponent_solves_its_equation(exponent, start):
    for way in np.outer([-YIELDING, YIELDING], [1e-3, 0.1, 0.7, 2.5, 9.0]).ravel():
        found = step("dahl", way, start * LIMIT, stiffness=STIFFNESS, limit=LIMIT, exponent=exponent)
        expected = integrate(lambda f, s: dahl_slope(f, s, STIFFNESS, LIMIT, exponent), way, start * LIMIT)
        assert found == pytest.approx(expected, abs=1e-8 * LIMIT)


@pytest.mark.parametrize("start", [-1.0, -0.4, 0.0, 0.9])
@pytest.mark.parametrize("sharpness", [0.3, 10.0, 300.0])
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_a_prandtl_step_of_any_exponent_solves_its_equation(exponent, sharpness, start):
    for way in np.outer([-YIELDING, YIELDING], [1e-3, 0.4, 1.1, 2.2, 12.0]).ravel():
        # at full slip nothing changes any more, and the integration could not begin
        force = start * LIMIT * (1.0 - 1e-6 * (way * start > 0.0 and abs(start) == 1.0))
        numbers = {"stiffness": STIFFNESS, "limit": LIMIT, "sharpness": sharpness, "exponent": exponent}
        expected = integrate(lambda f, s: prandtl_slope(f, s, STIFFNESS, LIMIT, sharpness, exponent), way, force)
        assert step("prandtl", way, force, **numbers) == pytest.approx(expected, abs=1e-8 * LIMIT)


@pytest.mark.parametrize("exponent", [0.0, 0.25, 0.5])
def test_below_exponent_one_a_slider_slips_fully_after_a_finite_travel(exponent):
    # u^(1-i) falls in proportion to the travel and is zero after u0^(1-i)/(1-i)
    needed = YIELDING / (1.0 - exponent)
    numbers = {"stiffness": STIFFNESS, "limit": LIMIT, "exponent": exponent}
    assert step("dahl", 1.0001 * needed, 0.0, **numbers) == LIMIT
    left = 0.001 ** (1.0 / (1.0 - exponent))
    assert step("dahl", 0.999 * needed, 0.0, **numbers) == pytest.approx(LIMIT * (1.0 - left), rel=1e-12)
    assert step("dahl", 0.999 * needed, 0.0, **numbers) < LIMIT
    # the spring in series needs its own travel before
    needed = YIELDING * (1.0 + 1.0 / (10.0 * (1.0 - exponent)))
    assert step("prandtl", 1.0001 * needed, 0.0, sharpness=10.0, **numbers) == LIMIT
    assert 0.9 * LIMIT < step("prandtl", 0.999 * needed, 0.0, sharpness=10.0, **numbers) < LIMIT


@pytest.mark.parametrize("element", ["dahl", "prandtl"])
def test_the_exponent_one_is_no_special_case(element):
    numbers = {"stiffness": STIFFNESS, "limit": LIMIT} | ({"sharpness": 10.0} if element == "prandtl" else {})
    for travel in (0.3 * YIELDING, -2.0 * YIELDING):
        middle = step(element, travel, 4.0, exponent=1.0, **numbers)
        for near in (1.0 - 1e-7, 1.0 + 1e-7):
            assert step(element, travel, 4.0, exponent=near, **numbers) == pytest.approx(middle, abs=1e-6)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_a_step_that_goes_nowhere_changes_nothing(exponent):
    for force in (-15.0, -3.0, 0.0, 7.5, 15.0):
        assert step("dahl", 0.0, force, stiffness=STIFFNESS, limit=LIMIT, exponent=exponent) == pytest.approx(force)
        numbers = {"stiffness": STIFFNESS, "limit": LIMIT, "sharpness": 10.0, "exponent": exponent}
        assert step("prandtl", 0.0, force, **numbers) == pytest.approx(force, abs=1e-12)


def test_a_prandtl_element_of_infinite_spring_stiffness_is_a_dahl_element():
    # the slider keeps its stiffness while the spring becomes ever stiffer
    for travel in (0.3 * YIELDING, -2.0 * YIELDING):
        dahl = step("dahl", travel, 4.0, stiffness=STIFFNESS, limit=LIMIT, exponent=1.0)
        found = step("prandtl", travel, 4.0, stiffness=STIFFNESS / 1e-7, limit=LIMIT, sharpness=1e-7, exponent=1.0)
        assert found == pytest.approx(dahl, abs=1e-5)
