"""What a campaign would cost, told from a first job of every kind."""

from __future__ import annotations

import json
import re
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dashpot.campaign.declaration import CampaignSpec, Job
from dashpot.campaign.job import Outcome, Work, Write, run_job
from dashpot.kernel.workers import pieces, threads

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

LONG = 60.0  # s of a job, beside which what its process does once is little


@dataclass(frozen=True)
class Cost:
    """A first job: how many there are of its kind, its ``seconds``, the most ``memory`` of its worker and the size of
    its ``result``, both in bytes; ``failed`` says why it did not end well."""

    job: Job
    count: int
    seconds: float
    memory: int | None
    result: int
    failed: str = ""


def preview_campaign(campaign: CampaignSpec, jobs: Jobs = 1, write: Write | None = None) -> list[Cost]:
    """Do the first job of each verb and model, with its report where ``write`` is given; nothing is kept."""
    kinds: dict[tuple[str, tuple[str, ...]], list[Job]] = {}
    for job in campaign.jobs:
        kinds.setdefault((job.verb, job.models), []).append(job)
    models = {model.name: model for model in campaign.models}
    work = Work(models, campaign.seed, threads(jobs), write if campaign.reports else None)
    first = [alike[0] for alike in kinds.values()]
    return [
        Cost(job, len(alike), seconds, memory, len(json.dumps(outcome)), outcome.get("failed", ""))
        for job, alike, (outcome, seconds, memory) in zip(
            first, kinds.values(), pieces(timed_job, work, first, jobs), strict=True
        )
    ]


def timed_job(work: Work, job: Job) -> tuple[Outcome, float, int | None]:
    """The outcome of a job, the seconds that it took, and the most memory that its process has had in bytes.

    The first job of a process loads libraries and compiles, which the others do not: a short one is timed again.
    """
    for _ in range(2):
        began = time.perf_counter()
        outcome = run_job(work, job)
        spent = time.perf_counter() - began
        if spent > LONG:
            break
    return outcome, spent, peak_memory()


def peak_memory() -> int | None:
    """The most memory that this process has had, in bytes; None where the system does not say."""
    return _of_this_program() or _of_this_process()


def _of_this_program() -> int | None:
    """Linux alone tells it; what it tells of a process begins with the memory of the one that started it."""
    try:
        found = re.search(r"^VmHWM:\s+(\d+) kB$", Path("/proc/self/status").read_text(), re.MULTILINE)
    except OSError:
        return None
    return 1024 * int(found[1]) if found else None


def _of_this_process() -> int | None:
    try:
        import resource
    except ImportError:
        return None
    return (1 if sys.platform == "darwin" else 1024) * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def preview_content(campaign: CampaignSpec, costs: Sequence[Cost], workers: int) -> dict[str, Any]:
    """What ``--dry-run`` tells, in plain values."""
    return {
        "format": "dashpot-campaign-preview/1",
        "campaign": campaign.name,
        "specimens": len(campaign.specimens),
        "workers": workers,
        "seconds": sum(cost.count * cost.seconds for cost in costs) / workers,
        "jobs": [
            {
                "verb": cost.job.verb,
                "models": list(cost.job.models),
                "count": cost.count,
                "seconds": cost.seconds,
                "memory": cost.memory,
                "result": cost.result,
                "failed": cost.failed or None,
            }
            for cost in costs
        ],
    }


def preview_text(content: dict[str, Any]) -> str:
    """What ``--dry-run`` tells on the terminal."""
    lines = [f"{content['specimens']} specimens, {sum(kind['count'] for kind in content['jobs'])} jobs"]
    for kind in content["jobs"]:
        memory = f", {kind['memory'] / 1e6:.0f} MB at most" if kind["memory"] else ""
        cost = kind["failed"] or f"{kind['seconds']:.2f} s each{memory}, {kind['result'] / 1e3:.1f} kB come back"
        lines.append(f"  {kind['count']} x {kind['verb']} {' '.join(kind['models'])}: {cost}")
    workers = f"{content['workers']} worker{'s' * (content['workers'] > 1)}"
    return "\n".join([*lines, f"about {_time(content['seconds'])} with {workers}, as the first jobs went"])


def _time(seconds: float) -> str:
    if seconds < 120.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 7200.0 else f"{seconds / 3600.0:.1f} h"
