"""The arrays and texts that a report shows as evidence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import dashpot
from dashpot.assess.pursuit import residuals_of
from dashpot.data.average import average_bands
from dashpot.data.order_tracking import DynamicStiffness, Oscillation, follow, harmonics_of
from dashpot.data.phase import NotOscillatingError
from dashpot.data.run import Run

if TYPE_CHECKING:
    from dashpot.assess.diagnose import Diagnosis

Array = NDArray[np.float64]

BANDS = ((0.0, 5.0), (5.0, 10.0), (10.0, 15.0), (15.0, 20.0), (20.0, 30.0))
HARMONICS = 5
POINTS = 40


def gather_evidence(diagnosis: Diagnosis) -> dict[str, Any]:
    """The evidence of a diagnosis: see ``report.evidence.Evidence``."""
    pursuit, setting = diagnosis.pursuit, diagnosis.setting
    residuals = {"before": residuals_of(pursuit.ladder[0], setting.scored)}
    if pursuit.accepted:
        residuals["after"] = residuals_of(pursuit.ladder[-1], setting.scored)
    runs = setting.dataset.runs
    return {
        **signal_evidence(runs, residuals),
        "patch": _patch(diagnosis),
        "rejected": [_rejected(diagnosis, rejection) for rejection in pursuit.rejected],
        "tried": pursuit.tried,
        "limits": detection_limits(diagnosis),
        "next_measurement": _next_measurements(diagnosis),
        "warnings": _warnings(diagnosis),
        "history": {diagnosis.model.name: _history(diagnosis.fit.history)},
        "provenance": {
            "dashpot": dashpot.__version__,
            "seed": diagnosis.seed,
            "data": setting.dataset.digest,
            "held out": ", ".join(setting.split.held_out) or setting.split.reason,
        },
    }


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


def detection_limits(diagnosis: Diagnosis) -> list[dict[str, Any]]:
    """The smallest strength of each single suspect that the last screen would have found with 95 % power."""
    found = []
    screen = diagnosis.pursuit.last.screen
    for limit in screen.limits:
        found.append(
            {
                "cause": limit.cause.word,
                "title": limit.cause.about,
                "quantity": f"as {limit.form}, force RMS",
                "value": limit.force,
                "unit": "N",
            }
        )
    return found


def _track(run: Run) -> Oscillation | None:
    if run.kind not in ("sweep", "harmonic"):
        return None
    try:
        return follow(run.displacement, run.sample_time)
    except NotOscillatingError:
        return None


def _curve(run: Run, track: Oscillation, residuals: Mapping[str, Mapping[str, Array]]) -> dict[str, Any]:
    measured = _averaged(harmonics_of(run.force, track))
    curve = {
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
    rows = []
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


def _patch(diagnosis: Diagnosis) -> dict[str, str]:
    if diagnosis.extended_text is None:
        return {}
    return {
        "before": diagnosis.model.document.text,
        "after": diagnosis.extended_text,
        "before_name": f"{diagnosis.model.name}.yaml",
        "after_name": diagnosis.extended_name,
    }


def _rejected(diagnosis: Diagnosis, rejection: Any) -> dict[str, Any]:
    title = f"{diagnosis.causes[rejection.cause].about} ({rejection.form})"
    return {
        "cause": rejection.cause,
        "title": title,
        "reason": rejection.reason,
        "expected_gain": rejection.expected_gain,
        "gain": rejection.gain,
    }


def _next_measurements(diagnosis: Diagnosis) -> list[str]:
    return [
        f"{diagnosis.causes[entry['cause']].about} or {diagnosis.causes[rival].about}: {entry['next_measurement']}"
        for entry in diagnosis.as_dict()["causes"]
        if entry["next_measurement"]
        for rival in entry["indistinguishable_from"][:1]
    ]


def _warnings(diagnosis: Diagnosis) -> list[str]:
    found = [str(problem) for problem in diagnosis.setting.dataset.problems]
    if diagnosis.setting.split.reason:
        found.append(f"No gain on unseen runs: {diagnosis.setting.split.reason}.")
    if diagnosis.setting.floor.source != "repeats":
        found.append("No repeated runs: the noise floor is estimated from the record itself.")
    found += [f"The cause '{word}' could not be tried: {reason}" for word, reason in diagnosis.pursuit.last.unavailable]
    found += [f"{path} is at the end of its search range." for path in diagnosis.fit.at_bound]
    return found


def _history(history: tuple[tuple[int, float], ...]) -> dict[str, list[float]]:
    return {"evaluations": [float(count) for count, _ in history], "best": [loss for _, loss in history]}
