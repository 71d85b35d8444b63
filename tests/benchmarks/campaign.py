"""What campaigns cost: ``python tests/benchmarks/campaign.py``.

Forty virtual bushings are fitted, and some of them diagnosed, with one and two local workers. Where other programs are
at work the clock tells little; the share of the time in which workers were busy is what scheduler and transport leave.
Jobs that only wait go through a scheduler with 10 and 100 workers, all of them in this process, which takes
their share of its time away from the scheduler: a scheduler with a processor of its own does better.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from distributed import Client, LocalCluster
from unit.campaign.bushings import draw_population, write_population

from dashpot import load_registry
from dashpot.campaign.declaration import CampaignSpec
from dashpot.campaign.job import Work, run_job
from dashpot.campaign.preview import timed_job
from dashpot.campaign.reading import read_campaign
from dashpot.data.dataset import read_dataset
from dashpot.kernel.workers import finished
from dashpot.model.reading import read_network

SMALL = 1000  # jobs that do nothing
WAIT = 1.0  # s that a job waits in the simulation
PLANS = (("diagnose", 1_000), ("fit", 10_000))


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--specimens", type=int, default=40)
    parser.add_argument("--diagnosed", type=int, default=8)
    parser.add_argument("--workers", type=int, nargs="*", default=[10, 100])
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        file = write_population(Path(folder), draw_population(1, options.specimens), 1)
        fits = replace(read_campaign(file, load_registry()), reports=False)
        few = fits.specimens[: options.diagnosed]
        model = read_network("kelvin_voigt", load_registry().elements)
        works = {"fit": fits, "diagnose": replace(fits, specimens=few, models=(model,), verbs=("diagnose",))}
        seconds = {verb: measured(verb, campaign) for verb, campaign in works.items()}
        reading(fits)
    for verb, count in PLANS:
        one, efficiency = seconds[verb]
        hours = {workers: count * one / (workers * efficiency) / 3600.0 for workers in (1, 2, 10, 100)}
        told = ", ".join(f"{each:.2f} h with {workers}" for workers, each in hours.items())
        print(f"{count} x {verb}: {told} workers of this kind")
    for workers in options.workers:
        simulated(workers)


def measured(verb: str, campaign: CampaignSpec) -> tuple[float, float]:
    """Seconds of a job on one worker, and the efficiency of two."""
    clock, busy = zip(*(timed(campaign, workers) for workers in (1, 2)), strict=True)
    count, efficiency = len(campaign.jobs), clock[0] / (2.0 * clock[1])
    print(
        f"{count} x {verb}: {clock[0]:.2f} s with one worker, {clock[1]:.2f} s with two, efficiency "
        f"{efficiency:.2f}; {1e3 * clock[0] / count:.0f} ms each; "
        f"workers were busy {busy[0]:.3f} and {busy[1]:.3f} of the time"
    )
    return clock[0] / count, efficiency


def timed(campaign: CampaignSpec, workers: int) -> tuple[float, float]:
    """Seconds for all jobs, on workers that have done one before, and the share of it in which these were busy."""
    work = Work({model.name: model for model in campaign.models}, campaign.seed)
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        client.run(run_job, work, campaign.jobs[0])
        began = time.perf_counter()
        jobs = [future.result() for _, future in finished(timed_job, work, campaign.jobs, client)]
        spent = time.perf_counter() - began
        if workers == 2:
            overhead(client)
            memory, size = max(job[2] or 0 for job in jobs), max(len(json.dumps(job[0])) for job in jobs)
            print(f"a worker has at most {memory / 1e6:.0f} MB; a result is {size / 1e3:.1f} kB")
        return spent, sum(job[1] for job in jobs) / (workers * spent)


def overhead(client: Client) -> None:
    """Print what a job costs that does nothing."""
    began = time.perf_counter()
    done = sum(1 for _ in finished(nothing, None, list(range(SMALL)), client))
    spent = time.perf_counter() - began
    print(f"{done} jobs that do nothing, 2 workers: {1e3 * spent / done:.2f} ms each")


def nothing(_: Any, number: int) -> int:
    """A job that does nothing."""
    return number


def wait(seconds: float, number: int) -> dict[str, Any]:
    """A job that waits, with a result of an ordinary size."""
    time.sleep(seconds)
    return {"number": number, "text": "x" * 2_000}


def reading(campaign: CampaignSpec) -> None:
    """Print how long a dataset takes to be read, and how large it is."""
    readers = {word: reader() for word, reader in load_registry().formats.items()}
    began = time.perf_counter()
    for one in campaign.specimens:
        read_dataset(one.data, readers)
    spent = (time.perf_counter() - began) / len(campaign.specimens)
    size = sum(path.stat().st_size for path in Path(campaign.specimens[0].data).iterdir())
    print(f"reading: {size / 1e3:.0f} kB in {1e3 * spent:.1f} ms from a warm disk")


def simulated(workers: int) -> None:
    """Print how a scheduler keeps so many workers busy with jobs that wait."""
    jobs = 5 * workers
    began = time.perf_counter()
    with (
        LocalCluster(
            n_workers=workers, threads_per_worker=1, processes=False, dashboard_address=None, silence_logs=50
        ) as cluster,
        Client(cluster) as client,
    ):
        client.wait_for_workers(workers)
        started = time.perf_counter() - began
        began = time.perf_counter()
        done = sum(1 for _ in finished(wait, WAIT, list(range(jobs)), client))
        spent = time.perf_counter() - began
        ideal = done * WAIT / workers
        print(
            f"{workers} workers, {done} jobs of {WAIT:g} s: {spent:.2f} s where {ideal:.2f} s are ideal, "
            f"{1e3 * (spent - ideal) / done:.2f} ms each more; {done / spent:.0f} jobs/s; "
            f"workers stood after {started:.0f} s",
            flush=True,
        )


if __name__ == "__main__":
    main()
