"""Runs that give work back are named with what they most likely are; passive specimens of all kinds never are."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.triage.energy import giving_back, works_of
from dashpot.triage.examine import examine, examined
from dashpot.triage.fault import Fault
from dashpot.triage.telling import told_once
from dashpot.triage.work import REVERSIBILITY, work_of_cycles

STEP = 1e-3
TIME = np.arange(6000) * STEP


def sine(amplitude, frequency, preload=0.0):
    return preload + amplitude * np.sin(2.0 * np.pi * frequency * TIME)


def run(name, x, force, noise=0.0, seed=0, **more):
    rng = np.random.default_rng(seed)
    force = force + noise * rng.standard_normal(x.size)
    return Run(name, "harmonic", TIME, {"displacement": x, "force": force}, group=name, **more)


def late(signal, delay):
    """The signal a while later, by linear interpolation of a finely sampled smooth course."""
    return np.interp(TIME - delay, TIME, signal)


def mount(name, amplitude, frequency, delay=0.0, seed=0):
    """A progressive spring with a dashpot and friction, behind 2 N of noise."""
    x = sine(amplitude, frequency, 5e-3)
    v = np.gradient(x, STEP)
    force = 1e5 * x + 4e6 * x**2 + 200.0 * v + 20.0 * np.tanh(v / 2e-3)
    return run(name, x, late(force, delay), 2.0, seed)


def mounts():
    return [
        mount(f"r{k}", a, f, seed=k) for k, (a, f) in enumerate([(1e-3, 2), (2e-3, 2), (1e-3, 5), (2e-3, 5), (3e-3, 3)])
    ]


def told(runs):
    return {fault.run: fault for fault in examine(Dataset("made", tuple(runs))).faults}


def test_the_work_of_a_cycle_is_that_of_the_ellipse():
    """A dashpot takes pi c w A^2 in each cycle, whatever spring lies beside it."""
    amplitude, frequency, damping = 2e-3, 4.0, 300.0
    x = sine(amplitude, frequency)
    work = work_of_cycles(run("a", x, 1e5 * x + damping * np.gradient(x, STEP) + 700.0))
    expected = np.pi * damping * 2.0 * np.pi * frequency * amplitude**2
    assert work.halves == pytest.approx(np.full(work.halves.size, 0.5 * expected), rel=5e-3)
    assert work.mean == pytest.approx(expected, rel=2e-3)


def test_each_second_of_delay_takes_away_what_is_told():
    """A spring seen late by d gives back pi k A^2 sin(w d): its work per second of delay is -pi k A^2 w."""
    amplitude, frequency, stiffness = 2e-3, 4.0, 1e5
    x = sine(amplitude, frequency)
    work = work_of_cycles(run("a", x, stiffness * x))
    assert work.per_delay == pytest.approx(np.pi * stiffness * amplitude**2 * 2.0 * np.pi * frequency, rel=2e-3)
    assert work.moved == pytest.approx(2.0 * stiffness * amplitude**2, rel=2e-3)
    assert work.explicable(0.0) == pytest.approx(REVERSIBILITY * work.moved)


@pytest.mark.parametrize(
    "law",
    [
        lambda x, v: 1e5 * x,
        lambda x, v: 1e5 * x + 3e8 * x**3,
        lambda x, v: 1e5 * x + 20.0 * np.gradient(v, STEP),
        lambda x, v: np.where(x > 0.0, 1e5 * x, 0.0),
        lambda x, v: 1e5 * np.maximum(np.abs(x) - 5e-4, 0.0) * np.sign(x),
    ],
    ids=["spring", "progressive", "mass", "lift_off", "clearance"],
)
@pytest.mark.parametrize("delay", [0.0, 0.9e-3])
@pytest.mark.parametrize("noise", [0.0, 20.0])
def test_an_elastic_specimen_is_not_accused(law, delay, noise):
    runs = []
    for number, (a, f) in enumerate([(1e-3, 1), (2e-3, 3), (1e-3, 7), (3e-3, 2)]):
        x = sine(a, f)
        runs.append(run(f"r{number}", x, late(law(x, np.gradient(x, STEP)), delay), noise, number))
    assert told(runs) == {}


def test_random_motion_of_an_elastic_specimen_is_not_accused():
    rng = np.random.default_rng(5)
    runs = []
    for number in range(6):
        x = np.convolve(rng.standard_normal(TIME.size), np.hanning(60), "same") * 1e-4
        runs.append(run(f"r{number}", x, 1e5 * x + 1e9 * x**3, 5.0, number))
    assert told(runs) == {}


def test_sound_mounts_are_not_accused():
    assert told(mounts()) == {}


def test_a_turned_force_is_named_and_turned_back():
    runs = mounts()
    runs[1] = replace(runs[1], channels={**runs[1].channels, "force": -runs[1].force})
    found = examine(Dataset("made", tuple(runs)))
    assert [(fault.run, fault.kind, fault.channel, fault.factor) for fault in found.faults] == [
        ("r1", "polarity", "force", -1.0)
    ]
    assert np.array_equal(found.dataset.run("r1").force, mounts()[1].force)


@pytest.mark.parametrize("number", range(5))
def test_any_of_the_runs_may_be_turned(number):
    """With friction the others predict the smallest run a little worse than each other; it is turned back as well."""
    runs = []
    for k, (a, f) in enumerate([(1e-3, 2), (2e-3, 2), (1e-3, 5), (2e-3, 5), (3e-3, 3)]):
        x = sine(a, f, 5e-3)
        v = np.gradient(x, STEP)
        runs.append(run(f"r{k}", x, 1e5 * x + 200.0 * v + 60.0 * np.tanh(v / 2e-4), 2.0, k))
    turned = replace(runs[number], channels={**runs[number].channels, "force": -runs[number].force})
    found = examine(Dataset("made", tuple(turned if k == number else each for k, each in enumerate(runs))))
    assert [(fault.run, fault.kind, fault.factor) for fault in found.faults] == [(f"r{number}", "polarity", -1.0)]
    assert np.array_equal(found.dataset.runs[number].force, runs[number].force)


def test_a_turned_displacement_is_told_from_a_turned_force():
    """The middle of the stroke and the progressive spring tell the one from the other."""
    runs = mounts()
    runs[3] = replace(runs[3], channels={**runs[3].channels, "displacement": -runs[3].displacement})
    fault = told(runs)["r3"]
    assert (fault.kind, fault.channel) == ("polarity", "displacement")


@pytest.mark.parametrize("unit", [1.0, 1e-3])
def test_swapped_channels_are_named_and_left_out(unit):
    """Both columns taken for each other; in mm and N the numbers of the force become mm."""
    runs = mounts()
    x, force = runs[2].displacement, runs[2].force
    runs[2] = replace(runs[2], channels={"displacement": unit * force, "force": x / unit})
    fault = told(runs)["r2"]
    assert (fault.kind, fault.factor) == ("swapped_channels", None)
    assert "r2" not in [each.name for each in examine(Dataset("made", tuple(runs))).dataset.runs]


def test_a_delay_that_makes_a_run_give_back_work_is_named_with_its_length():
    runs = mounts()
    runs[3] = mount("r3", 2e-3, 5, delay=12e-3, seed=3)
    fault = told(runs)["r3"]
    assert fault.kind == "delay"
    found = float(fault.cure.split("delay: ")[1].split(" ms")[0])
    assert found == pytest.approx(12.0, rel=0.12)


def stiffening(name, amplitude, frequency, preload, delay, seed):
    """Four times as stiff at 20 mm as at 5 mm, with the same dashpot, and its force late."""
    x = sine(amplitude, frequency, preload)
    return run(name, x, late(1e5 * x + 1e7 * x**2 + 1000.0 * np.gradient(x, STEP), delay), 2.0, seed)


CONDITIONS = [(a, f, p) for p in (5e-3, 12e-3, 20e-3) for a, f in ((1e-3, 2.0), (2e-3, 5.0), (3e-3, 3.0))]


@pytest.mark.parametrize(
    ("delay", "stiffest"), [(12e-3, [f"r{k}" for k in range(9)]), (4e-3, ["r6", "r7", "r8"]), (1.2e-3, [])]
)
def test_a_force_that_is_late_in_all_runs_is_no_fault_of_those_at_the_stiffest_preload(delay, stiffest):
    """It takes away more of the work where the specimen is stiff; the runs are left to the network, also where all
    give work back."""
    runs = [stiffening(f"r{k}", *each, delay, k) for k, each in enumerate(CONDITIONS)]
    found = examine(Dataset("made", tuple(runs)))
    assert found.faults == () and len(found.dataset.runs) == len(runs)
    remarks = [remark for remark in found.remarks if "late in all of them" in remark]
    assert [each.name for each in runs if f"'{each.name}'" in "".join(remarks)] == stiffest


def kneed(name, amplitude, preload, seed):
    """Three times as stiff beyond 8 mm, a dashpot, a mass that moves, and a load cell behind a low-pass of 60 Hz."""
    phase = 2.0 * np.pi * (TIME + 2.0 * TIME**2)
    x = preload + amplitude * np.sin(phase) * np.minimum(TIME / 0.5, 1.0)
    v = np.gradient(x, STEP)
    force = 1.8e5 * x + 3.6e5 * np.maximum(x - 8e-3, 0.0) + 400.0 * v + 3.0 * np.gradient(v, STEP)
    half = 0.5 * STEP * 2.0 * np.pi * 60.0
    shown = lfilter([half / (1.0 + half)] * 2, [1.0, (half - 1.0) / (half + 1.0)], force - force[0]) + force[0]
    return run(name, x, shown, 5.0, seed)


def test_a_slow_load_cell_is_no_fault_of_the_runs_at_stiffer_preloads():
    """The sound runs have never been where these are: a polynomial through their forces tells nothing there."""
    conditions = [(a, p) for a in (0.3e-3, 1e-3) for p in (4e-3, 8e-3, 12e-3)]
    found = examine(Dataset("made", tuple(kneed(f"r{k}", *each, k) for k, each in enumerate(conditions))))
    assert found.faults == ()
    assert "'r1', 'r2', 'r4', 'r5' give back work" in "".join(found.remarks)


def test_a_turned_displacement_is_told_by_where_the_others_have_been():
    """Of a linear spring about a preload either sign may be turned; but the others have been on one side only."""

    def linear(number, amplitude, frequency):
        x = sine(amplitude, frequency, 5e-3)
        return run(f"r{number}", x, 1e5 * x + 300.0 * np.gradient(x, STEP), 2.0, number)

    runs = [linear(k, a, f) for k, (a, f) in enumerate([(1e-3, 2), (2e-3, 2), (1e-3, 5), (2e-3, 5), (3e-3, 3)])]
    runs[3] = replace(runs[3], channels={**runs[3].channels, "displacement": -runs[3].displacement})
    fault = told(runs)["r3"]
    assert (fault.kind, fault.channel) == ("polarity", "displacement")


def test_runs_that_are_late_by_themselves_are_still_named():
    """Two of five: with all forces earlier they would be as far from the others as before."""
    runs = mounts()
    runs[2], runs[3] = mount("r2", 1e-3, 5, 12e-3, seed=2), mount("r3", 2e-3, 5, 12e-3, seed=3)
    assert {name: fault.kind for name, fault in told(runs).items()} == {"r2": "delay", "r3": "delay"}


@pytest.mark.parametrize("gain", [-1.1, -1.3, -4.448, -1000.0])
def test_a_turned_force_in_another_unit_is_turned_back(gain):
    """Of its size scale tells, and the diagnosis."""
    runs = mounts()
    runs[1] = replace(runs[1], channels={**runs[1].channels, "force": gain * runs[1].force})
    found = examine(Dataset("made", tuple(runs)))
    assert [(fault.run, fault.kind) for fault in found.faults][0] == ("r1", "polarity")
    assert len(found.dataset.runs) == len(runs)


@pytest.mark.parametrize("delay", [47e-3, 49e-3, 50e-3, 52e-3])
def test_runs_that_are_late_by_about_a_quarter_of_a_cycle_are_told(delay):
    runs = mounts()
    runs[2], runs[3] = mount("r2", 1e-3, 5, delay, seed=2), mount("r3", 2e-3, 5, delay, seed=3)
    assert set(told(runs)) == {"r2", "r3"}


def test_a_late_force_is_not_taken_for_swapped_channels():
    """A small loop about a large preload is nearly elastic, so that force and deflection look alike: not their size."""
    runs = [stiffening(f"r{k}", *each, 0.0, k) for k, each in enumerate(CONDITIONS)]
    runs[7] = stiffening("r7", *CONDITIONS[7], 12e-3, 7)
    fault = told(runs)["r7"]
    assert fault.kind == "delay"
    assert float(fault.cure.split("delay: ")[1].split(" ms")[0]) == pytest.approx(12.0, rel=0.12)


def test_what_nothing_mends_is_left_out():
    """A record of another specimen whose drive pulls it along agrees with nobody."""
    runs = mounts()
    x = runs[0].displacement
    runs[0] = run("r0", x, -400.0 * np.gradient(x, STEP) * np.abs(x - 5e-3) / 1e-3 + np.sin(40.0 * TIME))
    assert told(runs)["r0"].kind == "energy"


def test_turned_forces_of_most_runs_are_all_turned_back():
    """Energy is no vote: four of five runs may be wrong."""
    runs = [replace(each, channels={**each.channels, "force": -each.force}) for each in mounts()[:4]] + mounts()[4:]
    found = examine(Dataset("made", tuple(runs)))
    assert {fault.run for fault in found.faults} == {"r0", "r1", "r2", "r3"}
    assert all(np.array_equal(one.force, other.force) for one, other in zip(found.dataset.runs, mounts(), strict=True))


def turned(each):
    return replace(each, channels={**each.channels, "force": -each.force})


def test_a_sign_that_is_wrong_in_all_runs_is_told_once():
    """In two of them the loss is within what a sample of delay explains: they need no evidence of their own."""
    hardly = []
    for k, amplitude in enumerate((1e-3, 2e-3)):
        x = sine(amplitude, 5.0, 5e-3)
        hardly.append(run(f"r{k + 5}", x, 1e5 * x + 4e6 * x**2 + 80.0 * np.gradient(x, STEP), 2.0, k))
    assert not {"r5", "r6"} & giving_back([*map(turned, hardly)], works_of([*map(turned, hardly)]))
    runs = [turned(each) for each in [*mounts(), *hardly]]
    found = examined(Dataset("made", tuple(runs)))
    (problem,) = found.problems
    assert str(problem).startswith("all 7 runs: work is given back over closed cycles, ")
    assert "the force of all runs has the wrong sign; the force was multiplied by -1 here" in problem.message
    assert problem.hint == "Write 'sign: -1' under the force channel of all runs"
    assert all(np.array_equal(one.force, -other.force) for one, other in zip(found.runs, runs, strict=True))
    (sentence,) = examine(Dataset("made", tuple(runs))).sentences
    assert sentence == f"All 7 runs: {problem.message.partition(': ')[2]}. {problem.hint}."


def test_one_run_that_gives_back_work_tells_the_sign_of_all_that_pull_as_it_does():
    """Small motions behind noise are certain of nothing, but all of them pull along with their deflection."""
    runs = []
    for k, (a, f) in enumerate([(0.2e-3, 1), (0.2e-3, 2), (0.3e-3, 1), (3e-3, 8)]):
        x = sine(a, f, 5e-3)
        runs.append(run(f"r{k}", x, -(1e5 * x + 250.0 * np.gradient(x, STEP)), 3.0, k))
    found = examine(Dataset("made", tuple(runs)))
    assert {fault.run: (fault.kind, fault.factor) for fault in found.faults} == {
        f"r{k}": ("polarity", -1.0) for k in range(4)
    }


def test_what_many_runs_have_alike_is_told_of_the_first():
    faults = [Fault(f"r{k}", "unit", f"its force is {k + 2} times too large", "Correct the 'unit'") for k in range(3)]
    other = Fault("r9", "delay", "its force is late", "Write its 'delay'")
    (alike, alone) = told_once([*faults, other], 12)
    assert alike.sentence == (
        "Runs 'r0', 'r1', 'r2': they are at fault alike; of run 'r0': its force is 2 times too large; left out here. "
        "Correct the 'unit'."
    )
    assert alone.sentence == "Run 'r9': its force is late; left out here. Write its 'delay'."
    assert [each.runs for each in told_once(faults[:2], 12)] == ["run 'r0'", "run 'r1'"]


def test_a_dataset_never_loses_its_last_run():
    """Its only force comes late: that is said, and the run stays."""
    found = examine(Dataset("made", (mount("r0", 1e-3, 5.0, 12e-3),)))
    assert [fault.kind for fault in found.faults] == ["delay"]
    assert len(found.dataset.runs) == 1
    assert "No run is without a fault" in found.remarks[-1]


def test_a_single_cycle_of_a_single_run_is_too_little_to_accuse():
    x = sine(1e-3, 2.0)[:1000]
    short = Run("a", "transient", TIME[:1000], {"displacement": x, "force": -300.0 * np.gradient(x, STEP)}, group="a")
    assert told([short]) == {}


def test_what_was_done_is_told_among_the_problems():
    runs = mounts()
    runs[1] = replace(runs[1], channels={**runs[1].channels, "force": -runs[1].force})
    (problem,) = examined(Dataset("made", tuple(runs))).problems
    assert "run 'r1'" in problem.message and "gives back" in problem.message and "multiplied by -1" in problem.message


def short_mounts(cycles, stiffness=5e4, turned=()):
    """A spring, a dashpot and friction, a few recorded cycles a run, each from the middle of its stroke upwards."""
    runs = []
    for number, (amplitude, frequency) in enumerate([(1e-3, 1.0), (1e-3, 4.0), (3e-3, 1.0), (3e-3, 4.0)]):
        time = np.arange(int(cycles / frequency / STEP)) * STEP
        x = amplitude * np.sin(2.0 * np.pi * frequency * time)
        v = np.gradient(x, STEP)
        force = stiffness * x + 300.0 * v + 25.0 * np.tanh(v / 1e-3)
        force = (-1.0 if number in turned else 1.0) * force + 0.5 * np.random.default_rng(number).standard_normal(
            x.size
        )
        channels = {"displacement": x, "force": force}
        runs.append(Run(f"r{number}", "harmonic", time, channels, group=f"r{number}"))
    return runs


@pytest.mark.parametrize("cycles", [2.5, 3.0, 4.0, 6.6])
@pytest.mark.parametrize("stiffness", [5e4, 0.0])
def test_the_wrong_sign_of_all_runs_is_told_once_even_of_few_cycles(cycles, stiffness):
    found = examine(Dataset("made", tuple(short_mounts(cycles, stiffness, turned=range(4)))))
    (problem,) = found.problems
    assert problem.message.startswith("all 4 runs: work is given back over closed cycles, ")
    assert "the force of all runs has the wrong sign" in problem.message
    sound = short_mounts(cycles, stiffness)
    assert all(float(run.force @ other.force) > 0.0 for run, other in zip(found.dataset.runs, sound, strict=True))


@pytest.mark.parametrize("cycles", [2.5, 3.0, 4.0])
def test_sound_runs_of_few_cycles_are_not_accused(cycles):
    assert told(short_mounts(cycles)) == {}


def test_one_turned_run_of_few_cycles_among_sound_ones_is_turned_back():
    faults = told(short_mounts(3.0, turned=[3]))
    assert {name: (fault.kind, fault.factor) for name, fault in faults.items()} == {"r3": ("polarity", -1.0)}


def test_forces_of_most_runs_are_told_once_and_name_these_alone():
    (problem,) = examine(Dataset("made", tuple(short_mounts(4.0, turned=[0, 1, 3])))).problems
    assert problem.message.startswith("runs 'r0', 'r1', 'r3': 3 of 4 runs")
    assert "these runs" in problem.hint
