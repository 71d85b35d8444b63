"""What a study of an axle tells beside its fits, in plain values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from dashpot.data.axle_curves import AxleCurves, SlowCurve
from dashpot.fit.excited import velocity_curves
from dashpot.fit.study.run import ModelResult
from dashpot.study.axle import Axle, axle_of, contact_responses, measured_curves, simulated_curves, wheel_masses

MEASURED = "measured"


def model_content(model: ModelResult) -> dict[str, Any]:
    """For one model: its tables over velocity with what was excited, its masses found without the tire."""
    return {
        "velocity_curves": [
            {
                "curve": curve.path,
                "velocity": list(curve.velocity),
                "force": list(curve.force),
                "low": list(curve.low),
                "high": list(curve.high),
                "excited": list(curve.excited),
                "reached": list(curve.reached),
            }
            for curve in velocity_curves(model.fit.fitted, model.setting.train)
        ],
        "masses_without_tire": [
            {"node": mass.node, "value": mass.mass, "interval": list(mass.interval), "rmse": mass.rmse}
            for mass in model.without_tire
        ],
    }


def axle_content(models: Iterable[ModelResult]) -> dict[str, Any] | None:
    """For the axle that the last model describes: the masses of the wheels without any model, and the slow curves in
    numbers, measured and of every model of it. None when it is no axle."""
    axle, family = _axle(models)
    if axle is None:
        return None
    return {
        "wheels": [
            {
                "node": wheel,
                "fixing": fixing,
                "value": mass.mass,
                "interval": list(mass.interval),
                "compliance": mass.compliance,
            }
            for wheel, masses in wheel_masses(axle).items()
            for fixing, mass in masses.items()
        ],
        "slow_curves": [{"of": label, **_numbers(curves)} for label, curves in _slow_curves(axle, family).items()],
    }


def axle_evidence(models: Iterable[ModelResult], stiffness: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Arrays for the report: wheel contact forces from the curves of dynamic ``stiffness``, and slow curves."""
    axle, family = _axle(models)
    if axle is None:
        return {}
    return {
        "contact_response": contact_responses(axle, stiffness),
        "slow_curves": {label: _arrays(curves) for label, curves in _slow_curves(axle, family).items()},
    }


def _axle(models: Iterable[ModelResult]) -> tuple[Axle | None, list[ModelResult]]:
    *_, last = models
    digest = last.setting.dataset.digest
    return axle_of(last.fit.fitted, last.setting.dataset.runs), [
        model for model in models if model.setting.dataset.digest == digest
    ]


def _slow_curves(axle: Axle, family: Iterable[ModelResult]) -> dict[str, AxleCurves]:
    found = {MEASURED: measured_curves(axle)}
    found |= {model.fit.declared.name: simulated_curves(axle, model.fit.fitted) for model in family}
    return {label: curves for label, curves in found.items() if curves}


def _numbers(curves: AxleCurves) -> dict[str, Any]:
    return {
        "rate": [side.rate for side in curves.suspension],
        "half_width": [side.friction for side in curves.suspension],
        "speed": curves.suspension[0].speed,
        "bar_rate": curves.bar_rate,
        "roll_half_width": curves.roll.friction if curves.roll else None,
        "roll_speed": curves.roll.speed if curves.roll else None,
    }


def _arrays(curves: AxleCurves) -> dict[str, Any]:
    left, right = curves.suspension
    found = {"left": _curve(left), "right": _curve(right)}
    return found | ({"roll": _curve(curves.roll)} if curves.roll else {})


def _curve(curve: SlowCurve) -> dict[str, Any]:
    return {"deflection": curve.deflection, "force": curve.force, "half_width": curve.half_width}
