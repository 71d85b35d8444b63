"""Measured and simulated signals of a dataset as a report shows them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.average import average_bands
from dashpot.data.order_tracking import DynamicStiffness, Oscillation, follow, harmonics_of
from dashpot.data.phase import NotOscillatingError
from dashpot.data.run import Run

Array = NDArray[np.float64]

BANDS = ((0.0, 5.0), (5.0, 10.0), (10.0, 15.0), (15.0, 20.0), (20.0, 30.0))
HARMONICS = 5
POINTS = 40


def signal_evidence(runs: tuple[Run, ...], residuals: Mapping[str, Mapping[str, Array]]) -> dict[str, Any]:
    """Loops, residuals, dynamic stiffness, harmonics and misfit map of labelled residuals (measured - simulated)."""
    tracked = {run.name: track for run in runs if (track := _track(run)) is not None}
    return {
        "loops": {
            "measured": {
                run.name: {"time": run.time, "displacement": run.displacement, "force": run.force} for run in runs
            },
            "simulated": {
                label: {run.name: run.force - found[run.name] for run in runs} for label, found in residuals.items()
            },
        },
        "residuals": {"time": {run.name: run.time for run in runs}, "residuals": residuals},
        "dynamic_stiffness": [_curve(run, tracked[run.name], residuals) for run in runs if run.name in tracked],
        "harmonics": {label: _harmonics(found, tracked) for label, found in residuals.items()} if tracked else {},
        "misfit_map": _misfit_map(runs, tracked, residuals),
    }


def _track(run: Run) -> Oscillation | None:
    if run.kind not in ("sweep", "harmonic"):
        return None
    try:
        return follow(run.displacement, run.sample_time)
    except NotOscillatingError:
        return None


def _curve(run: Run, track: Oscillation, residuals: Mapping[str, Mapping[str, Array]]) -> dict[str, Any]:
    measured = _averaged(harmonics_of(run.force, track))
    curve: dict[str, Any] = {
        "run": run.name,
        "amplitude": float(np.median(measured.amplitude)),
        "preload": float(np.median(measured.preload)),
        "frequency": measured.frequency,
        "measured": _response(measured),
        "simulated": {},
    }
    for label, found in residuals.items():
        simulated = _averaged(harmonics_of(run.force - found[run.name], track))
        curve["simulated"][label] = _response(simulated)
    return curve


def _averaged(stiffness: DynamicStiffness) -> DynamicStiffness:
    low, high = float(stiffness.frequency.min()), float(stiffness.frequency.max())
    return average_bands(stiffness, np.linspace(low * (1.0 - 1e-9), high * (1.0 + 1e-9) + 1e-9, POINTS + 1))


def _response(stiffness: Any) -> dict[str, Array]:
    return {
        "stiffness": np.hypot(stiffness.storage, stiffness.loss),
        "loss_angle": np.arctan2(stiffness.loss, stiffness.storage),
    }


def _harmonics(residuals: Mapping[str, Array], tracked: Mapping[str, Oscillation]) -> dict[str, list[float]]:
    groups: dict[str, list[Array]] = {}
    for name, track in tracked.items():
        orders = harmonics_of(residuals[name], track)
        size = np.sqrt(np.mean(orders.sine**2 + orders.cosine**2, axis=0))[:HARMONICS]
        groups.setdefault(f"{1e3 * float(np.median(orders.amplitude)):.2g} mm", []).append(size)
    return {group: np.mean(sizes, axis=0).tolist() for group, sizes in groups.items()}


def _misfit_map(
    runs: tuple[Run, ...], tracked: Mapping[str, Oscillation], residuals: Mapping[str, Mapping[str, Array]]
) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    for run in runs:
        if run.name not in tracked:
            rows.append({"run": run.name, "band": "all", "rmse": _rms(residuals, run.name, slice(None))})
            continue
        turning = np.gradient(np.nan_to_num(tracked[run.name].angle)) / (2.0 * np.pi * run.sample_time)
        for low, high in BANDS:
            inside = (turning >= low) & (turning < high)
            if inside.sum() * run.sample_time > 0.2:
                rows.append({"run": run.name, "band": (low, high), "rmse": _rms(residuals, run.name, inside)})
    return rows


def _rms(residuals: Mapping[str, Mapping[str, Array]], run: str, where: Any) -> dict[str, float]:
    return {label: float(np.sqrt(np.mean(found[run][where] ** 2))) for label, found in residuals.items()}
