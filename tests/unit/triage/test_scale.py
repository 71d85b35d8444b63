"""Units among runs whose stiffness depends on amplitude: the spread of the others is the tolerance."""

from dataclasses import replace

import numpy as np
import pytest

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.triage.conditions import change_by_conditions
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


@pytest.mark.parametrize("limit", [2000.0, 2500.0, 3000.0])
def test_clipped_runs_of_a_stiffening_specimen_are_in_no_other_unit(limit):
    """Cut off at a force beyond which the others never were, a run may be four times too weak, in another course."""
    runs = []
    for k, (middle, stroke) in enumerate([(5.0, 1.0), (5.0, 3.0), (8.0, 1.0), (8.0, 3.0), (11.0, 1.0), (11.0, 3.0)]):
        way = stroke * np.sin(2.0 * np.pi * 3.0 * TIME)
        x, v = 1e-3 * (middle + way), 1e-3 * np.gradient(way, TIME)
        force = np.minimum(2e5 * x + 300.0 * v + 1.9e10 * (x - 8e-3) ** 3, limit)
        force = force + 5.0 * np.random.default_rng(k).standard_normal(x.size)
        runs.append(Run(f"p{middle:g}_a{stroke:g}", "harmonic", TIME, {"displacement": x, "force": force}))
    assert told(runs) == []


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


def kneed(number, preload, amplitude, ratio, knee):
    """So many times stiffer beyond a knee."""
    x = preload + amplitude * np.sin(2.0 * np.pi * 2.0 * TIME)
    force = 2e5 * x + (ratio - 1.0) * 2e5 * np.maximum(x - knee, 0.0) + 500.0 * np.gradient(x, STEP)
    name = f"r{number}"
    force = force + np.random.default_rng(number).standard_normal(x.size)
    return Run(name, "harmonic", TIME, {"displacement": x, "force": force}, group=name)


@pytest.mark.parametrize(
    ("ratio", "knee", "far"),
    [(3.0, 9e-3, 18e-3), (3.0, 9e-3, 23e-3), (4.0, 9e-3, 20e-3), (4.0, 10e-3, 18e-3), (5.0, 10e-3, 15e-3)],
)
def test_preloads_on_both_sides_of_a_knee_are_good(ratio, knee, far):
    """No law is known where no other run has been: neither a factor below 1000 nor a polynomial tells anything."""
    conditions = [(p, a) for p in (4e-3, 9e-3, far) for a in (0.9e-3, 1.8e-3)]
    assert told([kneed(k, *each, ratio, knee) for k, each in enumerate(conditions)]) == []


@pytest.mark.parametrize("resonance", [9.0, 11.0])
@pytest.mark.parametrize("damping", [800.0, 2500.0])
def test_a_mass_that_outweighs_its_spring_is_no_wrong_sign(resonance, damping):
    """Above its resonance a force pushes against the deflection; turned round it would give back work."""
    runs = []
    for number, (a, f) in enumerate((a, f) for a in (0.5e-3, 1e-3) for f in (4.0, 15.0, 25.0)):
        omega = 2.0 * np.pi * f
        x, v = a * np.sin(omega * TIME), a * omega * np.cos(omega * TIME)
        force = 2e5 * (1.0 - (f / resonance) ** 2) * x + damping * v + np.random.default_rng(number).normal(size=x.size)
        runs.append(Run(f"r{number}", "harmonic", TIME, {"displacement": x, "force": force}, group=f"r{number}"))
    assert told(runs) == []


@pytest.mark.parametrize("factor", [1e3, 4.4482216])
def test_an_accuracy_of_one_percent_is_allowed(factor):
    assert told(scaled(rubber(0.0), 2, "force", 1.008 * factor)) == [("a0.5", "unit", "force")]


LAWS = {
    "damper": lambda x, v: 900.0 * v + 40.0 * np.tanh(v / 5e-3) + 2e3 * x,
    "digressive": lambda x, v: 900.0 * np.sign(v) * np.abs(v) ** 0.6,
    "friction": lambda x, v: 300.0 * np.tanh(v / 3e-3) + 2e3 * x,
    "spring": lambda x, v: 2e5 * x + 50.0 * v,
    "progressive": lambda x, v: 2e5 * x + 4e9 * x**3 + 100.0 * v,
}


def grid(law, settings=None, amplitudes=(5e-3, 10e-3), frequencies=(1.0, 2.0, 4.0)):
    """All amplitudes at all frequencies, with 1 N of noise."""
    runs = []
    for number, (a, f) in enumerate((a, f) for a in amplitudes for f in frequencies):
        time = np.arange(int(5.5 / f / STEP)) * STEP
        x = a * np.sin(2.0 * np.pi * f * time)
        force = LAWS[law](x, np.gradient(x, STEP)) + np.random.default_rng(number).standard_normal(x.size)
        name = f"r{number}"
        chosen = {} if settings is None else {"current": settings[number]}
        runs.append(Run(name, "harmonic", time, {"displacement": x, "force": force}, group=name, settings=chosen))
    return runs


@pytest.mark.parametrize("law", LAWS)
def test_a_grid_of_sound_runs_is_good(law):
    assert told(grid(law)) == []


@pytest.mark.parametrize("amplitudes", [(1e-3, 3e-3), (1e-3, 3e-3, 10e-3)])
def test_plain_friction_over_many_conditions_is_good(amplitudes):
    """The fastest run is predicted wrongly, even with another sign, and any divisor of its motion would do."""
    assert told(grid("friction", amplitudes=amplitudes, frequencies=(0.5, 2.0, 5.0))) == []


@pytest.mark.parametrize("number", range(6))
@pytest.mark.parametrize("law", ["damper", "spring"])
def test_a_thousandfold_displacement_of_a_grid_is_found(law, number):
    """Where it is not certain that the force is no thousandth, the run is still at fault."""
    ((name, kind, _),) = told(scaled(grid(law), number, "displacement", 1e3))
    assert name == f"r{number}" and kind.startswith("unit")


@pytest.mark.parametrize("factor", [1e3, 1e-3])
@pytest.mark.parametrize("number", range(6))
@pytest.mark.parametrize("law", LAWS)
def test_a_thousandfold_force_is_found_wherever_it_lies_among_the_conditions(law, number, factor):
    """At a corner the forecast is wrong by more than the others are apart, and the factor is plain all the same."""
    found = examine(Dataset("made", tuple(scaled(grid(law), number, "force", factor))))
    assert [(fault.run, fault.kind) for fault in found.faults] == [(f"r{number}", "unit")]
    assert found.faults[0].factor == pytest.approx(1.0 / factor)


def test_a_thousandfold_force_at_a_corner_is_found_among_other_settings():
    runs = scaled(grid("damper", range(6)), 5, "force", 1e3)
    assert told(runs) == [("r5", "unit", "force")]


@pytest.mark.parametrize("factor", [2100.0, 1e5])
def test_what_is_too_far_for_any_condition_and_no_clear_factor_is_left_out(factor):
    found = examine(Dataset("made", tuple(scaled(grid("damper"), 5, "force", factor))))
    assert [(fault.run, fault.kind, fault.factor) for fault in found.faults] == [("r5", "unit", None)]
    assert len(found.dataset.runs) == 5


def test_a_factor_like_no_mistake_is_said_to_be_none():
    (fault,) = examine(Dataset("made", tuple(scaled(grid("spring"), 4, "force", 1e5)))).faults
    assert "like no well-known mistake" in fault.evidence


def test_the_change_by_conditions_is_that_of_the_law_that_changes_less():
    """A dashpot has one damping at all conditions, and the stiffness of its force changes fourfold."""
    damper = [replace(run, channels={**run.channels, "force": 900.0 * rate(run)}) for run in grid("damper")]
    assert change_by_conditions(damper) == pytest.approx(0.0, abs=1e-9)
    assert change_by_conditions(grid("spring")) == pytest.approx(0.0, abs=1e-3)
    friction = [replace(run, channels={**run.channels, "force": np.sign(rate(run))}) for run in grid("damper")]
    assert change_by_conditions(friction) == pytest.approx(np.log(2.0), abs=0.02)


def rate(run):
    return np.gradient(run.displacement, STEP)
