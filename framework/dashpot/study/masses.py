"""The answer of a study about each mass: the value of the model with the lowest RMSE, and its sensitivities."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from dashpot.text.quantity import pretty

Json = Mapping[str, Any]

PERCENT = 0.01
NORMAL = 1.96  # standard errors between a known number and the end of its interval


def identified_masses(
    models: Iterable[Json], noise_floor: float | None, references: Iterable[Json] = ()
) -> list[dict[str, Any]]:
    """For each node whose mass was identified: its mass (kg), 95 % interval, model, and what other models say.

    ``models`` and ``references`` are those of a study's result. The model is the one with the smallest error on
    held-out runs, or on the training runs where there are none.
    """
    found: dict[str, list[tuple[Json, Json]]] = {}
    for model in models:
        for mass in model["masses"]:
            found.setdefault(mass["node"], []).append((model, mass))
    known = {reference["parameter"]: reference for reference in references}
    return [_answer(node, pairs, noise_floor) | {"reference": _known(pairs, known)} for node, pairs in found.items()]


def mass_sentence(mass: Json) -> str:
    """The answer in words."""
    within = f", 95 % interval {mass['interval'][0]:.2f} to {mass['interval'][1]:.2f} kg" if mass["interval"] else ""
    error = "" if mass["error"] is None else f", which has the lowest RMSE ({mass['error']:.3g} N{_floor(mass)})"
    return f"{mass['node']}: {mass['value']:.2f} kg{within}{_beside(mass)}; from {mass['model']}{error}"


def mass_warnings(mass: Json) -> Iterator[str]:
    """What is not in the interval, or is an assumption of it."""
    for part in mass["owed"]:
        percent = PERCENT / part["share"] * part["moved"]
        way = "large" if percent < 0.0 else "small"
        allowed = f"{100.0 * part['share']:.2g} % for the force of {part['branch']}"
        yield (
            f"{mass['node']}: the interval includes {allowed}, the RMSE of {part['model']} by itself or of all, "
            "or a difference of load cells. If it were 1 % stiffer here than at its identification, this mass would "
            f"be {abs(percent):.2g} kg too {way}, with hardly any effect on the RMSE"
        )
    for number in mass["owed_to_known"]:
        low, high = (pretty(end, number["unit"], 3) for end in number["interval"])
        way = "larger" if number["moved"] > 0.0 else "smaller"
        yield (
            f"{mass['node']}: the interval includes {number['number']} from {low} to {high}; with {high} this "
            f"mass would be {abs(NORMAL * number['moved']):.2g} kg {way}"
        )
    others = [f"{other['value']:.2f} kg with {other['model']} ({other['error']:.3g} N)" for other in mass["others"]]
    if others:
        yield f"{mass['node']}: other structures give {', '.join(others)}"


def _answer(node: str, pairs: list[tuple[Json, Json]], noise_floor: float | None) -> dict[str, Any]:
    model, mass = min(pairs, key=lambda pair: _error(pair[0]))
    others = [
        {"model": other["name"], "value": each["value"], "error": _error(other)}
        for other, each in pairs
        if other is not model
    ]
    return {
        "node": node,
        "value": mass["value"],
        "interval": mass["interval"],
        "model": model["name"],
        "error": _error(model),
        "noise_floor": noise_floor,
        "owed": mass["owed"],
        "owed_to_known": mass["owed_to_known"],
        "others": others,
    }


def _known(pairs: list[tuple[Json, Json]], known: Json) -> dict[str, Any] | None:
    found: Json | None = known.get(pairs[0][1]["parameter"])
    return {"value": found["value"], "by": found["by"]} if found else None


def _beside(mass: Json) -> str:
    known = mass["reference"]
    if not known:
        return ""
    off = 100.0 * (mass["value"] / known["value"] - 1.0)
    return f", {abs(off):.1f} % {'above' if off > 0.0 else 'below'} the {known['value']:.2f} kg {known['by']}"


def _error(model: Json) -> float:
    held_out = model["rmse"]["held_out"]
    return float(model["rmse"]["train"] if held_out is None else held_out)


def _floor(mass: Json) -> str:
    return f" at a noise floor of {mass['noise_floor']:.3g} N" if mass["noise_floor"] else ""
