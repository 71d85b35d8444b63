"""Triage on specimens by their own equations: sound sets are good, one run at fault is found."""

from dataclasses import replace

import numpy as np
import pytest

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.triage.examine import examine

SAMPLES, CYCLES = 1500, 6


def test_run(name, frequency, amplitude, law, seed, **more):
    """Sines at a frequency in Hz and an amplitude in m, with 0.1 % of noise in the motion and 2 N in the force."""
    rng, step = np.random.default_rng(seed), CYCLES / frequency / SAMPLES
    time = step * np.arange(SAMPLES)
    angle = 2.0 * np.pi * frequency * time
    x, v = amplitude * np.sin(angle), 2.0 * np.pi * frequency * amplitude * np.cos(angle)
    force = law(x, v, frequency) + 2.0 * rng.standard_normal(SAMPLES)
    channels = {"displacement": x + 1e-3 * amplitude * rng.standard_normal(SAMPLES), "force": force}
    return Run(name, "harmonic", time, channels, group=name, **more)


test_run.__test__ = False


def air_spring(x, v, frequency):
    """A column of gas of 200 mm at 5 bar over 100 cm^2, nearly isothermal where it is slow; 5 kN at rest."""
    exponent = 1.05 if frequency < 0.1 else 1.33
    return 1e-2 * (6e5 * (0.2 / (0.2 - x)) ** exponent - 1e5) + 150.0 * v


def hydromount(x, v, frequency):
    """A rubber spring beside a chamber, whose fluid resonates in a track at 10 Hz."""
    omega, chamber, mass = 2.0 * np.pi * frequency, 2e5, 2e5 / (2.0 * np.pi * 10.0) ** 2
    through = chamber - mass * omega**2 + 0.4j * omega * mass * 2.0 * np.pi * 10.0
    seen = chamber * (1.0 - chamber / through)
    return 2.2e5 * x + 2e9 * x**3 + 100.0 * v + seen.real * x + seen.imag / omega * v


def buffer(x, v, frequency):
    """A foam that blocks with the fifth power of its deflection, with a little damping."""
    return 2e4 * x * (1.0 + np.abs(x / 0.02) ** 5) + 60.0 * v


def loaded_rubber(x, v, frequency):
    """Rubber that stiffens with frequency, under a weight of 3 kN that was not tared."""
    return 3e3 + 2e5 * frequency**0.12 * x + 2e4 / (2.0 * np.pi * frequency) * v


# how fast and how far each is tested, the slow run first, which goes farther than all others
TESTS = {
    air_spring: [(0.02, 45e-3), (1.0, 32e-3), (1.0, 32e-3), (3.0, 16e-3), (6.0, 7e-3)],
    hydromount: [(0.05, 5e-3), *((f, a) for a in (1e-4, 1e-3) for f in (2.0, 8.0, 12.0, 20.0, 35.0))],
    buffer: [(0.05, 30e-3), (1.0, 6e-3), (1.0, 6e-3), (4.0, 3e-3), (9.0, 1e-3)],
    loaded_rubber: [(0.05, 3e-3), (1.0, 5e-4), (1.0, 5e-4), (5.0, 2e-4), (15.0, 1e-4), (30.0, 5e-5)],
}


def specimen(law):
    return [test_run(f"r{k}", f, a, law, k) for k, (f, a) in enumerate(TESTS[law])]


def changed(runs, number, **factors):
    """The runs, channels of one of them multiplied."""
    run = runs[number]
    channels = {**run.channels, **{key: factor * run.channels[key] for key, factor in factors.items()}}
    return [replace(run, channels=channels) if k == number else other for k, other in enumerate(runs)]


def told(runs):
    return [(fault.run, fault.kind) for fault in examine(Dataset("made", tuple(runs))).faults]


@pytest.mark.parametrize("law", TESTS)
def test_a_slow_run_that_goes_farther_than_the_others_is_sound(law):
    assert told(specimen(law)) == []


@pytest.mark.parametrize("number", [0, 2, 4])
@pytest.mark.parametrize("law", TESTS)
def test_a_force_a_thousand_times_too_large_is_found(law, number):
    assert told(changed(specimen(law), number, force=1e3)) == [(f"r{number}", "unit")]


@pytest.mark.parametrize("number", [1, 3])
@pytest.mark.parametrize("law", [air_spring, buffer])
def test_swapped_channels_of_one_run_are_found(law, number):
    """Newtons in the column of millimetres, and millimetres in that of kilonewtons."""
    runs = specimen(law)
    x, force = runs[number].displacement, runs[number].force
    runs[number] = replace(runs[number], channels={"displacement": 1e-3 * force, "force": 1e3 * x})
    assert told(runs) == [(f"r{number}", "swapped_channels")]


def test_a_wrong_sign_is_found_where_every_run_has_a_setting_of_its_own():
    """No pressure makes a stiffness negative; the runs of one pressure are too few to tell."""
    runs = [
        test_run(f"r{k}", 2.0 + k, 2e-3, lambda x, v, f, k=k: 1e5 * (1.0 + 0.02 * k) * x + 100.0 * v, k)
        for k in range(6)
    ]
    runs = [replace(run, settings={"pressure": 2e5 + 1e4 * k}) for k, run in enumerate(runs)]
    assert told(runs) == []
    assert told(changed(runs, 3, force=-1.0)) == [("r3", "polarity")]


def kelvin_voigt(x, v, frequency):
    return 1e5 * x + 800.0 * v


def one_way(name):
    """A slow run without a closed cycle: 4 mm in and back half the way."""
    time = 1e-2 * np.arange(1500)
    x = 4e-3 * np.interp(time, [0.0, 10.0, 15.0], [0.0, 1.0, 0.5])
    return Run(name, "quasi_static", time, {"displacement": x, "force": 1e5 * x}, group=name)


def test_where_all_signs_are_wrong_runs_without_closed_cycles_are_turned_as_well():
    runs = [test_run(f"r{k}", f, 2e-3, kelvin_voigt, k) for k, f in enumerate([1.0, 2.0, 5.0, 8.0])]
    runs = [*runs, one_way("slow")]
    assert told(runs) == []
    turned = [replace(run, channels={**run.channels, "force": -run.force}) for run in runs]
    found = examine(Dataset("made", tuple(turned)))
    assert {(fault.run, fault.kind, fault.factor) for fault in found.faults} == {
        (run.name, "polarity", -1.0) for run in runs
    }
    assert len(found.problems) == 1
    for run, whole in zip(found.dataset.runs, runs, strict=True):
        assert np.array_equal(run.force, whole.force)


def test_where_no_run_is_certain_to_give_back_work_the_sign_is_asked_for():
    """Rubber with a loss angle of one degree: a delay of a sample could make it give back work."""
    runs = [test_run(f"r{k}", f, 1e-3, lambda x, v, f: 1e5 * x + 3e2 / f * v, k) for k, f in enumerate([1.0, 2.0, 4.0])]
    turned = [replace(run, channels={**run.channels, "force": -run.force}) for run in runs]
    found = examine(Dataset("made", tuple(turned)))
    assert not found.faults and "write 'sign: -1'" in found.remarks[0]
    assert not examine(Dataset("made", tuple(runs))).remarks


def test_a_record_that_begins_at_zero_and_goes_to_its_preload_has_closed_cycles():
    """The way to 20 mm is no part of the motion: a dashpot that gives work back is found as without it."""
    runs = []
    for number, frequency in enumerate([2.0, 3.0, 5.0, 7.0]):
        run = test_run(f"r{number}", frequency, 1e-3, kelvin_voigt, number)
        ramp = 20e-3 * np.minimum(run.time / (0.1 * run.time[-1]), 1.0)
        channels = {"displacement": ramp + run.displacement, "force": 1e5 * ramp + run.force}
        runs.append(replace(run, channels=channels))
    assert told(runs) == []
    assert ("r1", "polarity") in told(changed(runs, 1, force=-1.0))


def test_a_run_that_is_accepted_is_used_as_it_is():
    runs = changed(specimen(buffer), 3, force=1e3)
    runs[3] = replace(runs[3], accept=("triage",))
    found = examine(Dataset("made", tuple(runs)))
    assert not found.faults and np.array_equal(found.dataset.runs[3].force, runs[3].force)
