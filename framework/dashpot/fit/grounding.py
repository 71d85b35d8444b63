"""Taking curves of a network out of the data: from the quasi-static loop, or from the sweeps where there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.data.backbone import Backbone, correct_backbone, extract_backbone
from dashpot.data.start_curve import curve_from_stiffness, curve_from_sweeps
from dashpot.data.steady import STEADY, harmonic_of
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.model.network import Characteristic, NetworkSpec, Value

Array = NDArray[np.float64]

ROUNDING = 1e-9
ROW_KNOTS = 8  # of a curve that tables alone tell, at most
NORMAL = 1.959964  # standard errors on either side of a 95 % interval


@dataclass(frozen=True, eq=False)
class TakenCurve:
    """Force (m,) N over deflection (m,) m, with its standard error, N; infinite where only a fit can tell the force."""

    at: Array
    force: Array
    error: Array


def ground_curves(spec: NetworkSpec, runs: Sequence[ScoredRun]) -> NetworkSpec:
    """The network with every curve that is to come from data as a table; one that has knots keeps them where they hold.

    The mid line of the widest quasi-static run, which is kept, known as well as its scatter says; knots beyond that run
    are searched. Without such a run a smooth curve through all runs, of which all knots are searched. The knots cover
    the deflections of all runs.
    """
    for path, curve in spec.data_curves().items():
        if curve.form == "data" or not _holds(spec, curve, runs):
            spec = spec.with_curve(path, table_of(curve, _widen(_taken(runs, curve.knots or None), runs)))
    return spec


def _holds(spec: NetworkSpec, curve: Characteristic, runs: Sequence[ScoredRun]) -> bool:
    """Whether the knots of a table are used: beside a slow loop where they reach as far as the runs, to a quarter of
    their distance, without one where an earlier fit has identified them.

    A table that ends before, from another test, cannot follow the slow loop, and knots of the literature are those of
    another specimen: the curve is taken anew.
    """
    if widest(runs) is None:
        return bool(spec.identified.record)
    slack = 0.25 * (curve.at[-1] - curve.at[0]) / (len(curve.at) - 1)
    low = min(run.drive.displacement.min() for run in runs)
    high = max(run.drive.displacement.max() for run in runs)
    return bool(curve.at[0] - slack <= low and high <= curve.at[-1] + slack)


def correct_ends(spec: NetworkSpec, runs: Sequence[ScoredRun]) -> NetworkSpec:
    """One step of the end-bias correction with the network's own friction; unchanged without a quasi-static run.

    The simulated loop then has the mid line of the measured one, also where other branches lean on it.
    """
    slow = widest(runs)
    if slow is None or not spec.data_curves():
        return spec
    simulated = compile_network(spec).along(slow.drive)()
    for path, curve in spec.data_curves().items():
        at, force = np.array(curve.at), np.array([value.number for value in curve.values])
        line = Backbone(at, force, np.zeros(at.size), 0.0, True, 1, np.full(at.size, np.inf))
        corrected = correct_backbone(line, slow.drive.displacement, slow.force, simulated).force
        spec = spec.with_curve(path, moved_curve(curve, np.where(_covered(at, slow), corrected, force)))
    return spec


def free_curves(spec: NetworkSpec) -> NetworkSpec:
    """The network in which all knots of curves from data are searched, as with ``refine: true``."""
    for path, curve in spec.data_curves().items():
        force = np.array([value.number for value in curve.values])
        free = TakenCurve(np.array(curve.at), force, np.full(force.size, np.inf))
        spec = spec.with_curve(path, table_of(replace(curve, refine=True), free))
    return spec


def widest(runs: Sequence[ScoredRun]) -> ScoredRun | None:
    """The quasi-static run with the longest stroke."""
    slow = [run for run in runs if run.kind == "quasi_static"]
    return max(slow, key=lambda run: np.ptp(run.drive.displacement), default=None)


def table_of(curve: Characteristic, taken: TakenCurve) -> Characteristic:
    """A table in the place of a curve from data: searched where it is to be refined or nothing is known of a knot."""
    unit, span = curve.curve.value[1], max(float(np.ptp(taken.force)), 1.0)
    refine = curve.refine or not np.isfinite(taken.error).any()
    free = refine | ~np.isfinite(taken.error)
    knots = zip(taken.force.tolist(), taken.error.tolist(), free, strict=True)
    values = tuple(_searched(force, unit, span) if each else _known(force, unit, error) for force, error, each in knots)
    return replace(curve, form="table", values=values, at=tuple(taken.at.tolist()), refine=refine)


def _searched(force: float, unit: str, span: float) -> Value:
    return Value(force, unit, "identified", (force - span, force + span), "linear")


def _known(force: float, unit: str, error: float) -> Value:
    interval = force - NORMAL * error, force + NORMAL * error
    return Value(force, unit, scale="linear", interval=interval, known=True)


def moved_curve(curve: Characteristic, force: Array) -> Characteristic:
    """A table with other forces (knots,) N, each with the range and the interval that it had about the old one."""
    values = tuple(_shifted(value, float(new) - value.number) for value, new in zip(curve.values, force, strict=True))
    return replace(curve, values=values)


def _shifted(value: Value, by: float) -> Value:
    bounds, interval = ((pair[0] + by, pair[1] + by) if pair else None for pair in (value.bounds, value.interval))
    return replace(value, number=value.number + by, bounds=bounds, interval=interval)


def _covered(at: Array, slow: ScoredRun) -> NDArray[np.bool_]:
    low, high = slow.drive.displacement.min(), slow.drive.displacement.max()
    # a knot at an end of the loop belongs to it, whatever its last digit
    return np.asarray((at >= low - ROUNDING * (high - low)) & (at <= high + ROUNDING * (high - low)))


def _taken(runs: Sequence[ScoredRun], knots: int | None) -> TakenCurve:
    slow, records = widest(runs), [run for run in runs if run.kind != STEADY]
    if not records:
        return _taken_from_rows(runs, knots)
    if slow is None:
        motions = [(run.drive.displacement, run.drive.velocity, run.force) for run in records]
        curve = curve_from_sweeps(motions, knots) if knots else curve_from_sweeps(motions)
        return TakenCurve(curve.deflection, curve.force, np.full(curve.force.size, np.inf))
    line = extract_backbone(slow.drive.displacement, slow.force, knots)
    return TakenCurve(line.deflection, line.force, line.error)


def _taken_from_rows(runs: Sequence[ScoredRun], knots: int | None) -> TakenCurve:
    """From tables alone: they tell the slope at each preload, and so no more knots than one more than preloads."""
    settings = [run.excitation.settings for run in runs]
    preloads, amplitudes = (np.array([each[key] for each in settings]) for key in ("preload", "amplitude"))
    storage = np.array([harmonic_of(run.force).real for run in runs]) / amplitudes
    knots = knots or min(np.unique(preloads).size + 1, ROW_KNOTS)
    at = np.linspace(np.min(preloads - amplitudes), np.max(preloads + amplitudes), knots)
    return TakenCurve(at, curve_from_stiffness(preloads, storage, at), np.full(knots, np.inf))


def _widen(taken: TakenCurve, runs: Sequence[ScoredRun]) -> TakenCurve:
    # one more knot on the straight continuation where other runs go clearly farther
    at, force, error = taken.at, taken.force, taken.error
    low = min(run.drive.displacement.min() for run in runs)
    high = max(run.drive.displacement.max() for run in runs)
    step = float(np.mean(np.diff(at)))
    if low < at[0] - 0.25 * step:
        slope = (force[1] - force[0]) / (at[1] - at[0])
        at, force = np.append(low, at), np.append(force[0] + slope * (low - at[0]), force)
        error = np.append(np.inf, error)
    if high > at[-1] + 0.25 * step:
        slope = (force[-1] - force[-2]) / (at[-1] - at[-2])
        at, force = np.append(at, high), np.append(force, force[-1] + slope * (high - at[-1]))
        error = np.append(error, np.inf)
    return TakenCurve(at, force, error)
