"""What a study found, as it is written down and as a report shows it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from dashpot.compare.comparison import Comparison
from dashpot.fit.identifiability import Identifiability
from dashpot.fit.study.declaration import ModelPlan
from dashpot.fit.study.preview import Preview
from dashpot.fit.study.run import ModelResult, StudyResult
from dashpot.fit.study.stage import StageResult
from dashpot.study.axle_study import axle_content, axle_evidence, model_content
from dashpot.study.ladder import ladder_of
from dashpot.study.masses import identified_masses
from dashpot.study.references import references_content


def comparison_of(result: StudyResult) -> Comparison:
    """The models of a study side by side that are about the same runs as its last one."""
    last = result.models[-1].setting
    family = [model.fit for model in result.models if model.setting.dataset.digest == last.dataset.digest]
    return Comparison(last, tuple(family), {}, result.study.seed, metrics=result.metrics)


def study_content(result: StudyResult, comparison: Comparison | None = None) -> dict[str, Any]:
    """The result as in ``study.json``: a comparison, and for each model its stages and how well it is known.

    A ``comparison`` of the same result that is given has simulated its models once for all that is told of them.
    """
    content = (comparison or comparison_of(result)).as_dict()
    family = [model["name"] for model in content["models"]]
    plans = {plan.name: plan for plan in result.study.models}
    models = [
        {**_row(model, result.study.seed), **_model(model), **model_content(model)}
        | _declared(plans[model.fit.declared.name])
        for model in result.models
    ]
    study = {
        "name": result.study.name,
        "about": result.study.about,
        "budget": result.study.budget,
        "amplitude": result.study.amplitude,
        "compared": family,
    }
    axle = axle_content(result.models)
    references = _references(result, models)
    masses = identified_masses(models, result.models[-1].setting.floor.value, references)
    return {
        **content,
        "format": "dashpot-study-result/1",
        "study": study,
        "models": models,
        "axle": axle,
        "references": references,
        "ladder": ladder_of([model for model in models if model["name"] in family]),
        "masses": masses,
    }


def study_evidence(result: StudyResult, comparison: Comparison | None = None) -> Any:
    """Arrays and texts for the report: those of the comparison, and those of an axle; see ``study_content``."""
    evidence = (comparison or comparison_of(result)).evidence()
    return evidence | axle_evidence(result.models, evidence["dynamic_stiffness"])


def _references(result: StudyResult, models: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    networks = [model.fit.fitted for model in result.models]
    return references_content(result.setting.dataset.references.values(), networks, models)


def preview_content(name: str, previews: Sequence[Preview]) -> dict[str, Any]:
    """What ``--dry-run`` tells, in plain values."""
    return {
        "format": "dashpot-study-preview/1",
        "study": name,
        "models": [
            {"name": each.model, "budget": each.budget, "noise": each.noise, "identifiability": _known(each.known)}
            for each in previews
        ],
    }


def preview_text(previews: Sequence[Preview]) -> str:
    """What ``--dry-run`` tells on the terminal."""
    blocks = []
    for each in previews:
        count, firm = len(each.known.deviations) + len(each.known.idle), len(each.known.firm)
        head = f"{each.model}: {firm} of {count} parameters can be determined to better than 10 %"
        cost = f"at most {each.budget} parameter vectors" if each.budget else "nothing to search"
        blocks.append("\n".join([f"{head}; {cost}", *(f"  {text}" for text in each.known.sentences)]))
    noise = "At the start values, with coloured noise of {:.3g} N, its correlation estimated from the records."
    noise = noise.format(previews[0].noise) if previews else ""
    return "\n".join([*blocks, noise])


def _declared(plan: ModelPlan) -> dict[str, Any]:
    return {"start_from": plan.start_from, "parts": dict(plan.parts)}


def _row(model: ModelResult, seed: int) -> dict[str, Any]:
    row: dict[str, Any] = Comparison(model.setting, (model.fit,), {}, seed).as_dict()["models"][0]
    return row


def _model(model: ModelResult) -> dict[str, Any]:
    fit = model.fit
    return {
        "masses": _masses(model),
        "held_out": list(model.setting.split.held_out),
        "optimizer": fit.optimizer,
        "evaluations": fit.evaluations,
        "at_bound": list(fit.at_bound),
        "without_influence": list(fit.idle),
        "identifiability": fit.identifiability,
        "stages": [_stage(stage) for stage in model.stages],
        "bootstrap": {path: list(pair) for path, pair in model.bootstrap.items()},
        "profiles": [
            {
                "parameter": profile.path,
                "value": list(profile.values),
                "loss": list(profile.losses),
                "interval": list(profile.interval),
                "open": list(profile.open_ends),
            }
            for profile in model.profiles
        ],
    }


def _masses(model: ModelResult) -> list[dict[str, Any]]:
    """The masses that were identified, in kg, with their intervals and what they owe to the errors of parts."""
    fitted = model.fit.fitted
    slots = {slot.path: slot.value for slot in fitted.slots()}
    paths = [f"{joint.numbers}.{key}" for joint in fitted.joints.values() for key in joint.masses]
    return [
        {
            "node": path.rpartition(".")[0],
            "parameter": path,
            "value": slots[path].number,
            "interval": list(slots[path].interval or ()),
            "owed": [
                {"branch": each.branch, "model": each.model, "share": each.share, "moved": each.numbers[path]}
                for each in model.owed
            ],
            "owed_to_known": [
                {"number": each.path, "unit": each.unit, "interval": list(each.interval), "moved": each.numbers[path]}
                for each in model.owed_to_known
            ],
        }
        for path in dict.fromkeys(paths)
        if slots[path].searched
    ]


def _known(known: Identifiability) -> dict[str, Any]:
    return {"condition": known.condition, "deviations": known.deviations, "weak": known.sentences}


def _stage(stage: StageResult) -> dict[str, Any]:
    return {
        "name": stage.name,
        "optimizer": stage.optimizer,
        "free": list(stage.free),
        "loss": stage.loss,
        "evaluations": stage.evaluations,
        "failures": stage.failures,
        "ending": stage.ending,
        "remark": stage.remark,
        "converged": stage.converged,
        "spread": list(stage.spread),
    }
