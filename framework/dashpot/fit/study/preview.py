"""What the planned data can and cannot identify, before anything is searched."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from dashpot.data.dataset import Dataset
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.identifiability import Identifiability, identifiability
from dashpot.fit.noise_of_runs import noise_of_runs
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.study.declaration import StudySpec, TakeStage
from dashpot.fit.study.run import take_numbers
from dashpot.fit.study.setting import restricted, run_weights, study_setting
from dashpot.kernel.network import compile_network

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs


@dataclass(frozen=True)
class Preview:
    """The identifiability of a model from the training runs at its start values; ``noise``: its floor in N."""

    model: str
    budget: int
    noise: float
    known: Identifiability


@single_threaded_algebra
def preview_study(study: StudySpec, dataset: Dataset, jobs: Jobs = 1) -> list[Preview]:
    """One preview for each model. Raises InputError as `run_study` does."""
    whole = study_setting(study, dataset)
    previews = []
    for plan in study.models:
        setting = restricted(whole, plan)
        spec = plan.network
        if any(isinstance(stage, TakeStage) for stage in plan.stages) or spec.data_curves():
            spec = take_numbers(spec, "curves", setting.train)
        spec = with_ranges(spec, natural_sizes(setting.train))
        coordinates = search_coordinates(spec)
        objective = Objective(compile_network(spec), setting.train, jobs, weights=run_weights(study, setting.train))
        noise = noise_of_runs(setting.dataset.runs, setting.floor)
        found = identifiability(objective, coordinates, coordinates.start, noise)
        previews.append(Preview(plan.name, plan.budget, setting.floor.value or 1.0, found))
    return previews
