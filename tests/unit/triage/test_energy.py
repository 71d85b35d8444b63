"""Runs that give back energy beyond doubt, judged by the scatter of few cycles in each of several runs."""

import numpy as np
import pytest

from dashpot.data.run import Run
from dashpot.triage.energy import giving_back, runs_that_give_back
from dashpot.triage.work import CycleWork, work_of_cycles

STEP = 1e-3


def sine_run(cycles, force=lambda x, v: -300.0 * v, phase=0.0, name="a", noise=0.1):
    time = np.arange(int(cycles / 2.0 / STEP)) * STEP
    x = 1e-3 * np.sin(4.0 * np.pi * time + phase)
    values = force(x, np.gradient(x, STEP)) + noise * np.random.default_rng(1).standard_normal(x.size)
    return Run(name, "harmonic", time, {"displacement": x, "force": values}, group=name)


def works_of_halves(halves):
    """Works (runs, halves) as shares of what is moved, without any systematic allowance but that of the machine."""
    return {f"r{k}": CycleWork(each, 0.0, 1.0, 1.0) for k, each in enumerate(halves)}


@pytest.mark.parametrize("phase", [0.0, 0.25 * np.pi, 0.5 * np.pi, np.pi, 1.5 * np.pi])
def test_four_recorded_cycles_have_at_least_six_halves(phase):
    """Wherever the record begins; between upward passages alone one that begins at its middle has two cycles."""
    assert work_of_cycles(sine_run(4.0, phase=phase)).halves.size >= 6


def test_a_force_that_drifts_evenly_gives_no_work():
    drifting = sine_run(4.0, lambda x, v: 200.0 * np.linspace(0.0, 1.0, x.size), noise=0.0)
    work = work_of_cycles(drifting)
    assert abs(work.halves[0]) > 0.05 * work.moved
    assert abs(work.mean) < 2e-3 * work.moved


def test_a_run_of_one_cycle_is_judged_by_the_scatter_of_the_others():
    short = sine_run(2.0)
    sound = [sine_run(8.0, lambda x, v: 300.0 * v, name=f"s{k}") for k in range(3)]
    assert runs_that_give_back([short]) == frozenset()
    assert runs_that_give_back([short, *sound]) == {"a"}


def test_runs_that_take_up_work_and_runs_without_cycles_do_not_give_back():
    ramp = sine_run(0.25, name="ramp")
    assert runs_that_give_back([sine_run(6.0, lambda x, v: 300.0 * v), ramp]) == frozenset()


def test_a_run_of_one_cycle_is_let_pass_where_the_others_scatter_as_much():
    rng = np.random.default_rng(3)
    works = works_of_halves([np.array([-0.1, -0.1]), *rng.normal(0.1, 0.1, (4, 6))])
    runs = [sine_run(2.0, name=name) for name in works]
    assert "r0" not in giving_back(runs, works)


@pytest.mark.parametrize("unlike", [1.0, 30.0])
def test_noise_alone_is_hardly_ever_accused(unlike):
    """500 datasets of six runs at the edge of what a machine may show, whose scatter may differ thirtyfold."""
    rng = np.random.default_rng(7)
    runs = [sine_run(2.0, name=f"r{k}") for k in range(6)]
    accused = 0
    for _ in range(500):
        scatter = np.exp(rng.uniform(0.0, np.log(unlike), (6, 1)))
        works = works_of_halves(-0.0075 + 0.01 * scatter * rng.standard_normal((6, 4)))
        accused += bool(giving_back(runs, works))
    assert accused <= 4
