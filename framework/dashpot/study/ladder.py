"""Whether each model of a study is better on held-out runs than the one before it, and if not, why."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

Json = Mapping[str, Any]

FEW = 4  # names in a sentence


def ladder_of(models: Sequence[Json]) -> list[dict[str, Any]]:
    """For each of the compared ``models`` of a study but the first, how it stands beside the one before.

    ``changes`` of its RMSE in per cent on training and on held-out runs, what it ``adds`` to the searched parameters
    or has as other parts, what it ``lacks`` of them, and, where it is not better on the runs that judge, the ``reason``
    in words. Runs that judge are the held-out ones; where there are none, the training runs.
    """
    named = {model["name"]: model for model in models}
    return [_step(before, model, named) for before, model in zip(models, models[1:], strict=False)]


def _step(before: Json, model: Json, named: Mapping[str, Json]) -> dict[str, Any]:
    better = _error(model) < _error(before)
    return {
        "model": model["name"],
        "before": before["name"],
        "changes": {key: _change(before, model, key) for key in ("train", "held_out")},
        "adds": [*_parts(before, model), *_more(before, model)],
        "lacks": _more(model, before),
        "better": better,
        "reason": None if better else " ".join(_reasons(before, model, named)),
    }


def _reasons(before: Json, model: Json, named: Mapping[str, Json]) -> Iterator[str]:
    judged = "held-out" if model["rmse"]["held_out"] is not None else "training"
    yield (
        f"{model['name']} is not better on {judged} runs than {before['name']}, "
        f"{_error(model):.4g} N beside {_error(before):.4g} N."
    )
    adds, lacks = _more(before, model), _more(model, before)
    fall = -(_change(before, model, "train") or 0.0)
    root = named.get(model["start_from"] or "")
    if lacks and root and root["name"] == before["start_from"]:
        yield f"Both go on from {root['name']} ({_error(root):.4g} N):"
        yield f"{_listed(_more(root, model))} of {model['name']} {_moves(root, model)},"
        yield f"{_listed(_more(root, before))} of {before['name']}, which it lacks, {_moves(root, before)}."
    elif lacks:
        yield f"It does not search {_listed(lacks)}" + (f", but {_listed(adds)}." if adds else ".")
    elif fall > 0.0 and judged == "held-out":
        yield (
            f"On training runs its RMSE is {fall:.2g} % lower: what it adds, {_listed(adds)}, follows those runs and "
            "not the specimen."
        )
    elif model["status"] == "ok":
        yield f"Nor on training runs: the data do not need what it adds, {_listed(adds)}."
    if model["status"] != "ok":
        yield f"Its fit did not converge: {model['status']}."


def _moves(root: Json, model: Json) -> str:
    change = 100.0 * (_error(model) / _error(root) - 1.0)
    return f"{'lower' if change < 0.0 else 'raise'} its RMSE by {abs(change):.2g} %"


def _change(before: Json, model: Json, key: str) -> float | None:
    one, other = before["rmse"][key], model["rmse"][key]
    return None if one is None or other is None else 100.0 * (other / one - 1.0)


def _more(before: Json, model: Json) -> list[str]:
    """What a model searches and the one before does not: parameters, and branches that are new as a whole."""
    searched = _searched(before)
    branches = {_branch(path) for path in before["parameters"]}
    new = (path for path in _searched(model) if path not in searched)
    return list(dict.fromkeys(path if _branch(path) in branches else _branch(path) for path in new))


def _parts(before: Json, model: Json) -> list[str]:
    """The branches for which a model uses another one that was identified before it: "tire (ftire)"."""
    parts = model["parts"].items()
    return [f"{branch} ({part})" for branch, part in parts if before["parts"].get(branch) != part]


def _searched(model: Json) -> dict[str, None]:
    """The parameters that a model searches, a table as one."""
    entries = model["parameters"].items()
    return dict.fromkeys(path.partition("[")[0] for path, entry in entries if entry["role"] != "fixed")


def _branch(path: str) -> str:
    return path.rpartition(".")[0]


def _listed(paths: Sequence[str]) -> str:
    if not paths:
        return "no parameter"
    more = len(paths) - FEW
    return ", ".join(paths[:FEW]) + (f" and {more} more" if more > 0 else "")


def _error(model: Json) -> float:
    held_out = model["rmse"]["held_out"]
    return float(model["rmse"]["train"] if held_out is None else held_out)
