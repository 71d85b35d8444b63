"""General integrators on hand-written equations: what they need to be as exact as dashpot, on one lane."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np
from axle import Equations
from numba import carray, cfunc, njit
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Integrator = Callable[[Equations, Array, float], Array]

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
PARTS = (1, 2, 4, 8, 16, 32)


@dataclass(frozen=True)
class Entry:
    """Nanoseconds of processor time per sample of one lane, at the loosest setting that reached an error (rms, N)."""

    who: str
    setting: str
    nanoseconds: float
    error: float


def peers(equations: Equations, truth: Array, times: Array, goal: float) -> Iterator[Entry]:
    """Every integrator that is there, as loose as it may be to reach ``goal`` in N against ``truth`` (samples, n)."""
    yield _loosest("Runge-Kutta 4, numba", "steps a sample", PARTS, runge_kutta_answer, equations, truth, times, goal)
    for name, integrator in integrators().items():
        yield _loosest(name, "rtol", TOLERANCES, integrator, equations, truth, times, goal)


def integrators() -> dict[str, Integrator]:
    """The adaptive ones that are installed."""
    found = {"solve_ivp LSODA, jitted rates": lsoda, "solve_ivp RK45, jitted rates": rk45}
    if find_spec("numbalsoda"):
        found["numbalsoda LSODA"] = numbalsoda
    if find_spec("sksundae"):
        found["CVODE (scikit-sundae), jitted rates"] = cvode
    return found


def lsoda(equations: Equations, times: Array, rtol: float) -> Array:
    """States (n, samples)."""
    return _solve_ivp(equations, times, rtol, "LSODA")


def rk45(equations: Equations, times: Array, rtol: float) -> Array:
    """States (n, samples)."""
    return _solve_ivp(equations, times, rtol, "RK45")


def _solve_ivp(equations: Equations, times: Array, rtol: float, method: str) -> Array:
    rate = _answering(equations.rate)
    span = (times[0], times[-1])
    return solve_ivp(rate, span, equations.start, method, times, rtol=rtol, atol=_small(equations, rtol)).y


def numbalsoda(equations: Equations, times: Array, rtol: float) -> Array:
    """States (n, samples); one absolute tolerance for all states."""
    from numbalsoda import lsoda as solve
    from numbalsoda import lsoda_sig

    rate, size = equations.rate, equations.start.size

    @cfunc(lsoda_sig)
    def right(t, y, dy, _):  # noqa: ANN001, ANN202
        rate(t, carray(y, (size,)), carray(dy, (size,)))

    states, good = solve(right.address, equations.start, times, rtol=rtol, atol=float(min(_small(equations, rtol))))
    return states.T if good else np.full((size, times.size), np.nan)


def cvode(equations: Equations, times: Array, rtol: float) -> Array:
    """States (n, samples)."""
    from sksundae.cvode import CVODE

    solver = CVODE(equations.rate, method="BDF", rtol=rtol, atol=_small(equations, rtol), max_num_steps=1_000_000)
    return np.asarray(solver.solve(times, equations.start).y).T


def runge_kutta_answer(equations: Equations, times: Array, parts: int) -> Array:
    """States (n, samples), by classical steps, ``parts`` to a sample."""
    return march(equations.rate, equations.start, times, int(parts)).T


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


def _loosest(who: str, what: str, settings: tuple, integrator: Integrator, equations: Equations, truth: Array,
             times: Array, goal: float) -> Entry:  # fmt: skip
    integrator(equations, times[:5], settings[0])
    for setting in settings:
        began = time.thread_time()
        states = integrator(equations, times, setting)
        spent = time.thread_time() - began
        whole = states.shape[1] == times.size
        error = float(np.sqrt(np.mean((forces(equations, times, states) - truth) ** 2))) if whole else np.inf
        if error <= goal:
            break
    return Entry(who, f"{what} {setting:g}", 1e9 * spent / times.size, error)


def _answering(rate: Callable[..., None]) -> Callable[[float, Array], Array]:
    @njit(error_model="numpy")
    def answering(t, y):  # noqa: ANN001, ANN202
        dy = np.empty_like(y)
        rate(t, y, dy)
        return dy

    return answering


def _small(equations: Equations, rtol: float) -> Array:
    return rtol * equations.size
