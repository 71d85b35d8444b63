"""What ends a campaign on many workers: ``python tests/benchmarks/campaign_limits.py``.

A scheduler in a process of its own, and 10, 100 and 1000 workers of Dask in a few other ones, go through jobs that wait
instead of working, with results of the size that fits have. What does not depend on how many processors the machine has
to spare is the processor time of the scheduler and of the client for a job; the clock of the whole includes that of
workers which here share one machine.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import resource
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import dask
import psutil
from distributed import Client, Worker

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from dashpot.fit.study.checkpoint import Checkpoint
from dashpot.kernel.workers import finished

AT_ONCE = 1000  # jobs that take no time, at least
RESULT = 1200  # bytes, as of a fit
A_PROCESS = 250  # workers
PATIENCE = 1800.0  # s
# hundreds of workers that share a machine answer late
LATE = {"DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "1800s", "DASK_DISTRIBUTED__SCHEDULER__WORKER_TTL": "null"}
# what a worker tells about itself beside its jobs; with hundreds in one process it would be all that they do
QUIET = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.system-monitor.interval": "60s",
    "distributed.worker.memory.target": False,
    "distributed.worker.memory.spill": False,
    "distributed.worker.memory.pause": False,
    "distributed.worker.memory.terminate": False,
}


async def wait(seconds: float, number: int) -> dict[str, Any]:
    """A job that waits, with a result of an ordinary size."""
    await asyncio.sleep(seconds)
    return {"number": number, "text": "x" * RESULT}


async def host(address: str, count: int) -> None:
    """So many workers in this process, as long as it lasts."""
    with dask.config.set(QUIET), TemporaryDirectory() as folder:
        workers = [
            Worker(address, nthreads=1, dashboard=False, local_directory=folder, name=f"{os.getpid()}-{k}")
            for k in range(count)
        ]
        await asyncio.gather(*workers)
        await asyncio.Event().wait()


@contextmanager
def cluster(count: int) -> Iterator[tuple[Client, psutil.Process]]:
    """A client of a scheduler with so many workers, and the process of the scheduler."""
    with TemporaryDirectory() as folder, ExitStack() as processes:
        file = Path(folder) / "scheduler.json"
        words = ["scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", str(file)]
        scheduler = processes.enter_context(started("-m", "dask", *words))
        wait_for(file.exists)
        client = processes.enter_context(Client(scheduler_file=str(file), set_as_default=False))
        address = client.scheduler.address
        for first in range(0, count, A_PROCESS):
            processes.enter_context(started(__file__, "--host", address, str(min(A_PROCESS, count - first))))
        wait_for(lambda: client.run_on_scheduler(_workers) == count)
        yield client, psutil.Process(scheduler.pid)


def _workers(dask_scheduler: Any) -> int:
    return len(dask_scheduler.workers)


@contextmanager
def started(*words: str) -> Iterator[subprocess.Popen[bytes]]:
    """A process of Python that ends with the block."""
    quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    process = subprocess.Popen([sys.executable, *words], env={**os.environ, **LATE}, **quiet)
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def wait_for(done: Any) -> None:
    """Until something is true. TimeoutError where that takes too long."""
    deadline = time.monotonic() + PATIENCE
    while not done():
        if time.monotonic() > deadline:
            raise TimeoutError("the workers did not come up")
        time.sleep(1.0)


def busy(process: psutil.Process) -> float:
    """The processor time of a process in s."""
    spent = process.cpu_times()
    return spent.user + spent.system


def measured(client: Client, scheduler: psutil.Process, jobs: int, seconds: float) -> tuple[float, float, float]:
    """Seconds by the clock for all jobs, and the processor time of scheduler and client for each."""
    me = psutil.Process()
    with TemporaryDirectory() as folder:
        records = Checkpoint(Path(folder))
        before, mine, began = busy(scheduler), busy(me), time.perf_counter()
        for number, future in finished(wait, seconds, range(jobs), client):
            records.stage(str(number)).finish(future.result())
        spent = time.perf_counter() - began
    return spent, (busy(scheduler) - before) / jobs, (busy(me) - mine) / jobs


def idle(scheduler: psutil.Process, seconds: float) -> float:
    """The share of a processor that a scheduler takes without any job."""
    before = busy(scheduler)
    time.sleep(seconds)
    return (busy(scheduler) - before) / seconds


def report(count: int, rounds: int, seconds: float) -> None:
    """Print what so many workers ask of a scheduler."""
    began = time.perf_counter()
    with cluster(count) as (client, scheduler):
        print(f"{count} workers stood after {time.perf_counter() - began:.0f} s", flush=True)
        rest = idle(scheduler, 10.0)
        for length in (0.0, seconds):
            jobs = rounds * count if length else max(count, AT_ONCE)
            spent, theirs, mine = measured(client, scheduler, jobs, length)
            theirs -= rest * spent / jobs
            ideal = length * jobs / count
            print(
                f"  {jobs} jobs of {length:g} s: {spent:.1f} s where {ideal:.1f} s are ideal, "
                f"{jobs / spent:.0f} jobs/s; processor time of a job: "
                f"scheduler {1e3 * theirs:.2f} ms, client {1e3 * mine:.2f} ms",
                flush=True,
            )
        memory = scheduler.memory_info().rss
        print(f"  scheduler: {100.0 * rest:.1f} % of a processor without jobs, {memory / 1e6:.0f} MB", flush=True)


def main() -> None:
    """Measure and print, or be the workers."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--workers", type=int, nargs="*", default=[10, 100, 1000])
    parser.add_argument("--rounds", type=int, default=3, help="jobs for each worker")
    parser.add_argument("--seconds", type=float, default=10.0, help="how long a job waits")
    parser.add_argument("--host", nargs=2, metavar=("ADDRESS", "COUNT"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.host:
        asyncio.run(host(options.host[0], int(options.host[1])))
        return
    # a scheduler has a connection or two open with each worker
    most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    print(f"{most} files may be open at once")
    for count in options.workers:
        report(count, options.rounds, options.seconds)


if __name__ == "__main__":
    main()
