"""The JSON schema of a study file, with the optimizers and specimens that are installed."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from dashpot.contract.optimizer import Optimizer
from dashpot.contract.option_schema import with_options
from dashpot.fit.refine import OWN_METHOD
from dashpot.fit.study.reading import BUDGET, FORMAT, STAGE_RUNS, TAKEN
from dashpot.text import schema as s
from dashpot.text.schema import Schema


def study_schema(optimizers: Mapping[str, type[Optimizer]], specimens: Collection[str]) -> Schema:
    """The schema of a study file."""
    measured = s.mapping({"specimen": s.choice(specimens), "seed": s.integer()}, ("specimen",))
    keys = {
        "format": s.choice((FORMAT,)),
        "name": s.text("the name of the study"),
        "about": s.text("a remark for the report"),
        "data": {"if": {"type": "object"}, "then": measured, "else": s.text("a dataset, relative to this file")},
        "seed": s.integer("same seed, same result files"),
        "hold_out": s.patterns("held-out runs"),
        "weights": s.named({"type": "number", "exclusiveMinimum": 0}, "of the runs named; all others count 1"),
        "budget": s.integer(f"of each stage that does not say its own; {BUDGET} if left out"),
        "amplitude": s.quantity("m", "of the figure of dynamic stiffness over frequency"),
        "bootstrap": s.integer("refits on runs drawn with replacement"),
        "profiles": s.patterns("parameters whose profile likelihood is computed"),
        "stages": s.items(s.part("stage"), "of every model that has none of its own"),
        "models": s.items({"if": {"type": "object"}, "then": s.part("model"), "else": s.text()}, "in this order"),
    }
    content = s.mapping(keys, ("format", "name", "data", "models"))
    parts = {"stage": _stage(optimizers), "model": _model()}
    return s.document("study", "Models identified in stages.", content, parts)


def _model() -> Schema:
    keys = {
        "network": s.text("a shipped name, or a file beside this one"),
        "start_from": s.text("a model above, whose parameters it takes over"),
        "stages": s.items(s.part("stage"), "its own stages"),
        "runs": s.patterns("the runs that it is about"),
        "parts": s.named(s.text(), "branch: the model above that it uses"),
    }
    return s.mapping(keys, ("network",))


def _stage(optimizers: Mapping[str, type[Optimizer]]) -> Schema:
    name = s.text("the name of the stage")
    take = s.mapping({"name": name, "take": s.choice(TAKEN, "parameters read from the data")}, ("name", "take"))
    word = "(" + "|".join(optimizers) + ")"
    search = s.mapping(
        {
            "name": name,
            "free": s.patterns("parameters that are searched"),
            "fixed": s.patterns("those that stay although `free` names them"),
            "runs": s.choice(STAGE_RUNS),
            "optimizer": s.text("A+B lets B begin where A ended", f"^({OWN_METHOD}|{word}(\\+{word})*)$"),
            "options": {"type": "object", "description": "of the optimizer", "properties": _of_chains(optimizers)},
            "budget": s.integer("parameter vectors that are evaluated at most", minimum=1),
            "starts": s.integer("searches from several starts", minimum=1),
        },
        ("name",),
        allOf=[_options_of(word, made) for word, made in optimizers.items()],
    )
    return s.by_key({"take": take}, search)


def _of_chains(optimizers: Mapping[str, type[Optimizer]]) -> dict[str, Schema]:
    return {
        f"{word}.{name}": schema
        for word, made in optimizers.items()
        for name, schema in with_options(made, {})["properties"].items()
    }


def _options_of(word: str, made: type[Optimizer]) -> Schema:
    asked = {"properties": {"optimizer": {"const": word}}, "required": ["optimizer"]}
    return {"if": asked, "then": {"properties": {"options": with_options(made, {})}}}
