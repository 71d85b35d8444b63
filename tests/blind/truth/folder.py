"""A dataset as files: one npz per run, and the dataset.yaml that explains them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from .design import Plan
from .motion import SAMPLING

_HEAD = """\
format: dashpot-dataset/1
name: {name}
{sensors}defaults:
  channels:
    time: {{column: t, unit: s}}
    displacement: {{column: x, unit: mm}}
    force: {{column: F, unit: N}}
{further}runs:
"""
_TEMPERATURE = "    temperature: {column: T, unit: K}\n"


def write_dataset(
    folder: Path,
    name: str,
    measured: dict[Plan, tuple[np.ndarray, np.ndarray]],
    sheet: str | None = None,
    temperatures: Mapping[Plan, np.ndarray] | None = None,
) -> Path:
    """Write displacement [m] and force [N] of every run, and the data sheet of the force channel if it has one.

    ``temperatures`` [K], one for each sample of every run, are a channel beside them.

    Returns the path of dataset.yaml.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for plan, (displacement, force) in measured.items():
        time = np.arange(force.size) / SAMPLING
        beside = {"T": temperatures[plan]} if temperatures else {}
        np.savez(folder / f"{plan.name}.npz", t=time, x=displacement * 1e3, F=force, **beside)
    target = folder / "dataset.yaml"
    sensors = f"sensors: {{force: {{{sheet}}}}}\n" if sheet else ""
    head = _HEAD.format(name=name, sensors=sensors, further=_TEMPERATURE if temperatures else "")
    target.write_text(head + "".join(_entry(plan) for plan in measured), encoding="utf-8")
    return target


def _entry(plan: Plan) -> str:
    head = f"  - {{name: {plan.name}, file: {plan.name}.npz, kind: {plan.kind}"
    listed = ", ".join(f"{key}: {value}" for key, value in plan.settings.items())
    settings = f", settings: {{{listed}}}" if listed else ""
    again = f", repeats: {plan.repeats}" if plan.repeats else ""
    return f"{head}{settings}{again}}}\n"
