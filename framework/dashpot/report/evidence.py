"""What a report shows besides its result file: arrays and texts, all optional; what is missing is left out.

All numbers are SI. *Labels* are "before" and "after" in a diagnosis, names of models in a comparison.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypedDict

import numpy as np

Signals = Mapping[str, np.ndarray]
ByRun = Mapping[str, np.ndarray]


class Loops(TypedDict):
    """Force over displacement: `measured[run]` has `time` s, `displacement` m, `force` N, each (n,)."""

    measured: Mapping[str, Signals]
    simulated: Mapping[str, ByRun]  # label -> run -> force (n,) N


class Residuals(TypedDict):
    """Measured minus simulated force: `time[run]` (n,) s, `residuals[label][run]` (n,) N."""

    time: ByRun
    residuals: Mapping[str, ByRun]


class Curve(TypedDict, total=False):
    """Dynamic stiffness of one run: `frequency` (n,) Hz; a response has `stiffness` N/m, `loss_angle` rad and `force`,
    the amplitude of its first order in N, each (n,)."""

    run: str
    amplitude: float | None  # m
    preload: float | None  # m
    frequency: np.ndarray
    measured: Signals
    simulated: Mapping[str, Signals]  # label -> response


class Contact(TypedDict):
    """Amplitude of the contact force of one wheel in one run: `frequency` (n,) Hz, `measured` (n,) N."""

    run: str
    wheel: str
    added_mass: float  # kg
    frequency: np.ndarray
    measured: np.ndarray
    simulated: ByRun  # label -> (n,) N


class MisfitRow(TypedDict):
    """RMS residual of one run in one frequency band: `band` (low, high) Hz or a text, `rmse[label]` N."""

    run: str
    band: tuple[float, float] | str
    rmse: Mapping[str, float]


class Progress(TypedDict):
    """How a fit went: `evaluations` (n,) and the `best` RMSE so far (n,) N."""

    evaluations: Sequence[float]
    best: Sequence[float]


class Patch(TypedDict, total=False):
    """The YAML of the model before and after, and the names of the files."""

    before: str
    after: str
    before_name: str
    after_name: str


class Rejected(TypedDict, total=False):
    """A candidate that did not hold: `cause` (word), `title` (words), `reason`, gains as shares of one."""

    cause: str
    title: str
    reason: str
    expected_gain: float | None
    gain: float | None


class Limit(TypedDict, total=False):
    """The detection limit at 95 % power: of which `quantity`, `value` in the SI `unit`.

    The numbers are None where even the largest one would not have been seen; `quantity` says so.
    """

    cause: str
    title: str
    quantity: str
    value: float | None
    unit: str | None
    force: float | None  # RMS, N
    left: float | None  # what a refit leaves of it, RMS, N


class IdentifiedCurve(TypedDict):
    """A table of a network in SI: knots `at` (k,) of the quantity `over`, `value` (k,) of the one that is `told`, and
    its 95 % intervals from `low` to `high` (k,), NaN where unknown."""

    over: str
    over_unit: str
    told: str
    unit: str
    at: np.ndarray
    value: np.ndarray
    low: np.ndarray
    high: np.ndarray


class Draws(TypedDict):
    """Draws from a posterior in SI: `step` and `walker` (k,) of each, `numbers[path]` (k,), `units[path]`, and the
    `fitted[path]` number."""

    step: np.ndarray
    walker: np.ndarray
    numbers: ByRun
    units: Mapping[str, str]
    fitted: Mapping[str, float]


class Evidence(TypedDict, total=False):
    """The evidence of a diagnosis or comparison."""

    loops: Loops
    branches: Mapping[str, ByRun]  # branch of the final model -> run -> force (n,) N
    curves: Mapping[str, IdentifiedCurve]  # path in the final model -> curve
    residuals: Residuals
    dynamic_stiffness: Sequence[Curve]
    shapes: Mapping[str, Any]  # curves without a model; see `compare.shapes.shapes_of`
    spectra: Sequence[Mapping[str, Any]]  # curves {run, label, of, x, y} in SI
    repeats: Sequence[Mapping[str, Any]]  # see `compare.look.Look.repeats`
    harmonics: Mapping[str, Mapping[str, Sequence[float]]]  # label -> group -> harmonics 1, 2, ... (N)
    misfit_map: Sequence[MisfitRow]
    contact_response: Sequence[Contact]
    slow_curves: Mapping[str, Mapping[str, Signals]]  # "measured" or model -> part; see `figures.slow_curves`
    history: Mapping[str, Progress]  # fit -> progress
    draws: Draws  # from the posterior of a fit
    patch: Patch
    schematic: Mapping[str, str]  # title -> drawing in SVG
    rejected: Sequence[Rejected]
    tried: int  # how many candidates were looked at
    limits: Sequence[Limit]
    next_measurement: Sequence[str]  # sentences
    warnings: Sequence[str]  # what the reader must know before believing the rest
    provenance: Mapping[str, Any]  # versions, seed, digests, command: the colophon
