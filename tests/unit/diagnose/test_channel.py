"""Faults of single runs: found where repeats or neighbours show them, never where a law could do the same."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from unit.diagnose.laws import Sine
from unit.diagnose.rig import (
    MOTIONS,
    NETWORK,
    NOISE,
    SAMPLES,
    STEP,
    TIME,
    Motion,
    bench,
    causes,
    dataset,
    friction,
    line,
    plain,
)

from dashpot.contract.registry import load_registry
from dashpot.data.correction import Correction
from dashpot.data.run import Run
from dashpot.diagnose.channel import accuse, conditions, covers, evidence_in
from dashpot.diagnose.diagnose import diagnose
from dashpot.diagnose.findings import Findings
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.leftover import Leftover
from dashpot.diagnose.look import look_at
from dashpot.diagnose.repeats import begun_together, doubts, kinds_of, repeats_of
from dashpot.diagnose.whitening import reduction
from dashpot.fit.thinned import highest_frequency
from dashpot.triage.examine import Triage
from dashpot.triage.fault import Fault

WORDS = ("gain", "offset", "drift", "hum")
AGAIN = {"again": "a3_p8"}
FAULTS = {
    "offset": (lambda force: force + 15.0, 15.0),
    "gain": (lambda force: 1.03 * force, 0.03),
    "drift": (lambda force: force + np.linspace(0.0, 30.0, force.size), 30.0),
}


def examined(data, doubted=False, text=NETWORK):
    """Accusations by (run, word), of a bench at which nothing is missing in the network."""
    made = bench(data, text)
    look = look_at(made.refitter, made.model, causes(*WORDS), folds_of(made.refitter.runs, made.groups))
    kinds = kinds_of(causes(*WORDS), look)
    differ = doubts(made.refitter, look, kinds, made.groups)
    if doubted:
        return {kind.cause.word for kind in kinds if kind.fault in [doubt.fault for doubt in differ]}
    folds = folds_of(made.refitter.runs, made.groups)
    look = look_at(made.refitter, made.model, causes(*WORDS), folds, doubted=differ)
    measured = {run.name: run for run in data.runs if run.name in made.setting.split.train}
    found = accuse(made.refitter, look, kinds, made.groups, measured, differ, 0.0015)
    return {(one.run, one.kind.cause.word): one for one in found}


@pytest.mark.parametrize("word", FAULTS)
def test_a_repeat_that_differs_is_accused_with_its_size(word):
    fault, size = FAULTS[word]
    data = dataset(repeats=AGAIN, fault={"again": fault})
    assert word in examined(data, doubted=True)
    found = examined(data)
    assert set(found) == {("again", word)}
    one = found["again", word]
    assert one.evidence_of == "repeats" and "'a3_p8'" in one.words
    assert one.strengths[0] == pytest.approx(size, rel=0.15)
    low, high = one.interval
    assert low < size < high < low + 0.5 * size
    sound, wrong = plain(MOTIONS["a3_p8"]), fault(plain(MOTIONS["a3_p8"]))
    assert np.std(one.correction.apply(wrong, 2e-3) - sound) < 0.15 * np.std(wrong - sound) + 0.5


@pytest.mark.parametrize(("factor", "accused"), [(0.2, True), (-0.24, False)])
def test_no_gain_turns_a_force_round(factor, accused):
    found = examined(dataset(repeats=AGAIN, fault={"again": lambda force: factor * force}))
    assert (("again", "gain") in found) is accused
    assert not [one for (_, word), one in found.items() if word == "gain" and one.strengths[0] <= -1.0]


def test_a_specimen_that_changed_between_two_tests_accuses_no_run():
    """From the fourth run on it is softer by 3 %: the repeat of the first run differs, that of the sixth does not."""
    repeats = {"again": "a1_p5", "once_more": "a3_p11"}
    later = [*list(MOTIONS)[3:], *repeats]
    data = dataset(repeats=repeats, fault=dict.fromkeys(later, lambda force: 0.97 * force))
    assert "gain" in examined(data, doubted=True)
    assert not [run for run, word in examined(data) if word == "gain"]


def test_a_zero_that_drifts_in_most_runs_is_no_specimen_that_changed():
    """A specimen that changed for good between two tests has another stiffness or zero; it does not drift on."""
    rates = dict(zip([*MOTIONS, "again", "once_more"], (0, 0, 25, 32, 28, 40, 22, -10), strict=True))
    repeats = {"again": "a1_p5", "once_more": "a3_p11"}
    fault = {
        run: lambda force, rise=rise: force + np.linspace(-0.5 * rise, 0.5 * rise, force.size)
        for run, rise in rates.items()
        if rise
    }
    found = examined(dataset(repeats=repeats, fault=fault))
    assert {word for _, word in found} == {"drift"}
    assert {run for run, _ in found} >= {run for run, rise in rates.items() if abs(rise) > 20.0}


CURVE = """\
format: dashpot-network/1
name: curve
branches:
  spring:
    element: spring
    stiffness: {deflection: [0 mm, 4 mm, 8 mm, 12 mm, 16 mm], force: {start: [0 kN, 1 kN, 3 kN, 6 kN, 9 kN]}}
  damping: {element: damper, damping: {start: 200 N*s/m}}
"""
SCATTER = {"again_1": 6.0, "again_2": -4.0, "again_3": 3.0}  # N, by which a specimen differs from one test to the next


@pytest.mark.parametrize("offset, accused", [(30.0, set()), (900.0, {("again_4", "offset")})], ids=["one", "far"])
def test_a_repeat_is_accused_where_it_stands_out_from_the_scatter_of_all_repeats(offset, accused):
    differ = SCATTER | {"again_4": offset}
    repeats = dict(zip(differ, ("a1_p5", "a3_p5", "a1_p11", "a3_p8"), strict=True))
    fault = {name: lambda force, by=by: force + by for name, by in differ.items()}
    found = set(examined(dataset(repeats=repeats, fault=fault)))
    assert {key for key in found if key[1] == "offset"} == accused
    assert not [key for key in found if key[1] == "drift"], "nothing moves during a run"


def test_repeats_count_from_the_same_sample_on():
    """Noise tells the end of a first cycle to a few samples; a run of another length is no repeat."""
    made = bench(dataset(repeats=AGAIN))
    runs = {run.name: run for run in made.refitter.runs}
    runs |= {"again": replace(runs["again"], first=runs["a3_p8"].first + 3)}
    runs |= {"a1_p5": replace(runs["a1_p5"], first=runs["a1_p5"].first + 1)}
    found = {run.name: run for run in begun_together(list(runs.values()), made.groups)}
    assert found["a3_p8"].first == found["again"].first == runs["again"].first
    assert all(found[name].first == run.first for name, run in runs.items() if name not in {"a3_p8", "again"})
    refitter = replace(made.refitter, runs=list(runs.values()))
    assert not repeats_of(refitter, made.groups)
    assert repeats_of(replace(refitter, runs=list(found.values())), made.groups) == [("a3_p8", "again")]


@pytest.mark.parametrize(("alone", "at_floor"), [("", True), ("a1_p8", True), ("once_more", False)])
def test_a_run_that_stands_alone_is_no_noise_though_its_repeat_differs(alone, at_floor):
    """The floor of all repeats holds 15 % of the force of one run, by which the other two do not differ."""
    repeats = {"again": "a1_p5", "once_more": "a3_p11"}
    made = bench(dataset(repeats=repeats, fault={"once_more": lambda force: 1.15 * force}))
    assert made.setting.floor.value > 5.0 * NOISE
    left = Leftover(20.0, 0.5, "", run=alone)
    known = {"setting": made.setting, "_floor": made.setting.floor.value, "relevance": 0.0015}
    found = SimpleNamespace(leftover=left, accused=(), _trained=3.0 * NOISE, **known)
    assert Findings._at_floor.fget(found) == at_floor


def test_what_triage_corrects_stands_in_the_corrected_dataset():
    """The force as well as the displacement; a run that it sets aside has no correction."""
    faults = [
        Fault("a", "unit", "", "", 1e-3),
        Fault("b", "unit_of_displacement", "", "", 25.4, "displacement"),
        Fault("c", "unit", "", ""),
    ]
    found = SimpleNamespace(faults=faults)
    assert Triage.corrections.fget(found) == {
        "a": Correction(gain=1e-3),
        "b": Correction(displacement_gain=25.4),
    }


def test_a_difference_of_two_repeats_accuses_one_of_them():
    """What both of them have beside, here 20 N at that preload, is no fault of the other one."""
    fault = {"again": lambda force: 1.03 * force + 20.0, "a3_p8": lambda force: force + 20.0}
    assert len({run for run, _ in examined(dataset(repeats=AGAIN, fault=fault))}) == 1


@pytest.mark.parametrize("both", [0.0, 60.0])
def test_a_fault_is_as_large_as_its_run_differs_from_the_repeat(both):
    """What both have, a force of the specimen that grows through the run, is no fault of one of them."""

    def drifts(by):
        return lambda force: force + np.linspace(-0.5 * by, 0.5 * by, force.size)

    found = examined(dataset(repeats=AGAIN, fault={"again": drifts(both + 20.0), "a3_p8": drifts(both)}))
    assert set(found) == {("again", "drift")}
    assert found["again", "drift"].strengths == pytest.approx([20.0, -10.0], abs=2.0)


class Stroke(Motion):
    """There and back once."""

    def phase(self, time=TIME):
        return 2.0 * np.pi * time / TIME[-1] - 0.5 * np.pi

    def v(self, time=TIME):
        return self.amplitude * np.cos(self.phase(time)) * 2.0 * np.pi / TIME[-1]


SLIDER = NETWORK + "  slider: {element: prandtl, stiffness: {start: 100 N/mm}, limit: {start: 20 N}}\n"


@pytest.mark.parametrize(("drift", "accused"), [(0.0, False), (60.0, True)])
def test_friction_that_is_another_one_in_a_single_stroke_there_and_back_is_no_drift(drift, accused):
    """It changes its sign at the end of the stroke, as a zero that drifts about goes from one side to the other."""
    strokes = {name: Stroke(motion.amplitude, motion.preload) for name, motion in MOTIONS.items()}
    more = friction(strokes["a3_p8"], 10.0) + np.linspace(0.0, drift, SAMPLES)
    data = dataset(
        lambda motion: plain(motion) + friction(motion), 0, strokes, AGAIN, fault={"again": lambda force: force + more}
    )
    assert ("drift" in {word for _, word in examined(data, text=SLIDER)}) == accused


def test_a_doubted_fault_is_as_large_as_repeats_differ():
    """The difference of two that are off by one deviation each is root 2 times as large."""
    made = bench(dataset(repeats=AGAIN, fault={"again": lambda force: force + 15.0}))
    look = look_at(made.refitter, made.model, causes("offset"), folds_of(made.refitter.runs, made.groups))
    (doubt,) = doubts(made.refitter, look, kinds_of(causes("offset"), look), made.groups)
    assert doubt.strengths == pytest.approx([15.0 / np.sqrt(2.0)], rel=0.1)


def test_repeats_that_agree_accuse_nobody():
    data = dataset(repeats=AGAIN)
    assert examined(data, doubted=True) == set()
    assert examined(data) == {}


def test_a_run_within_what_others_cover_is_accused():
    """Preload 8 mm lies between 5 and 11 mm, and both amplitudes are there at both."""
    found = examined(dataset(fault={"a3_p8": lambda force: 1.03 * force}))
    assert set(found) == {("a3_p8", "gain")}
    assert "other runs under the same conditions" in found["a3_p8", "gain"].words


def test_what_a_fault_explains_is_measured_by_what_is_left_beside_it():
    """By least squares of spring and dashpot to 3 % of the force of one run: what they leave, over the noise."""
    data = dataset(fault={"a3_p8": lambda force: 1.03 * force})
    runs, step = bench(data).refitter.runs, reduction(STEP, highest_frequency(bench(data).refitter.runs))
    wrong, columns = {}, {}
    for run in runs:
        motion, at = MOTIONS[run.name], slice(run.first, SAMPLES - (SAMPLES - run.first) % step)
        means = np.array([motion.x(), motion.v(), 0.03 * plain(motion)])[:, at].reshape(3, -1, step).mean(axis=2)
        columns[run.name], wrong[run.name] = means[:2], means[2] * (run.name == "a3_p8")
    design, errors = np.hstack(list(columns.values())).T, np.concatenate(list(wrong.values()))
    strengths = np.linalg.lstsq(design, errors, rcond=None)[0]
    left = np.mean((wrong["a3_p8"] - strengths @ columns["a3_p8"]) ** 2)
    assert examined(data)["a3_p8", "gain"].explained == pytest.approx(left / (NOISE**2 / step) / len(runs), rel=0.05)


def test_a_run_that_pulled_the_fit_to_itself_is_named():
    """What the model leaves in the other runs is judged after it was fitted again without the fault."""
    data = dataset(fault={"a3_p8": lambda force: 1.03 * force})
    found = diagnose(bench(data).model.declared, data, registry=load_registry()).as_dict()["causes"]
    [(word, probability)] = [(one["cause"], one["probability"]) for one in found if one["accepted"]]
    assert word == "gain" and probability > 0.9


def test_the_noise_floor_is_that_of_the_corrected_runs():
    """What a drift makes two repeats differ by is no noise once it is put right."""
    data = dataset(repeats=AGAIN, fault={"again": FAULTS["drift"][0]})
    made = bench(data)
    assert made.setting.floor.value > 1.4 * NOISE
    found = diagnose(made.model.declared, data, registry=load_registry()).as_dict()
    assert [cause["cause"] for cause in found["causes"] if cause["accepted"]] == ["drift"]
    assert found["noise_floor"]["value"] == pytest.approx(NOISE, rel=0.1)


@pytest.mark.parametrize(
    "extreme",
    [Motion(3e-3, 8e-3, 25.0), Motion(6e-3, 8e-3), Motion(3e-3, 15e-3)],
    ids=["fastest", "largest", "deepest"],
)
def test_a_run_at_the_end_of_what_was_measured_is_never_accused(extreme):
    data = dataset(motions={**MOTIONS, "extreme": extreme}, fault={"extreme": lambda force: 1.05 * force})
    assert not [key for key in examined(data) if key[0] == "extreme"]


def test_a_law_that_grows_with_speed_accuses_no_run():
    """Quadratic damping that the network lacks: the fast runs deviate, each within its own conditions only."""
    motions = {f"f{f}": Motion(3e-3, 8e-3, float(f)) for f in (4, 8, 12, 16, 24)}
    data = dataset(lambda motion: plain(motion) + 400.0 * motion.v() * np.abs(motion.v()), motions=motions)
    assert "f24" not in {run for run, _ in examined(data)}


def test_hum_is_seen_where_nothing_was_driven():
    phases = {name: 1.0 + number for number, name in enumerate(MOTIONS)}
    fault = {name: lambda force, phase=phase: force + line(50.0, 12.0, phase) for name, phase in phases.items()}
    found = examined(dataset(fault=fault))
    assert set(found) == {(run, "hum") for run in MOTIONS}
    for one in found.values():
        assert one.evidence_of == "at_rest" and one.kind.fault.form == "50 Hz"
        assert np.hypot(*one.strengths) == pytest.approx(12.0, rel=0.15)


def test_hum_is_seen_beside_its_own_harmonic_and_its_swing():
    """What the fundamental leaves of the hum is no noise that could hide it."""
    motions = {name: replace(motion, fastest=25.0) for name, motion in MOTIONS.items()}
    fault = {
        name: lambda force, phase=phase: (
            force + line(50.0, 60.0, phase) * (1.0 + line(0.7, 0.15, phase)) + line(100.0, 15.0, 2.0 * phase)
        )
        for phase, name in enumerate(MOTIONS)
    }
    found = examined(dataset(motions=motions, fault=fault))
    assert {run for run, _ in found} == set(MOTIONS)
    assert {word for _, word in found} == {"hum"}


def test_an_offset_beside_a_curve_that_it_bends_is_no_drift():
    """A drift takes up any offset, and a little of the error of a curve: what counts is its movement."""
    data = dataset(lambda motion: plain(motion) + 4e9 * motion.x() ** 3, fault={"a1_p8": lambda force: force - 600.0})
    found = diagnose(bench(data, CURVE).model.declared, data, registry=load_registry()).as_dict()["causes"]
    (fault,) = [one for one in found if one["accepted"] and one["class"] == "measurement"]
    assert fault["cause"] == "offset"
    (offset,) = fault["parameters"].values()
    assert offset["value"] == pytest.approx(-600.0, abs=3.0)


def test_a_line_among_lines_of_its_kind_is_no_hum():
    """What a model misses of a motion of many sines has lines all over, and one of them is at that of the mains."""
    frequencies = np.arange(30.0, 101.0, 2.0)
    phases = np.random.default_rng(3).uniform(0.0, 2.0 * np.pi, (len(MOTIONS), frequencies.size))
    sizes = np.where(frequencies == 50.0, 36.0, 12.0)
    missed = [sum(map(line, frequencies, sizes, each)) for each in phases]
    fault = {name: lambda force, more=more: force + more for name, more in zip(MOTIONS, missed, strict=True)}
    assert not [run for run, word in examined(dataset(fault=fault)) if word == "hum"]


SINES = {f"f{f:g}_a{a:g}": Sine(1e-3 * a, 8e-3, f) for f in (10.0, 30.0) for a in (1, 3)}


def hum_by_sines(frequency, runs):
    """The runs in which hum is told, where all motions are sines and a line of 12 N is in some of them."""
    fault = {name: lambda force, k=k: force + line(frequency, 12.0, 1.0 + k) for k, name in enumerate(runs)}
    return {run for run, word in examined(dataset(motions=SINES, fault=fault)) if word == "hum"}


@pytest.mark.parametrize("frequency, run", [(50.0, "f10_a3"), (150.0, "f30_a3")])
def test_a_harmonic_of_the_motion_alone_is_no_hum(frequency, run):
    """The mains are the fifth harmonic of 10 and of 30 Hz, where friction has one as well."""
    assert not hum_by_sines(frequency, [run])


def test_hum_that_runs_show_without_a_harmonic_there_is_told_in_all():
    assert hum_by_sines(50.0, SINES) == set(SINES)


def test_hum_at_a_high_harmonic_of_the_motion_is_seen_above_its_neighbours():
    assert hum_by_sines(150.0, ["f10_a1", "f10_a3"]) == {"f10_a1", "f10_a3"}


def test_nats_of_runs_add_up_where_nothing_but_noise_is_left():
    """An error of the model comes again in every run: the best one counts."""
    assert evidence_in([(5.0, 1.0), (6.0, 1.0)]) == 11.0
    assert evidence_in([(30.0, 3.0), (40.0, 5.0)]) == 10.0
    assert evidence_in([(5.0, 1.0), (30.0, 3.0), (40.0, 5.0)]) == 15.0
    assert evidence_in([]) == 0.0


def test_a_gain_and_an_offset_of_one_run_are_both_told():
    """Each explains what the other cannot: none is dropped."""
    found = examined(dataset(fault={"a3_p8": lambda force: 1.05 * force + 200.0}))
    assert set(found) == {("a3_p8", "gain"), ("a3_p8", "offset")}
    assert found["a3_p8", "gain"].strengths[0] == pytest.approx(0.05, rel=0.1)


def test_repeats_are_the_same_motion():
    data = dataset(repeats=AGAIN)
    made = bench(data)
    assert repeats_of(made.refitter, made.groups) in ([("a3_p8", "again")], [("again", "a3_p8")])
    alone = {name: name for name in made.groups}
    assert repeats_of(made.refitter, alone) == []


def test_what_covers_a_run():
    runs = {run.name: run for run in dataset().runs}
    others = [run for name, run in runs.items() if name != "a3_p8"]
    assert covers(others, runs["a3_p8"])
    shallow = [run for name, run in runs.items() if not name.endswith("p11")]
    assert not covers(shallow, runs["a3_p11"])
    assert not covers(others[:1], runs["a3_p8"])
    assert conditions(runs["a3_p8"])["stroke"] == pytest.approx(6e-3, rel=0.01)


def driven(amplitude, preload, frequency=5.0):
    """A run of a sine of so many mm about so many mm."""
    time = np.arange(2000) * 1e-3
    path = 1e-3 * (preload + amplitude * np.sin(2.0 * np.pi * frequency * time))
    name = f"a{amplitude}_p{preload}_f{frequency}"
    settings = {"frequency": frequency}
    return Run(name, "harmonic", time, {"displacement": path, "force": 1e5 * path}, settings=settings)


def test_a_run_at_a_corner_is_not_covered_and_one_between_others_is():
    grid = [driven(a, p) for a in (1, 2, 5) for p in (10, 20, 30)]
    inside = {run.name: covers([one for one in grid if one is not run], run) for run in grid}
    assert inside == {run.name: not run.name.startswith(("a1_p10", "a5_p10", "a1_p30", "a5_p30")) for run in grid}


def test_the_same_stroke_at_a_speed_between_others_is_covered():
    """Peak to peak of a sampled sine is the same to a percent."""
    speeds = [driven(5, 0, frequency) for frequency in (1.0, 3.0, 7.0, 19.0, 23.0)]
    inside = [covers([one for one in speeds if one is not run], run) for run in speeds]
    assert inside == [False, True, True, True, False]
