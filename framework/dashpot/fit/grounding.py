"""Taking curves of a network out of the data: from the quasi-static loop, or from the sweeps where there is none."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.data.backbone import Backbone, correct_backbone, extract_backbone
from dashpot.data.start_curve import curve_from_sweeps
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.model.network import Characteristic, NetworkSpec, Value

Array = NDArray[np.float64]

ROUNDING = 1e-9


def ground_curves(spec: NetworkSpec, runs: Sequence[ScoredRun]) -> NetworkSpec:
    """The network with every curve that is to come from data as a table of searched knots.

    The mid line of the widest quasi-static run; without one a smooth curve through all runs. The knots cover the
    deflections of all runs.
    """
    for path, curve in spec.data_curves().items():
        if curve.form == "data":
            at, force = _widen(*_backbone(runs, curve.knots or None), runs)
            spec = spec.with_curve(path, table_of(curve, at, force))
    return spec


def correct_ends(spec: NetworkSpec, runs: Sequence[ScoredRun]) -> NetworkSpec:
    """One step of the end-bias correction with the network's own friction; unchanged without a quasi-static run."""
    slow = widest(runs)
    if slow is None or not spec.data_curves():
        return spec
    simulated = compile_network(spec).along(slow.drive)()
    for path, curve in spec.data_curves().items():
        at, force = np.array(curve.at), np.array([value.number for value in curve.values])
        line = Backbone(at, force, np.zeros(at.size), 0.0, True, 1)
        corrected = correct_backbone(line, slow.drive.displacement, slow.force, simulated).force
        low, high = slow.drive.displacement.min(), slow.drive.displacement.max()
        # a knot at an end of the loop belongs to it, whatever its last digit
        covered = (at >= low - ROUNDING * (high - low)) & (at <= high + ROUNDING * (high - low))
        spec = spec.with_curve(path, table_of(curve, at, np.where(covered, corrected, force)))
    return spec


def widest(runs: Sequence[ScoredRun]) -> ScoredRun | None:
    """The quasi-static run with the longest stroke."""
    slow = [run for run in runs if run.kind == "quasi_static"]
    return max(slow, key=lambda run: np.ptp(run.drive.displacement), default=None)


def table_of(curve: Characteristic, at: Array, force: Array) -> Characteristic:
    """A searched table in the place of a curve from data."""
    span = max(float(np.ptp(force)), 1.0)
    values = tuple(
        Value(float(f), curve.curve.value[1], "identified", (float(f) - span, float(f) + span), "linear") for f in force
    )
    return Characteristic(curve.curve, "table", values, tuple(map(float, at)), curve.data, curve.knots, curve.node)


def _backbone(runs: Sequence[ScoredRun], knots: int | None) -> tuple[Array, Array]:
    slow = widest(runs)
    if slow is None:
        motions = [(run.drive.displacement, run.drive.velocity, run.force) for run in runs]
        curve = curve_from_sweeps(motions, knots) if knots else curve_from_sweeps(motions)
        return curve.deflection, curve.force
    backbone = extract_backbone(slow.drive.displacement, slow.force, knots)
    return backbone.deflection, backbone.force


def _widen(at: Array, force: Array, runs: Sequence[ScoredRun]) -> tuple[Array, Array]:
    # one more knot on the straight continuation where other runs go clearly farther
    low = min(run.drive.displacement.min() for run in runs)
    high = max(run.drive.displacement.max() for run in runs)
    step = float(np.mean(np.diff(at)))
    if low < at[0] - 0.25 * step:
        slope = (force[1] - force[0]) / (at[1] - at[0])
        at, force = np.append(low, at), np.append(force[0] + slope * (low - at[0]), force)
    if high > at[-1] + 0.25 * step:
        slope = (force[-1] - force[-2]) / (at[-1] - at[-2])
        at, force = np.append(at, high), np.append(force, force[-1] + slope * (high - at[-1]))
    return at, force
