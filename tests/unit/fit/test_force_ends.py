"""Ends of the range of a force: a search begins where the measured forces end."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.fit.bench import DAMPING, KELVIN_VOIGT, STIFFNESS, network, runs

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network
from dashpot.fit.force_ends import ends_from_records

HIGHEST = max(float(run.force[run.first :].max()) for run in runs())
LOWEST = min(float(run.force[run.first :].min()) for run in runs())


def measured(entry: str) -> str:
    return f"measurement:\n  force:\n    {entry}\n"


def start_of(entry: str, scored=None) -> float:
    """Where an end begins in SI, by the name that the entry begins with."""
    found = ends_from_records(network(KELVIN_VOIGT, measured(entry)), runs() if scored is None else scored)
    return found.measurement[f"force.{entry.partition(':')[0]}"].number


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ("largest: {start: 1 MN}", HIGHEST),
        ("largest: {start: 1 MN, bounds: [1 N, 2 MN]}", HIGHEST),
        ("largest: {start: 1 MN, bounds: [9 kN, 2 MN]}", 9e3),  # no less than the file admits
        ("largest: {start: 100 N}", 100.0),
        ("largest: 1 MN", 1e6),  # known
        ("least: {start: -1 MN}", LOWEST),
        ("least: {start: -1 MN, bounds: [-1 MN, -9 kN]}", -9e3),
        ("least: {start: -100 N}", -100.0),
    ],
)
def test_an_end_beyond_all_forces_begins_where_these_end(entry, expected):
    assert start_of(entry) == pytest.approx(expected)


def test_the_least_force_is_that_of_the_specimen():
    """The channel shows 1.25 times as much, and 30 N on top."""
    entry = "least: {start: -1 MN}\n    gain: 1.25\n    offset: 30 N"
    assert start_of(entry) == pytest.approx((LOWEST - 30.0) / 1.25)


def test_tables_tell_no_forces():
    steady = [replace(run, kind="steady") for run in runs()]
    assert start_of("largest: {start: 1 MN}", steady) == 1e6


@pytest.mark.parametrize(
    ("key", "level", "start"),
    [("largest", 180.0, "800 N"), ("largest", 180.0, "50 kN"), ("least", -120.0, "-400 N"), ("least", -120.0, "-5 kN")],
)
def test_a_fit_finds_an_end_from_a_start_that_no_force_reaches(key, level, start):
    """Sines that go to 430 N, and are cut by the channel or by lift-off; with 1 N of noise the level is told to 1 %."""
    rng, found = np.random.default_rng(4), []
    for number, (amplitude, frequency) in enumerate([(2e-3, 2.0), (1e-3, 11.0), (1.5e-3, 5.0), (1e-3, 3.0)]):
        time = 1e-3 * np.arange(1500)
        x = amplitude * np.sin(2.0 * np.pi * frequency * time)
        v = amplitude * 2.0 * np.pi * frequency * np.cos(2.0 * np.pi * frequency * time)
        force = STIFFNESS * x + DAMPING * v
        cut = np.minimum(force, level) if key == "largest" else np.maximum(force, level)
        channels = {"displacement": x, "force": cut + rng.normal(size=time.size)}
        found.append(Run(f"r{number}", "harmonic", time, channels, {}, None, f"r{number}", order=number))
    spec = network(KELVIN_VOIGT, measured(f"{key}: {{start: {start}}}"))
    result = fit_network(spec, Dataset("cut", tuple(found)), registry=load_registry())
    assert result.fitted.measurement[f"force.{key}"].number == pytest.approx(level, rel=0.01)
    assert result.errors.train == pytest.approx(1.0, rel=0.05)
