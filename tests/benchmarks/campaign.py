"""What the jobs of a campaign cost: ``python tests/benchmarks/campaign.py``.

Virtual bushings are fitted, and diagnosed, with one and two local workers in turn: see the load that is printed. Where
other programs are at work the clock tells little, and processor time tells more: t1 and t2 of a job with one worker and
with two, which differ where workers are in each other's way; o of all that client, scheduler and worker do for a job
that does nothing; and the share b of a processor that a worker with its part of client and scheduler takes all the
time. The efficiency of two workers from these is t1 / (t2 (1 + b) + o). It is a lower bound for processors of one's
own: a worker is taken to wait for all of o, though most of it is done while others work.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from distributed import Client
from unit.campaign.bushings import draw_population, write_population

from dashpot import load_registry
from dashpot.campaign.declaration import CampaignSpec, Job
from dashpot.campaign.job import Outcome, Work, run_job
from dashpot.campaign.preview import peak_memory
from dashpot.campaign.reading import read_campaign
from dashpot.campaign.scheduler import scheduled
from dashpot.data.dataset import read_dataset
from dashpot.kernel.workers import finished

NOTHING = 1000  # jobs that do nothing
REST = 20.0  # s
PLANS = (("diagnose", 1_000), ("fit", 10_000))
WORKERS = (1, 2, 10, 100, 1000)


@dataclass(frozen=True)
class Turn:
    """All jobs once: by the clock, and the processor time of a job, in s; memory and size of a result in bytes."""

    workers: int
    clock: float
    job: float
    memory: int
    result: int


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--specimens", type=int, default=40)
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--verbs", nargs="*", default=["fit", "diagnose"])
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        file = write_population(Path(folder), draw_population(1, options.specimens), 1)
        campaign = replace(read_campaign(file, load_registry()), reports=False)
        reading(campaign)
        with scheduled("local:2") as client:
            around = overhead(client), idle(client)
        for verb in options.verbs:
            turns = list(taken(replace(campaign, verbs=(verb,)), options.turns))
            report(verb, len(campaign.jobs), turns, *around)


def taken(campaign: CampaignSpec, count: int) -> Iterator[Turn]:
    """One worker and two in turn, so that both meet the same other programs."""
    for _ in range(count):
        for workers in (1, 2):
            with scheduled(f"local:{workers}") as client:
                client.run(run_job, work_of(campaign), campaign.jobs[0])
                yield turn(campaign, client)


def work_of(campaign: CampaignSpec) -> Work:
    """What all jobs share."""
    return Work({model.name: model for model in campaign.models}, campaign.seed)


def turn(campaign: CampaignSpec, client: Client) -> Turn:
    """Every job once on a client's workers."""
    workers, jobs = len(client.nthreads()), campaign.jobs
    began = time.perf_counter()
    told = [future.result() for _, future in finished(weighed, work_of(campaign), jobs, client)]
    clock = time.perf_counter() - began
    outcomes, by_processor, memory = zip(*told, strict=True)
    if failed := [outcome["failed"] for outcome in outcomes if "failed" in outcome]:
        raise RuntimeError(f"{len(failed)} jobs failed, the first with: {failed[0]}")
    found = Turn(
        workers,
        clock,
        sum(by_processor) / len(jobs),
        max(memory),
        max(len(json.dumps(outcome)) for outcome in outcomes),
    )
    print(
        f"  {workers} worker{'s' * (workers > 1)}: {clock:.1f} s by the clock, load {os.getloadavg()[0]:.1f}; "
        f"a job {1e3 * found.job:.0f} ms of processor time",
        flush=True,
    )
    return found


def processor_time(client: Client) -> float:
    """That of the client with its scheduler, and of all workers, in s."""
    return time.process_time() + sum(client.run(time.process_time).values())


def weighed(work: Work, job: Job) -> tuple[Outcome, float, int]:
    """A job with the processor time of its one thread in s, and the most memory that its process has had."""
    before = time.thread_time()
    outcome = run_job(work, job)
    return outcome, time.thread_time() - before, peak_memory() or 0


def report(verb: str, count: int, turns: Sequence[Turn], nothing: float, share: float) -> None:
    """Print the efficiency of two workers, and what the plan comes to with it."""
    one, two = ([each for each in turns if each.workers == workers] for workers in (1, 2))
    alone, side = (median(each.job for each in some) for some in (one, two))
    whole = side * (1.0 + share) + nothing
    by_clock = sorted(a.clock / (2.0 * b.clock) for a, b in zip(one, two, strict=True))
    print(
        f"{count} x {verb}: a job {1e3 * alone:.0f} ms of processor time, beside another one {1e3 * side:.0f} ms, "
        f"with all around it {1e3 * whole:.0f} ms: efficiency of 2 workers {alone / whole:.3f}; "
        f"by the clock {', '.join(f'{each:.2f}' for each in by_clock)}; a worker has "
        f"{max(each.memory for each in turns) / 1e6:.0f} MB at most, a result {max(each.result for each in turns)} B"
    )
    for planned, jobs in PLANS:
        if planned == verb:
            hours = {workers: jobs * whole / workers / 3600.0 for workers in WORKERS}
            print(f"{jobs} x {verb}: " + ", ".join(f"{each:.3g} h with {workers}" for workers, each in hours.items()))


def overhead(client: Client) -> float:
    """The processor time in s that a job costs which does nothing."""
    began, before = time.perf_counter(), processor_time(client)
    done = sum(1 for _ in finished(do_nothing, None, range(NOTHING), client))
    clock, spent = time.perf_counter() - began, processor_time(client) - before
    print(
        f"  {done} jobs that do nothing, {len(client.nthreads())} workers: "
        f"{1e3 * clock / done:.2f} ms each by the clock, {1e3 * spent / done:.2f} ms of processor time",
        flush=True,
    )
    return spent / done


def idle(client: Client) -> float:
    """The share of a processor that each worker takes without any job, with its part of client and scheduler."""
    before = processor_time(client)
    time.sleep(REST)
    share = (processor_time(client) - before) / REST / len(client.nthreads())
    print(f"  without jobs {100.0 * share:.1f} % of a processor for each of 2 workers", flush=True)
    return share


def do_nothing(_: Any, number: int) -> int:
    """A job that does nothing."""
    return number


def reading(campaign: CampaignSpec) -> None:
    """Print how long a dataset takes to be read, and how large it is."""
    readers = {word: reader() for word, reader in load_registry().formats.items()}
    began = time.process_time()
    for one in campaign.specimens:
        read_dataset(one.data, readers)
    spent = (time.process_time() - began) / len(campaign.specimens)
    size = sum(path.stat().st_size for path in Path(campaign.specimens[0].data).iterdir())
    print(f"reading: {size / 1e3:.0f} kB in {1e3 * spent:.1f} ms of processor time from a warm disk")


if __name__ == "__main__":
    main()
