"""Units among runs whose stiffness depends on amplitude: the spread of the others is the tolerance."""

from dataclasses import replace

import numpy as np
import pytest

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.triage.examine import examine

STEP = 2e-3
TIME = np.arange(4000) * STEP
AMPLITUDES = (0.1e-3, 0.2e-3, 0.5e-3, 1e-3, 2e-3, 5e-3)


def soft(amplitude, exponent=0.35, seed=0, **more):
    """A rubber part whose dynamic stiffness falls with amplitude (a power law), with a loss angle of 8 degrees."""
    phase = 2.0 * np.pi * 3.0 * TIME
    stiffness = 2e5 * (amplitude / 1e-3) ** -exponent
    x = amplitude * np.sin(phase)
    force = stiffness * amplitude * np.sin(phase + 0.14)
    noise = 0.005 * np.std(force) * np.random.default_rng(seed).standard_normal(x.size)
    name = f"a{1e3 * amplitude:g}"
    return Run(name, "harmonic", TIME, {"displacement": x, "force": force + noise}, group=name, **more)


def rubber(exponent=0.35, **more):
    return [soft(a, exponent, k, **more) for k, a in enumerate(AMPLITUDES)]


def scaled(runs, number, channel, factor):
    changed = replace(
        runs[number], channels={**runs[number].channels, channel: factor * runs[number].channels[channel]}
    )
    return [changed if k == number else each for k, each in enumerate(runs)]


def told(runs):
    return [(fault.run, fault.kind, fault.channel) for fault in examine(Dataset("made", tuple(runs))).faults]


@pytest.mark.parametrize("exponent", [0.0, 0.2, 0.35, 0.6])
def test_sound_runs_are_never_rescaled(exponent):
    assert told(rubber(exponent)) == []


@pytest.mark.parametrize("number", range(1, len(AMPLITUDES)))
@pytest.mark.parametrize("factor", [1e3, 1e-3])
def test_a_thousandfold_force_is_found_where_stiffness_depends_on_amplitude(number, factor):
    runs = scaled(rubber(), number, "force", factor)
    found = examine(Dataset("made", tuple(runs)))
    assert [(fault.run, fault.kind) for fault in found.faults] == [(runs[number].name, "unit")]
    assert found.faults[0].factor == pytest.approx(1.0 / factor)
    assert np.allclose(found.dataset.runs[number].force, rubber()[number].force)


def test_where_the_spread_allows_two_factors_the_run_is_left_out():
    """At the smallest amplitude it is 2460 times what the others predict: 1000 as well as 4448."""
    runs = scaled(rubber(), 0, "force", 1e3)
    found = examine(Dataset("made", tuple(runs)))
    (fault,) = found.faults
    assert (fault.run, fault.kind, fault.factor) == ("a0.1", "unit", None)
    assert "kN written as N" in fault.evidence and "kip" in fault.evidence
    assert len(found.dataset.runs) == len(AMPLITUDES) - 1


@pytest.mark.parametrize("number", range(len(AMPLITUDES)))
@pytest.mark.parametrize("factor", [1e3, 1e-3])
def test_a_thousandfold_displacement_is_found(number, factor):
    runs = scaled(rubber(0.1), number, "displacement", factor)
    found = examine(Dataset("made", tuple(runs)))
    assert [(fault.run, fault.kind) for fault in found.faults] == [(runs[number].name, "unit_of_displacement")]
    assert found.faults[0].factor == pytest.approx(1.0 / factor)


@pytest.mark.parametrize("factor", [9.80665, 1.0 / 9.80665, 4.4482216, 10.0])
def test_a_small_factor_is_found_where_the_others_agree(factor):
    assert told(scaled(rubber(0.0), 2, "force", factor)) == [("a0.5", "unit", "force")]


@pytest.mark.parametrize("factor", [4.4482216, 1.0 / 4.4482216])
def test_a_small_factor_within_the_spread_is_left_alone(factor):
    """Stiffness that falls tenfold over the amplitudes leaves room for it."""
    assert told(scaled(rubber(0.6), 0, "force", factor)) == []


@pytest.mark.parametrize("factor", [3.0, 0.4, 21.7, 60.0])
def test_a_factor_that_nobody_knows_is_left_to_the_diagnosis(factor):
    assert told(scaled(rubber(0.0), 3, "force", factor)) == []


def test_two_of_six_runs_may_be_wrong_by_the_same():
    runs = scaled(scaled(rubber(0.2), 1, "force", 1e3), 4, "force", 1e3)
    assert sorted(told(runs)) == [("a0.2", "unit", "force"), ("a2", "unit", "force")]


def test_another_setting_is_no_wrong_unit():
    """One run at another current with 4.448 times the force: a factor of the specimen, not of its unit."""
    runs = [replace(each, settings={"current": 0.0}) for each in rubber(0.0)]
    runs[3] = replace(scaled(runs, 3, "force", 4.4482216)[3], settings={"current": 1.0})
    assert told(runs) == []
    plain = scaled(
        [replace(each, settings={"current": float(k)}) for k, each in enumerate(rubber(0.0))], 3, "force", 1e3
    )
    assert told(plain) == [("a1", "unit", "force")]


@pytest.mark.parametrize("factor", [1e3, 4.4482216])
def test_an_accuracy_of_one_percent_is_allowed(factor):
    assert told(scaled(rubber(0.0), 2, "force", 1.008 * factor)) == [("a0.5", "unit", "force")]
