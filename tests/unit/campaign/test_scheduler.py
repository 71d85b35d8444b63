"""Workers by a word: local ones with their memory, and what is told of a scheduler that will not do."""

from __future__ import annotations

import time

import pytest

from dashpot.campaign.scheduler import scheduled
from dashpot.kernel.workers import MEMORY, finished
from dashpot.text.problem import InputError

distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")

GB = 1e9
PATIENCE = 20.0


def doubled(_: None, number: int) -> int:
    return 2 * number


@pytest.mark.parametrize(
    ("word", "told"),
    [
        ("eight", "expected local:N or the address of a scheduler"),
        ("local:none", "expected a number of workers as in local:8"),
        ("local:0", "expected a number of workers as in local:8"),
    ],
)
def test_a_word_that_is_no_scheduler_is_told(word, told):
    with pytest.raises(InputError, match=told), scheduled(word):
        pass


def test_local_workers_have_one_thread_and_the_memory_of_a_job():
    with scheduled("local:1", GB) as client:
        [worker] = client.scheduler_info(n_workers=-1)["workers"].values()
        assert (worker["nthreads"], worker["memory_limit"], worker["resources"]) == (1, int(GB), {MEMORY: GB})
        assert sorted(future.result() for _, future in finished(doubled, None, [1, 2, 3], client, GB)) == [2, 4, 6]


def test_a_job_that_no_worker_has_the_memory_for_is_refused():
    local = {"n_workers": 1, "processes": False, "protocol": "tcp://", "dashboard_address": None}
    with distributed.LocalCluster(**local, memory_limit=GB) as cluster:
        with pytest.raises(InputError, match=r"expected a worker with 4e\+09 B .* got at most 1e\+09 B"):
            with scheduled(cluster.scheduler_address, 4.0 * GB):
                pass


def test_a_result_that_was_handed_out_is_not_kept_by_its_worker():
    local = {"n_workers": 1, "threads_per_worker": 1, "processes": False, "dashboard_address": None}
    with distributed.Client(**local) as client:
        for count, (_, future) in enumerate(finished(doubled, None, range(12), client), 1):
            assert future.result() % 2 == 0
            if count == 12:
                # what all share, and at most the last result
                deadline = time.monotonic() + PATIENCE
                while (kept := sum(map(len, client.has_what().values()))) > 2 and time.monotonic() < deadline:
                    time.sleep(0.01)
                assert kept <= 2
