"""Records with fewer samples of the same motion: for a descent decimated, for a search as they were measured."""

from dataclasses import replace

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.data.drive import drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.fit import thinned as module
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.fit.thinned import SAMPLES, subsampled, thinned, thinned_objective
from dashpot.kernel.network import compile_network
from dashpot.model.reading import parse_network

STEP, FASTEST, LENGTH = 2e-4, 12.0, 4.0
TIME = STEP * np.arange(int(LENGTH / STEP))
STIFFNESS, LIMIT = 4e5, 150.0
SLIDER = f"""\
format: dashpot-network/1
name: slider
branches:
  slider: {{element: dahl, stiffness: {STIFFNESS} N/m, limit: {LIMIT} N, exponent: 0}}
"""


def motion(time):
    """Deflection, velocity and acceleration (n,) of a sweep of 3 mm from 1 Hz up."""
    rate = 2.0 * np.pi * (1.0 + (FASTEST - 1.0) * time / LENGTH)
    bend = 2.0 * np.pi * (FASTEST - 1.0) / LENGTH
    phase = 2.0 * np.pi * (time + 0.5 * (FASTEST - 1.0) * time**2 / LENGTH)
    x, v = 3e-3 * np.sin(phase), 3e-3 * rate * np.cos(phase)
    return x, v, 3e-3 * bend * np.cos(phase) - rate**2 * x


def slid(path):
    """The force (n,) of an elastic, ideally plastic slider along a path of small steps."""
    force, found = 0.0, np.zeros(path.size)
    for place, travel in enumerate(np.diff(path), 1):
        force = found[place] = np.clip(force + STIFFNESS * travel, -LIMIT, LIMIT)
    return found


def run_of(force):
    """A run of the sweep with a force (n,)."""
    return ScoredRun("run", "sweep", drive_from_path(STEP, *motion(TIME)), force, 100)


def test_samples_stay_where_the_motion_asks_for_them():
    (run,) = thinned([run_of(np.zeros(TIME.size))])
    assert SAMPLES <= 1.0 / (FASTEST * run.drive.dt) < 1.2 * SAMPLES
    step = round(run.drive.dt / STEP)
    assert run.drive.displacement == pytest.approx(motion(TIME[::step])[0][: run.force.size])
    assert run.force.size == run.drive.samples and run.first * step >= 100
    (again,) = thinned([run])
    assert again is run


def test_a_short_run_stays_as_it_is():
    short = drive_from_path(STEP, *(each[:1000] for each in motion(TIME)))
    run = ScoredRun("run", "sweep", short, np.zeros(1000), 100)
    assert thinned([run]) == [run]


@pytest.mark.parametrize("end", [0, -1], ids=["begin", "end"])
def test_every_force_that_counts_is_right(end):
    """A force that is at its peak where the record begins or ends, so that what is beyond cannot be guessed."""
    slow = 1000.0 * np.cos(2.0 * np.pi * FASTEST * (TIME - TIME[end]))
    (run,) = thinned([replace(run_of(slow), first=0)])
    kept = slow[:: round(run.drive.dt / STEP)][: run.force.size]
    assert np.abs(run.force - kept)[run.first :].max() < 1.0


def test_forces_along_the_decimated_path_are_those_of_the_whole():
    """Against return mapping along a path of twenty times as many steps."""
    (run,) = thinned([run_of(np.zeros(TIME.size))])
    network = compile_network(parse_network(SLIDER, _elements()))
    force = Objective(network, [run]).forces(network.start)[0][0]
    fine = slid(motion(STEP / 20.0 * np.arange(20 * TIME.size))[0])
    assert np.max(np.abs(force - fine[:: 20 * round(run.drive.dt / STEP)][: force.size])) < 1e-3 * LIMIT


def test_a_slow_force_stays_and_a_fast_line_is_not_folded_back():
    slow, fast = 40.0 * np.sin(2.0 * np.pi * 30.0 * TIME), 10.0 * np.sin(2.0 * np.pi * 1900.0 * TIME)
    (run,) = thinned([run_of(slow + fast)])
    inside = slice(40, -40)
    assert np.abs(run.force - slow[:: round(run.drive.dt / STEP)][: run.force.size])[inside].max() < 0.02


def test_runs_of_few_samples_are_searched_as_they_are():
    runs = [run_of(np.zeros(TIME.size)), run_of(np.ones(TIME.size))]
    assert subsampled(runs) == runs


@pytest.mark.parametrize(("most", "step"), [(9000, 3), (10, 24)], ids=["as few as that", "as few as the motion allows"])
def test_many_samples_become_fewer(monkeypatch, most, step):
    monkeypatch.setattr(module, "MOST", most)
    force = np.random.default_rng(1).normal(size=TIME.size)
    (run,) = subsampled([run_of(force)])
    assert run.drive.dt == pytest.approx(step * STEP)
    assert np.array_equal(run.force, force[::step][: run.force.size])


def test_what_is_left_of_a_right_model_is_nothing(monkeypatch):
    """Of a law that bends sharply a low-pass of the measured force alone would leave what looks like another law."""
    monkeypatch.setattr(module, "MOST", 10)
    network = compile_network(parse_network(SLIDER, _elements()))
    fine = slid(motion(STEP / 20.0 * np.arange(20 * TIME.size))[0])[::20]
    errors = [
        float(Objective(network, some([run_of(fine)])).losses(network.start[None])[0]) for some in (subsampled, thinned)
    ]
    assert errors[0] < 1e-4 * LIMIT
    assert errors[1] > 1e-2 * LIMIT


def _elements():
    from dashpot.contract.registry import load_registry

    return load_registry().elements


def test_slow_runs_are_thinned_by_their_own_motion_and_weigh_as_before():
    omega = 2.0 * np.pi * 3.0
    x, v = 3e-3 * np.sin(omega * TIME), 3e-3 * omega * np.cos(omega * TIME)
    slow = drive_from_path(STEP, x, v, -(omega**2) * x)
    runs = [run_of(np.zeros(TIME.size)), replace(run_of(np.ones(TIME.size)), kind="quasi_static", drive=slow)]
    network = compile_network(parse_network(SLIDER, load_registry().elements))
    sparse = thinned_objective(Objective(network, runs, weights=[1.0, 3.0]))
    assert [run.force.size for run in sparse.runs] == [thinned([run])[0].force.size for run in runs]
    assert sparse.runs[1].force.size < sparse.runs[0].force.size / 3
    assert sparse.shares.tolist() == [0.5, 1.5]


def test_runs_that_would_hardly_be_thinned_are_left():
    (run,) = thinned([run_of(np.zeros(TIME.size))])
    network = compile_network(parse_network(SLIDER, load_registry().elements))
    assert thinned_objective(Objective(network, [run])) is None
    assert thinned_objective(Objective(network, [run_of(np.zeros(TIME.size))])) is not None


LIGHT = """\
format: dashpot-network/1
name: wheel
nodes: {{platform: driven, wheel: {{mass: {mass} kg}}, body: ground}}
branches:
  tire: {{element: spring, stiffness: 200 N/mm, between: [platform, wheel]}}
  absorber: {{element: damper, damping: 3 kN*s/m, between: [wheel, body]}}
"""


@pytest.mark.parametrize("mass, kept", [(40.0, True), (0.05, False)])
def test_runs_that_take_steps_of_high_order_stay_as_they_are(mass, kept):
    network = compile_network(parse_network(LIGHT.format(mass=mass), load_registry().elements))
    run = run_of(np.zeros(TIME.size))
    run = replace(run, end="platform", whole=Excitation.of_drive(run.drive))
    sparse = thinned_objective(Objective(network, [run]))
    assert (sparse is None) == kept
