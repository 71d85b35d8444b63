"""Triage on a damped progressive spring with noise: each fault is told, sound runs and their effects are not."""

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.dataset import Dataset
from dashpot.data.history import with_history
from dashpot.data.run import Run
from dashpot.data.trouble import Trouble
from dashpot.triage.actuator import actuator_remarks
from dashpot.triage.dropouts import lost_samples
from dashpot.triage.examine import examine

STEP = 1e-3
TIME = np.arange(4000) * STEP
CONDITIONS = [(a, p) for a in (0.5e-3, 1e-3, 2e-3, 5e-3) for p in (10e-3, 20e-3)]


@pytest.fixture
def rng(request):
    seed = seed_of("test_examine")
    print(f"seed {seed}")
    return np.random.default_rng(seed)


def sweep(name, amplitude, preload, rng, effect=lambda x, v: 0.0):
    """A sweep from 1 to 21 Hz with 2 um and 5 N of noise."""
    phase = 2.0 * np.pi * (TIME + 2.5 * TIME**2)
    x = preload + amplitude * np.sin(phase)
    v = np.gradient(x, STEP)
    force = 2e5 * x + 3e6 * x**2 + 300.0 * v + effect(x, v) + 5.0 * rng.standard_normal(x.size)
    return Run(
        name, "sweep", TIME, {"displacement": x + 2e-6 * rng.standard_normal(x.size), "force": force}, group=name
    )


def dataset(rng, effect=lambda x, v: 0.0):
    return Dataset("made", tuple(sweep(f"r{k}", a, p, rng, effect) for k, (a, p) in enumerate(CONDITIONS)))


def with_run(data, number, **channels):
    """The dataset with channels of one run replaced, the time cut to their length."""
    runs = list(data.runs)
    changed = {**runs[number].channels, **channels}
    runs[number] = replace(runs[number], time=TIME[: changed["force"].size], channels=changed)
    return replace(data, runs=tuple(runs))


def kinds(data):
    return [(fault.run, fault.kind) for fault in examine(data).faults]


def test_sound_runs_have_no_fault(rng):
    assert kinds(dataset(rng)) == []


@pytest.mark.parametrize(
    "effect",
    [
        lambda x, v: 150.0 * np.tanh(v / 1e-3),
        lambda x, v: 5e5 * np.maximum(x - 20e-3, 0.0),
        lambda x, v: 800.0 * v * (x / 10e-3),
        lambda x, v: 2.0e3 * np.abs(v) * v,
        lambda x, v: np.where(x > 21e-3, -2e5 * (x - 21e-3), 0.0),
    ],
    ids=["friction", "stop", "preload", "quadratic", "yielding"],
)
def test_effects_of_the_specimen_are_no_faults(rng, effect):
    assert kinds(dataset(rng, effect)) == []


def test_a_force_of_the_wrong_sign_is_turned(rng):
    data = dataset(rng)
    number = int(rng.integers(len(CONDITIONS)))
    found = examine(with_run(data, number, force=-data.runs[number].force))
    assert [(fault.run, fault.kind) for fault in found.faults] == [(f"r{number}", "polarity")]
    assert np.array_equal(found.dataset.runs[number].force, data.runs[number].force)


@pytest.mark.parametrize("factor", [1000.0, 1e-3, 10.0, 0.1, 9.80665, 1 / 9.80665, 4.4482216])
def test_a_wrong_unit_is_told_by_its_factor(rng, factor):
    data = dataset(rng)
    number = int(rng.integers(len(CONDITIONS)))
    found = examine(with_run(data, number, force=factor * data.runs[number].force))
    assert [(fault.run, fault.kind) for fault in found.faults] == [(f"r{number}", "unit")]
    assert found.faults[0].factor == pytest.approx(1.0 / factor, rel=0.03)


def test_a_gain_within_reason_is_no_wrong_unit(rng):
    """1.3 is a matter of the sensor or of the specimen: the pursuit of causes deals with it."""
    data = dataset(rng)
    assert kinds(with_run(data, 3, force=1.3 * data.runs[3].force)) == []


def test_a_copy_is_told(rng):
    data = dataset(rng)
    assert kinds(with_run(data, 5, **data.runs[2].channels)) == [("r5", "duplicate")]


def test_computed_forces_may_repeat_themselves():
    """Without noise two runs of one motion are the same: nobody copied them."""
    x = 0.02 + 1e-3 * np.sin(2.0 * np.pi * 5.0 * TIME)
    runs = tuple(Run(n, "harmonic", TIME, {"displacement": x, "force": 2e5 * x}, group="a") for n in "ab")
    assert kinds(Dataset("computed", runs)) == []


@pytest.mark.parametrize("lost", [3, 20])
def test_lost_samples_are_told(rng, lost):
    data = dataset(rng)
    number, at = int(rng.integers(len(CONDITIONS))), int(rng.integers(500, 3400))
    keep = np.r_[0:at, at + lost : TIME.size]
    x, force = data.runs[number].displacement[keep], data.runs[number].force[keep]
    before, across, after = np.diff(x[at - 2 : at + 2])
    # less than what a sample travels, and the cut happens to close up again
    if abs(across - 0.5 * (before + after)) > max(0.2e-3, 1.2 * abs(before), 1.2 * abs(after)):
        assert kinds(with_run(data, number, displacement=x, force=force)) == [(f"r{number}", "lost_samples")]


def test_corners_of_a_triangle_are_no_lost_samples(rng):
    x = 0.03 * (1.0 - np.abs(TIME / 2.0 - 1.0)) + 2e-6 * rng.standard_normal(TIME.size)
    run = Run("qs", "quasi_static", TIME, {"displacement": x, "force": 2e5 * x + rng.standard_normal(x.size)})
    assert kinds(Dataset("triangle", (run,))) == []


@pytest.mark.parametrize("number", range(20))
def test_a_triangle_may_turn_anywhere_between_two_samples(number):
    """Of a slow record with little noise a corner is as sharp as a jump; what is lost on the way is a jump still."""
    rng = np.random.default_rng([7, number])
    period, count = rng.uniform(25.0, 400.0), int(rng.integers(200, 2000))
    noise = 4e-3 / period * 10.0 ** rng.uniform(-4.0, -1.0)

    def slow(phase):
        x = 1e-3 * (4.0 * np.abs(phase % 1.0 - 0.5) - 1.0) + noise * rng.standard_normal(count)
        return Run("r", "quasi_static", 0.1 * np.arange(count), {"displacement": x, "force": 1e6 * x})

    phase = rng.random() + np.arange(count) / period
    assert lost_samples(slow(phase)) is None
    cut, at = phase.copy(), count // 2
    cut[at:] += 0.25 - phase[at]  # goes on in the middle of a stroke
    left = abs(4.0 * abs(phase[at - 1] % 1.0 - 0.5) - 1.0)
    if left > 16.0 / period:  # of the amplitude: four samples away from there
        assert lost_samples(slow(cut)) is not None


def test_clipped_runs_that_reading_set_aside_are_remembered(rng):
    data = replace(dataset(rng), faults=(("gone", Trouble("the force stays", "measure again", fault="clipping")),))
    fault = examine(data).faults[0]
    assert (fault.run, fault.kind) == ("gone", "clipping")


@pytest.mark.parametrize(("channel", "factor"), [("force", 1000.0), ("displacement", 1000.0), ("force", -1.0)])
def test_runs_know_the_motion_of_a_run_before_them_as_it_was_corrected(rng, channel, factor):
    """A run with kN, or mm, as if they were N or m, or turned, has moved the specimen like the sound one."""
    sound = dataset(rng)
    wrong = with_run(sound, 3, **{channel: factor * sound.runs[3].channels[channel]})
    expected, made = (list(with_history((run, True) for run in data.runs)) for data in (sound, wrong))
    found = examine(replace(wrong, runs=tuple(made)))
    assert [fault.factor for fault in found.faults] == [pytest.approx(1.0 / factor)]
    for run, other in zip(found.dataset.runs, expected, strict=True):
        assert run.history == pytest.approx(other.history, rel=1e-9)
    assert len(found.dataset.runs[-1].history) == (len(expected) - 1) + 1


@pytest.mark.parametrize("factor", [1e-3, 1e3])
def test_how_far_the_specimen_was_deflected_is_put_right_beside_what_else_is_known_of_it(rng, factor):
    """A run that was set aside went further than all others; the last one tells how far the specimen has been."""
    sound = dataset(rng)
    far = sweep("far", 2e-3, 40e-3, rng, lambda x, v: 0.0)
    wrong = with_run(sound, 3, displacement=factor * sound.runs[3].displacement)
    told = [
        [*((run, True) for run in data.runs[:2]), (far, False), *((run, True) for run in data.runs[2:-1])]
        + [(replace(data.runs[-1], settings={"reached": 50e-3}), True)]
        for data in (sound, wrong)
    ]
    expected, made = (list(with_history(each)) for each in told)
    found = examine(replace(wrong, runs=tuple(made)))
    assert [fault.channel for fault in found.faults] == ["displacement"]
    reached = [run.history["reached"] for run in found.dataset.runs]
    assert reached == pytest.approx([run.history["reached"] for run in expected], rel=1e-9)
    assert reached[0] == 0.0 and reached[-1] == 50e-3


def test_harmonics_of_the_actuator_are_remarked():
    """A tenth of the motion in the second harmonic, and none."""
    for share in (0.1, 0.0):
        phase = 2.0 * np.pi * 5.0 * TIME
        x = 0.02 + 1e-3 * (np.sin(phase) + share * np.sin(2.0 * phase))
        said = actuator_remarks([Run("a", "harmonic", TIME, {"displacement": x, "force": 2e5 * x})])
        expected = "Run 'a': harmonic 2 of the displacement itself is 10% of the motion; the actuator adds it"
        assert [text.partition(",")[0] for text in said] == [expected] * (share > 0.0)


@pytest.mark.parametrize("round_", [0.0, 0.1])
def test_the_harmonics_of_a_triangle_are_not_those_of_the_actuator(round_, rng):
    """The third one is a ninth of the motion; sharp, and with a tenth of each stroke round at the turns."""
    phase = 5.0 * TIME
    x = 1e-3 * (1.0 - 4.0 * np.abs(phase % 1.0 - 0.5))
    width = int(round_ * 100) + 1
    x = np.convolve(x, np.full(width, 1.0 / width), "same") + 2e-6 * rng.standard_normal(TIME.size)
    x = x[100:-100]
    said = Run("a", "harmonic", TIME[: x.size], {"displacement": x, "force": 2e5 * x})
    assert actuator_remarks([said]) == []


def test_harmonics_of_the_actuator_in_many_runs_are_one_remark():
    """Of 8, 12 and 10 % of the motion, and none."""
    phase, runs = 2.0 * np.pi * 5.0 * TIME, []
    for name, share in (("a", 0.08), ("b", 0.12), ("c", 0.1), ("d", 0.0)):
        x = 0.02 + 1e-3 * (np.sin(phase) + share * np.sin(2.0 * phase))
        runs.append(Run(name, "harmonic", TIME, {"displacement": x, "force": 2e5 * x}))
    (said,) = actuator_remarks(runs)
    assert said.startswith("3 of 4 runs, most of all 'b': harmonic 2 of the displacement itself is 12% of the motion")
    assert actuator_remarks(runs[:3])[0].startswith("All 3 runs, most of all 'b'")
    assert len(actuator_remarks(runs[:2])) == 2


def test_a_prescribed_force_may_come_back_to_the_last_digit(rng):
    """A rig that drives the force: two periods have one force, and motions of their own."""
    data = dataset(rng)
    copied = data.runs[2]
    moved = copied.displacement + 2e-6 * rng.standard_normal(TIME.size)
    assert kinds(with_run(data, 5, force=copied.force, displacement=moved)) == []


def test_jumps_that_an_uneven_clock_allows_are_no_lost_samples(rng):
    """Where the time was laid on an even grid as many samples may be missing as reading bridges."""
    x = 5e-3 * np.sin(2.0 * np.pi * TIME)
    keep = np.r_[0:1000, 1012 : TIME.size]
    run = Run("a", "harmonic", TIME[: keep.size], {"displacement": x[keep], "force": 2e5 * x[keep]}, group="a")
    assert kinds(Dataset("even", (run,))) == [("a", "lost_samples")]
    assert kinds(Dataset("uneven", (replace(run, uneven=True),))) == []


def test_a_drive_with_play_that_lurches_where_it_turns_loses_no_samples():
    """A crank at 1.2 Hz, 100 Hz and 5 um: at one turn its play of 0.08 mm is taken up between two samples."""
    time = np.arange(1200) * 1e-2
    x = 6e-3 * np.cos(2.0 * np.pi * 1.2 * time)
    x[time > 2.5 / 1.2] -= 0.08e-3
    x = 5e-6 * np.round(x / 5e-6)
    assert lost_samples(Run("crank", "harmonic", time, {"displacement": x, "force": 2e4 * x})) is None


@pytest.mark.parametrize("phase", [0.1, 0.25, 0.4])
def test_samples_of_a_crank_that_are_lost_on_its_way_are_told(phase):
    """Three samples of the same crank are missing, on its way or just before it turns."""
    time = np.arange(1210) * 1e-2
    x = 5e-6 * np.round(6e-3 * np.cos(2.0 * np.pi * 1.2 * time) / 5e-6)
    at = int(100 * (3.0 + phase) / 1.2)
    keep = np.r_[0:at, at + 3 : time.size]
    run = Run("crank", "harmonic", time[: keep.size], {"displacement": x[keep], "force": 2e4 * x[keep]})
    found = lost_samples(run)
    assert found is not None and found.kind == "lost_samples" and f"at {0.01 * at:.6g} s" in found.evidence


def test_a_unit_that_was_corrected_is_not_told_again_by_the_settings(rng):
    """In mm as if they were m a run moves otherwise than declared; corrected it does not."""
    sound = dataset(rng)
    wrong = with_run(sound, 3, displacement=1000.0 * sound.runs[3].displacement)
    runs = [replace(run, settings={"amplitude": 0.5 * float(np.ptp(run.displacement))}) for run in sound.runs]
    told = tuple(replace(run, settings=one.settings) for run, one in zip(wrong.runs, runs, strict=True))
    found = examine(replace(wrong, runs=told))
    assert [fault.kind for fault in found.faults] == ["unit_of_displacement"]
    assert not [remark for remark in found.remarks if "otherwise than declared" in remark]


def test_a_run_that_gives_energy_back_is_not_turned_back_by_the_others(rng):
    """Ramps, which have no closed cycles, agree with each other in a wrong sign; the sine has to take up work."""
    runs = []
    for number, stroke in enumerate((1.5, 3.0, 4.5, 6.0, 0.0)):
        x = 1e-3 * (stroke * TIME / TIME[-1] if stroke else 3.0 * np.sin(6.0 * np.pi * TIME))
        force = -2e5 * x - 400.0 * np.gradient(x, TIME) + 2.0 * rng.standard_normal(x.size)
        runs.append(Run(f"r{number}", "harmonic", TIME, {"displacement": x, "force": force}))
    (fault,) = examine(Dataset("made", tuple(runs))).faults
    assert (fault.run, fault.kind, fault.factor) == ("r4", "polarity", -1.0)
