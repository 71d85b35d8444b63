"""Pieces of work give the same in this process, in a pool and on a cluster."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from unit.pools import two_workers

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network, prepare
from dashpot.fit.bootstrap import bootstrap_intervals
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.profile import profiles
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.kernel.network import compile_network
from dashpot.kernel.workers import finished, forked, pieces, processes, spread, streamed, threads
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError

VOIGT = """\
format: dashpot-network/1
name: voigt
branches:
  rubber: {element: spring, stiffness: {start: 100 N/mm}}
  oil: {element: damper, damping: {start: 50 N*s/m}}
"""


@pytest.fixture(scope="module", params=["threads", "processes", "dask"])
def pool(request):
    """Two workers of each kind."""
    with two_workers(request.param) as made:
        yield made


@pytest.fixture(scope="module")
def measured() -> Dataset:
    """A noisy measurement of a spring and a damper."""
    time, rng = np.arange(1500) / 1000.0, np.random.default_rng(1)
    runs = []
    for number, hertz in enumerate((2.0, 5.0, 9.0)):
        x = 1e-3 * np.sin(2.0 * np.pi * hertz * time)
        force = 2e5 * x + 400.0 * np.gradient(x, time) + rng.normal(0.0, 2.0, x.size)
        runs.append(Run(f"r{number}", "dynamic", time, {"displacement": x, "force": force}, group=f"r{number}"))
    return Dataset("rig", tuple(runs))


@pytest.fixture(scope="module")
def fitted(measured):
    """An objective near its minimum."""
    setting = prepare(measured)
    scored = list(setting.scored.values())
    spec = with_ranges(parse_network(VOIGT, load_registry().elements), natural_sizes(scored))
    coordinates = search_coordinates(spec)
    truth = {"rubber.stiffness": 2e5, "oil.damping": 400.0}
    point = np.array(
        [
            np.log(truth[path]) if log else truth[path]
            for path, log in zip(coordinates.paths, coordinates.log, strict=True)
        ]
    )
    return Objective(compile_network(spec), scored, 2), coordinates, point


def halved(shared: float, one: float) -> float:
    if one < 0.0:
        raise ValueError(f"{one} is below 0")
    return one / shared


def test_processes_give_the_same_and_end_with_the_block():
    before = multiprocessing.active_children()
    with processes(2) as pool:
        assert pieces(halved, 2.0, [6.0, 4.0], pool) == [3.0, 2.0]
    assert multiprocessing.active_children() == before


def test_processes_of_a_block_that_is_interrupted_do_not_go_on():
    before = multiprocessing.active_children()
    with pytest.raises(KeyboardInterrupt), processes(2) as pool:
        assert pool.submit(abs, -1).result() == 1
        pool.submit(time.sleep, 3600.0)
        raise KeyboardInterrupt
    for child in set(multiprocessing.active_children()) - set(before):
        child.join(60.0)
    assert multiprocessing.active_children() == before


def test_pieces_come_in_their_order(pool):
    assert pieces(halved, 2.0, [6.0, 4.0, 8.0], pool) == pieces(halved, 2.0, [6.0, 4.0, 8.0], 2) == [3.0, 2.0, 4.0]


def test_what_fails_raises_its_error(pool):
    with pytest.raises(ValueError, match="below 0"):
        pieces(halved, 2.0, [1.0, -1.0], pool)
    outcomes = {number: future.exception() for number, future in finished(halved, 2.0, [1.0, -1.0], pool)}
    assert outcomes[0] is None and isinstance(outcomes[1], ValueError)


def test_a_pool_gives_each_piece_one_thread(pool):
    assert threads(pool) == 1 and threads(3) == 3


@pytest.mark.parametrize("work", [spread, streamed])
@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_threads_answer_in_order_and_hand_on_errors(work, jobs):
    for count in range(6):
        assert list(work(lambda number: number**2, range(count), jobs)) == [number**2 for number in range(count)]
    with pytest.raises(ZeroDivisionError):
        list(work(lambda number: 1 // number, [1, 0, 2, 3], jobs))
    assert list(work(str, [1], jobs)) == ["1"]


def test_what_threads_do_is_not_spread_once_more():
    def names(_):
        time.sleep(0.01)
        return spread(lambda _: threading.current_thread().name, range(4), 2)

    found = spread(names, range(4), 2)
    assert all(len(set(each)) == 1 for each in found)
    assert 1 < len({each[0] for each in found}) <= 2 and threading.current_thread().name not in found[0]


INTERRUPTED = """\
import threading
from dashpot.kernel.workers import spread
start = threading.Thread.start
def interrupted(self):
    start(self)
    raise KeyboardInterrupt
threading.Thread.start = interrupted
try:
    spread(abs, [-1, -2, -3], 2)
except KeyboardInterrupt:
    threading.Thread.start = start
"""


@pytest.mark.parametrize("then, answer", [("", ""), ("print(spread(abs, [-1, -2, -3], 2))", "[1, 2, 3]\n")])
def test_a_key_that_interrupts_while_a_thread_begins_does_not_keep_the_process(then, answer):
    """The pool does not know such a thread, which then waits for work for ever; the next one has new threads."""
    command = [sys.executable, "-c", INTERRUPTED + then]
    assert subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout == answer


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="there is no fork here")
def test_a_forked_process_has_threads_of_its_own():
    spread(lambda _: time.sleep(0.02), range(2), 2)
    time.sleep(0.02)  # both wait for work
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply_async(_spread_there).get(timeout=30) == ["0", "1", "2"]


def _spread_there():
    return spread(str, range(3), 2)


@pytest.mark.parametrize("jobs", [1, 2, 8])
def test_forks_answer_in_order_and_send_back_what_is_shared(jobs):
    marks = [object() for _ in range(5)]  # no two of them are equal, and a copy of one is none of them
    found = forked(lambda number: (number**2, marks[number]), range(5), jobs, marks)
    assert [square for square, _ in found] == [0, 1, 4, 9, 16]
    assert all(mark is mine for (_, mark), mine in zip(found, marks, strict=True))


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nothing is forked")
def test_forks_work_side_by_side_and_keep_what_they_change():
    changed = []

    def work(number: int) -> tuple[int, int]:
        changed.append(number)
        time.sleep(0.2)
        inside = forked(lambda one: os.getpid(), range(2), 2)  # is not forked once more
        return os.getpid(), len({os.getpid(), *inside})

    found = forked(work, range(4), 2)
    others = {process for process, _ in found}
    assert os.getpid() not in others and len(others) == 2 and not changed
    assert [many for _, many in found] == [1, 1, 1, 1]


@pytest.mark.parametrize("jobs", [1, 2])
def test_what_fails_in_a_fork_raises_its_error(jobs):
    def work(number: int) -> float:
        return 1.0 / (number - 1)

    with pytest.raises(ZeroDivisionError):
        forked(work, range(3), jobs)
    ends = time.monotonic() + 10.0
    while multiprocessing.active_children():
        assert time.monotonic() < ends, "a fork goes on"
        time.sleep(0.01)


@pytest.mark.parametrize("wrong", [0, -1, True, "four", None])
def test_what_cannot_work_is_refused(wrong):
    with pytest.raises(InputError, match="expected a number of threads, an Executor or a Dask client"):
        threads(wrong)


def test_a_fit_is_the_same_bits_everywhere(pool, measured):
    registry = load_registry()
    spec = parse_network(VOIGT, registry.elements)
    here, there = (fit_network(spec, measured, registry=registry, jobs=jobs) for jobs in (1, pool))
    assert there.as_dict() == here.as_dict() and there.identified_text == here.identified_text
    assert np.array_equal(there.correlation, here.correlation)


def test_bootstrap_and_profiles_are_the_same_bits_everywhere(pool, fitted):
    groups = [("dynamic", str(number)) for number in range(3)]
    here = bootstrap_intervals(*fitted, groups, 4, 7)
    assert bootstrap_intervals(*fitted, groups, 4, 7, pool) == here
    assert here[0] == pytest.approx((2e5, 2e5), rel=1e-3) and here[0][0] < here[0][1]
    assert profiles(*fitted, [0, 1], jobs=pool) == profiles(*fitted, [0, 1])
