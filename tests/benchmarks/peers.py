"""General integrators on hand-written equations: what they need to be as exact as dashpot, on one lane.

An integrator is given equations, times and how exact it is to be, and answers a function that computes the states
(n, samples): only that function is timed, not what is compiled or built before.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from importlib.util import find_spec
from typing import Any

import numpy as np
from laws import Equations, Tongue, casadi_tongue, numba_tongue
from numba import carray, cfunc, njit
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Work = Callable[[], Array]
Integrator = Callable[[Equations, Array, float], Work]

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
PARTS = (1, 2, 4, 8, 16, 32)
NUMBALSODA, SUNDIALS = "numbalsoda LSODA", "CVODE (scikit-sundae), jitted rates"
LIBRARIES = {"numbalsoda": "numbalsoda", "sksundae": "scikit-sundae", "casadi": "casadi"}


@dataclass(frozen=True)
class Entry:
    """Nanoseconds of processor time per sample of one lane, at the loosest setting that reached an error (rms, N)."""

    who: str
    setting: str
    nanoseconds: float
    error: float


def peers(write: Callable[[Tongue], Equations], truth: Array, times: Array, goal: float) -> Iterator[Entry]:
    """Every integrator that is there, as loose as it may be to reach ``goal`` in N against ``truth`` (samples, n).

    ``write`` writes the equations in a tongue.
    """
    equations = write(numba_tongue())
    yield _loosest("Runge-Kutta 4, numba", "steps a sample", PARTS, runge_kutta, equations, truth, times, goal)
    for name, integrator in integrators(write).items():
        yield _loosest(name, "rtol", TOLERANCES, integrator, equations, truth, times, goal)


def missing() -> list[str]:
    """The libraries that would take part if they were installed."""
    return [name for module, name in LIBRARIES.items() if not find_spec(module)]


def integrators(write: Callable[[Tongue], Equations]) -> dict[str, Integrator]:
    """The adaptive ones that are installed."""
    found: dict[str, Integrator] = {"solve_ivp LSODA, jitted rates": lsoda, "solve_ivp RK45, jitted rates": rk45}
    if find_spec("numbalsoda"):
        found[NUMBALSODA] = numbalsoda
    if find_spec("sksundae"):
        found[SUNDIALS] = cvode
    if find_spec("casadi"):
        found["CasADi CVODES"] = partial(casadi_cvodes, write(casadi_tongue()))
    return found


def lsoda(equations: Equations, times: Array, rtol: float) -> Work:
    """The one of scipy."""
    return _solve_ivp(equations, times, rtol, "LSODA")


def rk45(equations: Equations, times: Array, rtol: float) -> Work:
    """The one of scipy."""
    return _solve_ivp(equations, times, rtol, "RK45")


def _solve_ivp(equations: Equations, times: Array, rtol: float, method: str) -> Work:
    rate, span, small = answering(equations.rate), (times[0], times[-1]), _small(equations, rtol)
    return lambda: solve_ivp(rate, span, equations.start, method, times, rtol=rtol, atol=small).y


def numbalsoda(equations: Equations, times: Array, rtol: float) -> Work:
    """One absolute tolerance for all states."""
    from numbalsoda import lsoda as solve

    place, small = _address(equations.rate, equations.start.size), float(min(_small(equations, rtol)))

    def work() -> Array:
        states, good = solve(place.address, equations.start, times, rtol=rtol, atol=small)
        return states.T if good else np.full((equations.start.size, times.size), np.nan)

    return work


@cache
def _address(rate: Callable[..., None], size: int) -> Any:
    from numbalsoda import lsoda_sig

    @cfunc(lsoda_sig)
    def right(t, y, dy, _):  # noqa: ANN001, ANN202
        rate(t, carray(y, (size,)), carray(dy, (size,)))

    return right


def cvode(equations: Equations, times: Array, rtol: float) -> Work:
    """The one of SUNDIALS, called from Python."""
    from sksundae.cvode import CVODE

    solver = CVODE(equations.rate, method="BDF", rtol=rtol, atol=_small(equations, rtol), max_num_steps=1_000_000)
    return lambda: np.asarray(solver.solve(times, equations.start).y).T


def casadi_cvodes(symbolic: Equations, equations: Equations, times: Array, rtol: float) -> Work:
    """The one of SUNDIALS on expressions of CasADi; one absolute tolerance for all states."""
    import casadi

    t, y = casadi.SX.sym("t"), casadi.SX.sym("y", equations.start.size)
    dy = [casadi.SX(0.0)] * equations.start.size
    symbolic.rate(t, y, dy)
    options = {"reltol": rtol, "abstol": float(min(_small(equations, rtol))), "max_num_steps": 10_000_000}
    solver = casadi.integrator(
        "solver", "cvodes", {"x": y, "t": t, "ode": casadi.vertcat(*dy)}, float(times[0]), times.tolist(), options
    )
    return lambda: np.array(solver(x0=equations.start)["xf"])


def runge_kutta(equations: Equations, times: Array, parts: int) -> Work:
    """Classical steps, ``parts`` to a sample."""
    return lambda: march(equations.rate, equations.start, times, int(parts)).T


@njit(error_model="numpy")
def march(rate, start, times, parts):  # noqa: ANN001, ANN201
    """States (samples, n) by classical Runge-Kutta steps."""
    h = (times[1] - times[0]) / parts
    y, found = start.copy(), np.empty((times.size, start.size))
    k1, k2, k3, k4 = np.zeros_like(y), np.zeros_like(y), np.zeros_like(y), np.zeros_like(y)
    for k in range(times.size):
        found[k] = y
        for part in range(parts):
            t = times[k] + part * h
            rate(t, y, k1)
            rate(t + 0.5 * h, y + 0.5 * h * k1, k2)
            rate(t + 0.5 * h, y + 0.5 * h * k2, k3)
            rate(t + h, y + h * k3, k4)
            y += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
    return found


def forces(equations: Equations, times: Array, states: Array) -> Array:
    """The measured forces (samples, n)."""
    return np.array(
        [equations.force(t, np.ascontiguousarray(y)) for t, y in zip(times.tolist(), states.T, strict=True)]
    )


def _loosest(
    who: str,
    what: str,
    settings: tuple,
    integrator: Integrator,
    equations: Equations,
    truth: Array,
    times: Array,
    goal: float,
) -> Entry:
    integrator(equations, times[:5], settings[0])()
    for setting in settings:
        work = integrator(equations, times, setting)
        began = time.thread_time()
        states = work()
        spent = time.thread_time() - began
        whole = states.shape[1] == times.size
        error = float(np.sqrt(np.mean((forces(equations, times, states) - truth) ** 2))) if whole else np.inf
        if error <= goal:
            break
    return Entry(who, f"{what} {setting:g}", 1e9 * spent / times.size, error)


@cache
def answering(rate: Callable[..., None]) -> Callable[[float, Array], Array]:
    """The rates as an answer."""

    @njit(error_model="numpy")
    def answer(t, y):  # noqa: ANN001, ANN202
        dy = np.empty_like(y)
        rate(t, y, dy)
        return dy

    return answer


def _small(equations: Equations, rtol: float) -> Array:
    return rtol * equations.size
