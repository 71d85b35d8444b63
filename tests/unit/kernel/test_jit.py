"""Networks as functions for somebody's own compiled code."""

from __future__ import annotations

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numba import njit
from unit.kernel.networks import network

from dashpot.data.drive import drive_from_path
from dashpot.kernel.jit import Solver, jit_network
from dashpot.kernel.network import compile_network
from dashpot.text.problem import InputError

MOUNT = """
rubber: {element: spring, stiffness: 220 N/mm}
friction: {element: dahl, stiffness: 900 N/mm, limit: 60 N}
relaxation: {element: maxwell, stiffness: 150 N/mm, relaxation_time: 20 ms}
"""
LEG = """
rubber: {element: spring, stiffness: 220 N/mm}
leg: {series: {valve: {element: damper, damping: 2 N*s/mm}, bush: {element: spring, stiffness: 900 N/mm}}}
"""
STEP, SAMPLES = 1e-3, 300
PHASE = 60.0 * STEP * np.arange(SAMPLES)
PLACE, SPEED = 2e-3 * np.sin(PHASE), 0.12 * np.cos(PHASE)


@pytest.fixture(scope="module")
def solver() -> Solver:
    return jit_network(network(MOUNT))


def simulated(found: Solver, numbers: np.ndarray) -> np.ndarray:
    out = np.empty(SAMPLES)
    found.simulate(PLACE, SPEED, STEP, numbers, out)
    return out


def test_a_loop_of_ones_own_steps_as_a_whole_record_is_simulated(solver):
    step = solver.step

    @njit
    def loop(state, numbers, x, v, out):
        for k in range(x.size):
            out[k] = step(state, x[k], v[k], STEP, numbers)

    out = np.empty(SAMPLES)
    loop(solver.state(), solver.parameters, PLACE, SPEED, out)
    # the step is compiled into the loop, where a compiler may join other products and sums
    expected = simulated(solver, solver.parameters)
    assert np.max(np.abs(out - expected)) <= 1e-14 * np.max(np.abs(expected))


def test_a_record_has_the_force_of_the_kernel(solver):
    compiled = compile_network(network(MOUNT))
    drive = drive_from_path(STEP, PLACE, SPEED, np.zeros(SAMPLES))
    expected = compiled.simulate(compiled.prepare(drive))
    assert simulated(solver, solver.parameters) == pytest.approx(expected, rel=1e-12, abs=1e-12 * np.ptp(expected))


def test_inertia_feels_the_acceleration_of_the_cubics():
    found = jit_network(network("mass: {element: inerter, inertance: 3 kg}"))
    bends = (6.0 * (PLACE[:-1] - PLACE[1:]) / STEP + 2.0 * SPEED[:-1] + 4.0 * SPEED[1:]) / STEP
    assert simulated(found, found.parameters)[1:] == pytest.approx(3.0 * bends, rel=1e-9, abs=1e-9)


def test_numbers_have_names_and_move_the_force(solver):
    assert solver.names == compile_network(network(MOUNT)).paths
    numbers = solver.parameters.copy()
    numbers[solver.names.index("rubber.stiffness")] += 1e5
    more = simulated(solver, numbers) - simulated(solver, solver.parameters)
    assert more == pytest.approx(1e5 * PLACE, abs=1e-9)


def test_a_tangent_is_the_slope_of_the_force_and_moves_nothing(solver):
    state, other = solver.state(), solver.state()
    for k in range(100):
        solver.step(state, PLACE[k], SPEED[k], STEP, solver.parameters)
        solver.step(other, PLACE[k], SPEED[k], STEP, solver.parameters)
    force, by_place, by_speed = solver.tangent_step(state, PLACE[100], SPEED[100], STEP, solver.parameters)
    assert force == solver.step(other, PLACE[100], SPEED[100], STEP, solver.parameters)
    assert np.array_equal(state, other)
    # the spring and the Maxwell element follow at once, friction adds no more than its own stiffness
    assert 220e3 < by_place < 220e3 + 900e3 + 150e3 and abs(by_speed) * SPEED[100] < 1e3


def test_threads_with_states_of_their_own_do_not_feel_each_other(solver):
    lanes = [solver.parameters * share for share in np.linspace(0.5, 2.0, 16)]
    alone = [simulated(solver, numbers) for numbers in lanes]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda numbers: simulated(solver, numbers), lanes))
    assert np.array_equal(alone, together)


def test_inner_nodes_are_answered_behind_the_force():
    found = jit_network(network(LEG))
    assert (found.driven, found.free) == (("",), ("leg:1",))
    state, out = found.state(span=4e-3), np.empty(2)
    nothing = np.empty(0)
    for k in range(50):
        found.step_nodes(state, PLACE[k : k + 1], SPEED[k : k + 1], nothing, STEP, found.parameters, out)
    # the bush, between the inner node and the ground, carries what the leg does
    assert out[0] - 220e3 * PLACE[49] == pytest.approx(900e3 * out[1], rel=1e-6)


def test_another_process_compiles_nothing(solver):
    code = f"""
import sys
sys.path[:0] = {sys.path!r}
from unit.kernel.networks import network
from dashpot.kernel.jit import jit_network
import numpy as np
found = jit_network(network({MOUNT!r}))
found.simulate(np.zeros(9), np.zeros(9), 1e-3, found.parameters, np.empty(9))
print(sum(found.simulate.stats.cache_misses.values()), sum(found.simulate.stats.cache_hits.values()))
"""
    simulated(solver, solver.parameters)
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.split() == ["0", "1"]


def test_a_curve_without_numbers_is_told():
    import dashpot as dp

    with pytest.raises(InputError, match="the curve 'stiffness.stiffness' is to be taken from data"):
        dp.load("gehmann").jit()
