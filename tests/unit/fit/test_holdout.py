"""Held-out runs test the model, not its extrapolation; repeats never stand on both sides."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.holdout import split_runs

TIME = 1e-3 * np.arange(3000)


def harmonic(name: str, amplitude: float, frequency: float, repeats: str | None = None, **settings: float) -> Run:
    displacement = amplitude * np.sin(2.0 * np.pi * frequency * TIME)
    return Run(
        name=name,
        kind="harmonic",
        time=TIME,
        channels={"displacement": displacement, "force": 1e5 * displacement},
        settings={"amplitude": amplitude, "frequency": frequency, **settings},
        repeats=repeats,
        group=repeats or name,
        held_out=None,
        sensors={},
        source="",
        order=0,
    )


LADDER = [harmonic("1mm", 1e-3, 2.0), harmonic("5mm", 5e-3, 2.0), harmonic("20mm", 20e-3, 2.0)]


@pytest.mark.parametrize("seed", range(8))
def test_the_largest_amplitude_is_never_held_out_although_every_run_has_settings_of_its_own(seed):
    assert "20mm" not in split_runs(Dataset("ladder", tuple(LADDER)), seed).held_out


@pytest.mark.parametrize("seed", range(8))
def test_a_repeated_amplitude_goes_before_one_of_its_own(seed):
    runs = (*LADDER, harmonic("20mm, second day", 20e-3, 2.0, warm_up=0.7))
    (held_out,) = split_runs(Dataset("ladder", runs), seed).held_out
    assert held_out in ("20mm", "20mm, second day")


@pytest.mark.parametrize("seed", range(8))
def test_one_of_the_liveliest_runs_is_held_out_where_another_covers_it(seed):
    slow = [harmonic(f"slow {number}", 5e-3, 1.0, preload=number * 1e-3) for number in range(8)]
    fast = [harmonic(f"fast {number}", 5e-3, 10.0, preload=number * 1e-3) for number in range(3)]
    held_out = split_runs(Dataset("sweeps", (*slow, *fast)), seed).held_out
    assert len(held_out) == 3
    assert sum(name.startswith("fast") for name in held_out) >= 1


@pytest.mark.parametrize("seed", range(8))
def test_repeats_are_held_out_together(seed):
    runs = [run for each in LADDER for run in (each, harmonic(f"{each.name} again", 1e-3, 2.0, repeats=each.name))]
    split = split_runs(Dataset("ladder", tuple(runs)), seed)
    assert {name.removesuffix(" again") for name in split.held_out}.isdisjoint(
        name.removesuffix(" again") for name in split.train
    )


@pytest.mark.parametrize("seed", range(8))
def test_the_only_repeats_are_not_held_out(seed):
    """They tell the noise floor."""
    runs = [*LADDER, harmonic(f"{LADDER[1].name} again", 1e-3, 2.0, repeats=LADDER[1].name)]
    held_out = split_runs(Dataset("ladder", tuple(runs)), seed).held_out
    assert held_out and LADDER[1].name not in held_out


def test_where_each_run_goes_beyond_the_others_one_is_held_out_nevertheless():
    runs = (harmonic("far", 20e-3, 0.2), harmonic("fast", 1e-3, 40.0), harmonic("aside", 5e-3, 1.0, preload=0.1))
    aside = runs[2]
    aside.channels["displacement"] += 0.1
    split = split_runs(Dataset("corners", runs))
    assert len(split.held_out) == 1 and len(split.train) == 2


def test_two_independent_runs_are_too_few_and_it_says_so():
    split = split_runs(Dataset("ladder", tuple(LADDER[:2])))
    assert split.held_out == () and "too few" in split.reason
