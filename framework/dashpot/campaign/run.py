"""All jobs of a campaign: what is recorded is kept, the others are done wherever there are workers."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from dashpot.campaign.declaration import CampaignSpec, Job
from dashpot.campaign.job import Outcome, Work, Write, inputs_of, run_job
from dashpot.campaign.sharing import Shared, pooled
from dashpot.fit.api import Progress, silent
from dashpot.fit.study.checkpoint import Checkpoint
from dashpot.kernel.workers import finished, result_of, threads
from dashpot.text.problem import InputError

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

KILLED = "every worker that tried it died, as where a job needs more memory than a worker has: "


@dataclass(frozen=True, eq=False)
class CampaignResult:
    """What became of every job: its outcome, or why it failed. ``shared`` are the parameters in common, by model."""

    campaign: CampaignSpec
    outcomes: Mapping[Job, Outcome]
    failures: Mapping[Job, str]
    shared: Mapping[str, Shared]


def run_campaign(
    campaign: CampaignSpec,
    *,
    jobs: Jobs = 1,
    checkpoint: Path | None = None,
    write: Write | None = None,
    progress: Progress | None = None,
) -> CampaignResult:
    """Do every job; what an earlier call left in the folder ``checkpoint`` from the same files is not done again.

    The same campaign, data and version give the same numbers, bit for bit, wherever they are worked out, as long as the
    processors are of one kind. A job that fails is set aside with its message and tried again by the next call.
    InputError when the records are of another campaign, and when a scheduler is lost; then the next call goes on.
    """
    records = Checkpoint(checkpoint)
    records.open(campaign.fingerprint)
    conduct = _Conduct(campaign, jobs, records, write, progress or silent)
    outcomes, failures = conduct.every(campaign.jobs)
    shared = {
        model.name: found
        for model in campaign.models
        if (found := pooled(model.name, campaign.shared, outcomes)) is not None
    }
    again, lost = conduct.every([job for model, found in shared.items() for job in conduct.with_common(model, found)])
    return CampaignResult(campaign, {**outcomes, **again}, {**failures, **lost}, shared)


@dataclass(frozen=True)
class _Conduct:
    campaign: CampaignSpec
    jobs: Jobs
    records: Checkpoint
    write: Write | None
    progress: Progress

    @property
    def work(self) -> Work:
        """What all jobs share."""
        write = self.write if self.campaign.reports else None
        models = {model.name: model for model in self.campaign.models}
        return Work(models, self.campaign.seed, threads(self.jobs), write)

    def every(self, asked: list[Job]) -> tuple[dict[Job, Outcome], dict[Job, str]]:
        """The outcomes in the order asked, and the reasons of those that failed."""
        found = {job.name: outcome for job in asked if (outcome := self._recorded(job)) is not None}
        left = [job for job in asked if job.name not in found]
        work, memory = self.work, self.campaign.memory
        for done, (number, future) in enumerate(finished(run_job, work, left, self.jobs, memory), 1):
            outcome = _outcome_of(future)
            if "failed" not in outcome:
                self.records.stage(left[number].name).finish(outcome)
            found[left[number].name] = outcome
            self.progress("jobs", done / len(left))
        failures = {job: found[job.name]["failed"] for job in asked if "failed" in found[job.name]}
        return {job: found[job.name] for job in asked if job not in failures}, failures

    def with_common(self, model: str, shared: Shared) -> list[Job]:
        """Every specimen once more, with the parameters held that all have in common."""
        return [
            Job(one.name, one.address, "fit", (model,), shared.values)
            for one in self.campaign.specimens
            if one.name in shared.specimens
        ]

    def _recorded(self, job: Job) -> Outcome | None:
        known = self.records.stage(job.name).result()
        now = inputs_of(job)
        if known is None or (now["files"] is not None and known["inputs"] != now):
            return None
        return known


def _outcome_of(future: Future[Outcome]) -> Outcome:
    try:
        return result_of(future)
    except InputError:
        raise
    except Exception as error:
        killed = KILLED if type(error).__name__ == "KilledWorker" else ""
        return {"failed": f"{killed}{type(error).__name__}: {' '.join(str(error).split())}"}
