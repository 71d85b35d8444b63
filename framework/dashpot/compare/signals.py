"""Measured and simulated signals of a dataset as a report shows them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.compare.bands import Band, frequency_bands
from dashpot.compare.conditions import Conditions, conditions_of
from dashpot.data.average import average_bands
from dashpot.data.excitation import Excitation
from dashpot.data.order_tracking import DynamicStiffness, Oscillation, harmonics_of
from dashpot.data.run import Run
from dashpot.data.tracking import track as followed
from dashpot.fit.scored import warm_up
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
Residuals = Mapping[str, Mapping[str, Array]]

HARMONICS = 5
POINTS = 40
OUTER, REACHED = 0.2, 0.95  # of the windows at an end, and of the median of their amplitudes
SHORTEST = 0.2  # s that a run has to spend in a band
WHOLE_RUN = "whole run"


def measured_signals(run: Run) -> dict[str, Array]:
    """Time (n,) in s, displacement in m, velocity in m/s and force in N of a run with one deflection."""
    velocity = Excitation.of_run(run).motions[""].velocity
    return {"time": run.time, "displacement": run.displacement, "velocity": velocity, "force": run.force}


def signal_evidence(runs: tuple[Run, ...], residuals: Residuals) -> dict[str, Any]:
    """Loops, residuals, dynamic stiffness, harmonics and misfit map of labelled residuals (measured - simulated)."""
    tracked = {run.name: track for run in runs if (track := followed(run)) is not None}
    conditions = {run.name: conditions_of(run, tracked[run.name]) for run in runs if run.name in tracked}
    return {
        "loops": {
            "measured": {run.name: measured_signals(run) for run in runs},
            "simulated": {
                label: {run.name: run.force - found[run.name] for run in runs} for label, found in residuals.items()
            },
        },
        "residuals": {"time": {run.name: run.time for run in runs}, "residuals": residuals},
        "dynamic_stiffness": [
            _curve(run, tracked[run.name], conditions[run.name], residuals) for run in runs if run.name in tracked
        ],
        "harmonics": {label: _harmonics(found, tracked, conditions) for label, found in residuals.items()}
        if tracked
        else {},
        "misfit_map": _misfit_map(runs, _sweeps(tracked, conditions), residuals),
    }


def _sweeps(tracked: Mapping[str, Oscillation], conditions: Mapping[str, Conditions]) -> dict[str, Oscillation]:
    return {name: track for name, track in tracked.items() if conditions[name].frequency is None}


def _curve(run: Run, track: Oscillation, conditions: Conditions, residuals: Residuals) -> dict[str, Any]:
    points = POINTS if conditions.frequency is None else 1
    whole = harmonics_of(run.force, track, confident=False)
    steady = _unfaded(whole.amplitude) if conditions.frequency is None else np.ones(len(whole), dtype=bool)
    measured = _averaged(whole.select(steady), points)
    return {
        "run": run.name,
        "amplitude": conditions.amplitude,
        "preload": conditions.preload,
        "frequency": measured.frequency,
        "measured": _response(measured),
        "simulated": {
            label: _response(
                _averaged(harmonics_of(run.force - found[run.name], track, confident=False).select(steady), points)
            )
            for label, found in residuals.items()
        },
    }


def _unfaded(amplitude: Array) -> NDArray[np.bool_]:
    """All windows (m,) but those at both ends in which a sweep grows to its amplitude (m,), or fades out."""
    kept = np.ones(amplitude.size, dtype=bool)
    outer = max(1, int(OUTER * amplitude.size))
    for along in (slice(None), slice(None, None, -1)):
        reached = amplitude[along] >= REACHED * np.median(amplitude[along][:outer])
        kept[along][: int(np.argmax(reached))] = False
    return kept


def _averaged(stiffness: DynamicStiffness, points: int) -> DynamicStiffness:
    low, high = float(stiffness.frequency.min()), float(stiffness.frequency.max())
    return average_bands(stiffness, np.linspace(low * (1.0 - 1e-9), high * (1.0 + 1e-9) + 1e-9, points + 1))


def _response(stiffness: DynamicStiffness) -> dict[str, Array]:
    return {
        "stiffness": stiffness.magnitude,
        "loss_angle": stiffness.loss_angle,
        "force": stiffness.magnitude * stiffness.amplitude,
    }


def _harmonics(
    residuals: Mapping[str, Array], tracked: Mapping[str, Oscillation], conditions: Mapping[str, Conditions]
) -> dict[str, list[float]]:
    groups: dict[float, list[Array]] = {}
    for name, track in tracked.items():
        orders = harmonics_of(residuals[name], track, confident=False)
        size = np.sqrt(np.mean(orders.sine**2 + orders.cosine**2, axis=0))[:HARMONICS]
        groups.setdefault(conditions[name].amplitude, []).append(size)
    return {pretty(group, "m"): np.mean(groups[group], axis=0).tolist() for group in sorted(groups)}


def _misfit_map(runs: tuple[Run, ...], sweeps: Mapping[str, Oscillation], residuals: Residuals) -> list[dict[str, Any]]:
    bands = _common_bands(list(sweeps.values()))
    rows: list[dict[str, Any]] = []
    for run in runs:
        if run.name in sweeps:
            rows += _rows_of_sweep(run, sweeps[run.name], bands, residuals)
        else:
            rows.append(
                {"run": run.name, "band": WHOLE_RUN, "rmse": _rms(residuals, run.name, slice(warm_up(run), None))}
            )
    return rows


def _common_bands(sweeps: Sequence[Oscillation]) -> list[Band]:
    if not sweeps:
        return []
    return frequency_bands(
        min(float(track.frequency.min()) for track in sweeps), max(float(track.frequency.max()) for track in sweeps)
    )


def _rows_of_sweep(run: Run, track: Oscillation, bands: Sequence[Band], residuals: Residuals) -> list[dict[str, Any]]:
    known = np.isfinite(track.angle) & (np.arange(track.angle.size) >= warm_up(run))
    turning = np.gradient(np.nan_to_num(track.angle)) / (2.0 * np.pi * run.sample_time)
    edges = np.array([low for low, _ in bands[1:]])
    place = np.where(known, np.searchsorted(edges, turning, side="right"), -1)
    return [
        {"run": run.name, "band": band, "rmse": _rms(residuals, run.name, place == number)}
        for number, band in enumerate(bands)
        if np.count_nonzero(place == number) * run.sample_time > SHORTEST
    ]


def _rms(residuals: Residuals, run: str, where: Any) -> dict[str, float]:
    return {label: float(np.sqrt(np.mean(found[run][where] ** 2))) for label, found in residuals.items()}
