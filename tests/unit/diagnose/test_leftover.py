"""How much of the residual is structure that no cause explains."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter
from unit.diagnose.rig import MOTIONS, SAMPLES, STEP, Motion, bench, causes, dataset, line

from dashpot.contract.registry import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.diagnose.diagnose import diagnose
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.leftover import look_for_leftover
from dashpot.diagnose.look import look_at
from dashpot.diagnose.repeats import repeats_of
from dashpot.diagnose.whitening import reduction
from dashpot.fit.thinned import highest_frequency

AGAIN = {"again": "a3_p8", "once_more": "a1_p5"}
STRUCTURE, NOISE = 6.0, 8.0  # N


def coloured(seed, deviation, memory):
    """An autoregressive signal of the first order (n,) N, begun long before."""
    found = lfilter([1.0], [1.0, -memory], np.random.default_rng(seed).standard_normal(SAMPLES + 500))[500:]
    return deviation * found / np.std(found)


@pytest.mark.parametrize("memory", [0.0, 0.6, 0.9], ids=["white", "coloured", "slow"])
def test_the_share_of_a_structure_that_comes_again_is_that_of_the_squares_in_newtons(memory):
    """In runs and their repeats alike, beside noise of another spectrum: the share is known of the signals made."""
    pairs = [*AGAIN.items()]
    structure = {new: coloured(7 + k, STRUCTURE, 0.8) for k, (new, _) in enumerate(pairs)}
    structure |= {old: structure[new] for new, old in pairs}
    noise = {name: coloured(100 + k, NOISE, memory) for k, name in enumerate(structure)}
    fault = {name: lambda force, name=name: force + structure[name] + noise[name] for name in structure}
    made = bench(dataset(repeats=AGAIN, fault=fault, noise=0.01))
    look = look_at(made.refitter, made.model, causes("friction"), folds_of(made.refitter.runs, made.groups))
    found = look_for_leftover(made.refitter, look, repeats_of(made.refitter, made.groups))
    step = reduction(STEP, highest_frequency(made.refitter.runs))
    errors = {name: _means(structure[name] + noise[name], step) for name in structure}
    whole = sum(float(one @ one) for one in errors.values())
    made_alike = 2.0 * sum(float(errors[new] @ errors[old]) for new, old in pairs) / whole
    alike = sum(float(np.sum(_means(one, step) ** 2)) for one in structure.values()) / whole
    assert found.what == "comes again in repeated runs"
    assert found.share == pytest.approx(made_alike, abs=0.05)
    assert found.share == pytest.approx(alike, abs=0.1)  # noises of two runs are alike by chance, too


def test_structure_is_told_of_all_runs_and_not_of_the_repeated_ones_alone():
    """Most of it is in runs that were not repeated; the noise is the same in all of them."""
    names = [*MOTIONS, *AGAIN]
    structure = {name: coloured(7 + k, 2.0 * STRUCTURE, 0.8) for k, name in enumerate(names)}
    structure |= {new: structure[old] / 2.0 for new, old in AGAIN.items()}
    structure |= {old: structure[new] for new, old in AGAIN.items()}
    noise = {name: coloured(100 + k, NOISE, 0.0) for k, name in enumerate(names)}
    fault = {name: lambda force, name=name: force + structure[name] + noise[name] for name in names}
    made = bench(dataset(repeats=AGAIN, fault=fault, noise=0.01))
    look = look_at(made.refitter, made.model, causes("friction"), folds_of(made.refitter.runs, made.groups))
    found = look_for_leftover(made.refitter, look, repeats_of(made.refitter, made.groups))
    step = reduction(STEP, highest_frequency(made.refitter.runs))
    squares = [
        sum(float(np.sum(_means(signal, step) ** 2)) for signal in signals)
        for signals in (structure.values(), (structure[name] + noise[name] for name in names))
    ]
    assert found.what == "comes again in repeated runs"
    assert found.share == pytest.approx(squares[0] / squares[1], abs=0.1)


def test_noise_that_is_larger_in_some_runs_and_smaller_in_others_is_no_structure():
    """The repeated runs have that in the middle; what differs by run cancels."""
    pairs = [*AGAIN.items()]
    structure = {new: coloured(7 + k, STRUCTURE, 0.8) for k, (new, _) in enumerate(pairs)}
    structure |= {old: structure[new] for new, old in pairs}
    others = [name for name in MOTIONS if name not in structure]
    sizes = {name: NOISE * size for name, size in zip(others, np.sqrt(np.linspace(0.2, 1.8, len(others))), strict=True)}
    names = [*structure, *others]
    noise = {name: coloured(100 + k, sizes.get(name, NOISE), 0.0) for k, name in enumerate(names)}
    fault = {name: lambda force, name=name: force + structure.get(name, 0.0) + noise[name] for name in names}
    made = bench(dataset(repeats=AGAIN, fault=fault, noise=0.01))
    look = look_at(made.refitter, made.model, causes("friction"), folds_of(made.refitter.runs, made.groups))
    found = look_for_leftover(made.refitter, look, repeats_of(made.refitter, made.groups))
    step = reduction(STEP, highest_frequency(made.refitter.runs))
    alike = sum(float(np.sum(_means(one, step) ** 2)) for one in structure.values())
    whole = sum(float(np.sum(_means(structure.get(name, 0.0) + noise[name], step) ** 2)) for name in names)
    assert len(others) > 3 and found.what == "comes again in repeated runs"
    assert found.share == pytest.approx(alike / whole, abs=0.06)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("share", "told"), [(0.0, False), (0.02, True)])
def test_a_residual_that_grows_with_the_deflection_is_no_noise(seed, share, told):
    """A stiffness that swings in its own time by 2 % has no course that any function of the motion follows."""
    swing = {name: 1.0 + share * coloured(50 * seed + k, 1.0, 0.9) for k, name in enumerate(MOTIONS)}
    about = {name: 200e3 * (motion.x() - motion.preload) for name, motion in MOTIONS.items()}
    fault = {name: lambda force, name=name: force + (swing[name] - 1.0) * about[name] for name in MOTIONS}
    made = bench(dataset(seed=seed, fault=fault))
    look = look_at(made.refitter, made.model, causes("friction"), folds_of(made.refitter.runs, made.groups))
    found = look_for_leftover(made.refitter, look, [])
    assert found.notable() is told
    if told:
        assert found.what == "grows with the deflection from the middle of the run"


def test_the_noise_at_the_corner_of_a_triangle_is_no_law():
    """There is all of the acceleration: four standard deviations at the corner would be a size that follows it."""
    data, again = dataset(noise=NOISE), np.linspace(-1.0, 1.0, SAMPLES)
    x = 8e-3 + 5e-3 * (1.0 - 2.0 * np.abs(again))
    step = reduction(STEP, highest_frequency(bench(data).refitter.runs))
    corner = np.abs(np.arange(SAMPLES) - SAMPLES // 2) <= step // 2
    force = 200e3 * x + 400.0 * np.gradient(x, STEP) + coloured(1, NOISE, 0.0)
    force[corner] += 4.0 * NOISE / np.sqrt(step)
    slow = Run("slow", "quasi_static", STEP * np.arange(SAMPLES), {"displacement": x, "force": force}, group="slow")
    made = bench(replace(data, runs=(*data.runs, slow)))
    look = look_at(made.refitter, made.model, causes("friction"), folds_of(made.refitter.runs, made.groups))
    assert not look_for_leftover(made.refitter, look, []).notable()


def test_an_undriven_line_is_no_noise_though_repeats_differ_by_it():
    """A pump at 37 Hz, of its own phase in every run: the noise floor from repeats holds it."""
    phases = {name: 1.0 + number for number, name in enumerate([*MOTIONS, *AGAIN])}
    fault = {name: lambda force, phase=phase: force + line(37.0, 8.0, phase) for name, phase in phases.items()}
    data = dataset(repeats=AGAIN, fault=fault)
    found = diagnose(bench(data).model.declared, data, registry=load_registry()).as_dict()
    assert found["rmse"]["after"]["train"] == pytest.approx(found["noise_floor"]["value"], rel=0.1)
    assert found["verdict"] == "unexplained"
    assert found["leftover"]["line"] and found["leftover"]["what"].startswith("is a line at 3")


def test_what_a_specimen_scatters_from_test_to_test_is_no_line():
    """Steady sines, damped by another amount in every test: a line at their frequency, and a function of the motion."""
    motions = {f"p{p}": Motion(2e-3, 1e-3 * p, 1.0) for p in (5, 6, 7, 8, 9, 10)}
    fault = {name: lambda force, by=by: force * (1.0 + 0.02 * by) for by, name in enumerate(motions)}
    made = bench(dataset(motions=motions, fault=fault))
    look = look_at(made.refitter, made.model, causes("friction"), folds_of(made.refitter.runs, made.groups))
    found = look_for_leftover(made.refitter, look, [])
    assert found.notable() and not found.line


def _means(signal, step):
    """The means (m,) of a signal over blocks of samples."""
    return signal[: signal.size // step * step].reshape(-1, step).mean(axis=1)


def sines(seed):
    """Nine sines of four cycles on a spring and a dashpot, the fast ones short, and white noise."""
    rng, runs = np.random.default_rng(seed), []
    for rate, amplitude in ((0.5, 12e-3), (1.7, 12e-3), (4.5, 4e-3)) * 3:
        rate *= rng.uniform(0.8, 1.2)
        time = STEP * np.arange(int(4.0 / rate / STEP))
        angle = 2.0 * np.pi * rate * time
        motion, velocity = amplitude * np.sin(angle), 2.0 * np.pi * rate * amplitude * np.cos(angle)
        force = 60e3 * motion + 200.0 * velocity + NOISE * rng.standard_normal(time.size)
        channels, settings = {"displacement": motion, "force": force}, {"amplitude": amplitude, "preload": 0.0}
        name = f"r{len(runs)}"
        runs.append(Run(name, "harmonic", time, channels, settings, None, name, order=len(runs)))
    return Dataset("sines", tuple(runs))


def test_nothing_is_left_of_short_runs_with_nothing_hidden():
    """The noise of runs of some hundred samples beside hundreds of columns is that of the record, not a part of it.

    Six sets: with false alarms in one of a hundred, two or more come in one of 700.
    """
    registry = load_registry()
    every = [registry.causes[word] for word in sorted(registry.causes)]
    notable, deviations = 0, []
    for seed in range(6):
        made = bench(sines(seed))
        look = look_at(made.refitter, made.model, every, folds_of(made.refitter.runs, made.groups))
        notable += look_for_leftover(made.refitter, look, ()).notable()
        white = [look.measured_noise.filters[run.name][0] for run in made.refitter.runs]
        deviations += [1.0 / one for one in white]
    assert notable <= 1
    assert np.sqrt(np.mean(np.square(deviations))) == pytest.approx(NOISE, rel=0.1)
