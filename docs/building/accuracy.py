"""The page that tells how often a diagnosis is right, from the kept results of the blind benchmark."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from architecture import written

ROOT = Path(__file__).resolve().parents[2]


def accuracy() -> Iterator[str]:
    """The kept results of the blind benchmark, each with its version, its seeds and its number of cases."""
    yield "# How often a diagnosis is right"
    yield (
        "Virtual specimens with something hidden in them, or nothing, were measured on a virtual rig and diagnosed. "
        "They share no code with dashpot, and the label was opened after the verdict. Few cases give wide "
        "intervals. A family are causes whose forms overlap, such as friction and softening with amplitude."
    )
    for name, found in kept_results("blind"):
        yield from _kept(name, found)


def kept_results(command: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """The results that lie in a folder of the tests, by the name of the file."""
    for path in sorted((ROOT / "tests" / command / "results").glob("*.json"), key=lambda path: path.stem):
        yield path.stem, json.loads(path.read_text(encoding="utf-8"))


def _kept(name: str, found: Mapping[str, Any]) -> Iterator[str]:
    version, _, kind = name.partition("-")
    last = found["seed"] + found["cases"] - 1
    yield f"## {found['cases']} cases of dashpot {version}{BLIND_KINDS[kind]}"
    repeats = found.get("caveat", " repeats them.")
    yield (
        f"Seeds {found['seed']} to {last}; `{found['command']}`{repeats} A diagnosis took {found['seconds']:.0f} s in "
        "the median, on two cores that did other work at the same time."
    )
    yield written.table(("what is counted", "cases", "95 % interval"), [*_rates(found), *_by_strength(found)])
    if (correlation := found.get("gain_calibration")) is not None:
        yield f"Gains predicted before the refit and realised gains have a rank correlation of {correlation:.2f}."
    if found.get("by_design"):
        yield written.table(("design", "cases", "right", "exact", "confidently wrong"), list(_designs(found)))
    if found.get("brier") is not None:
        yield (
            f"The Brier score of the probabilities is {found['brier']:.3f}: the mean squared error, 0 at best; 0.25 "
            "is that of a constant probability of one half. Calibration:"
        )
        yield written.table(("predicted probability", "mean", "hidden names", "95 % interval"), list(_told(found)))
    if mistaken := list(_mistaken(found["confusion"])):
        yield "Beside the diagonal of the confusion matrix, effects that a refit of the model absorbs among them:"
        yield written.table(("hidden", "named first instead", "cases"), mistaken)
    yield written.table(
        ("seed", "model that was diagnosed", "hidden", "effect over noise", "verdict", "named"),
        [
            (
                str(case["seed"]),
                f"`{case['base']}`",
                _words(case["hidden"]) or "nothing",
                f"{case['strength']:.2g}",
                case["verdict"].replace("_", " "),
                _words(case["named"]) or "nothing",
            )
            for case in found["outcomes"]
        ],
    )


BLIND_KINDS = {
    "": "",
    "null": " with nothing hidden",
    "axle": " of an axle",
    "sensors": " with sensor errors within their data sheet",
    "sensors-null": " with such sensors and nothing hidden",
    "no_quasi_static": " without a quasi-static run",
    "no_repeats": " without repeated runs",
    "without": " without the plugin of the cause",
    "double": " with two effects, one up to ten times the other",
    "textbook": " on rigs from bushing to strut, by laws of the textbook",
    "textbook-double": " on such rigs with two effects, one up to ten times the other",
    "designs": " on the designs that dampers and bushings are tested with",
    "follow": " on three runs, the run that the diagnosis asks for driven as well",
}
RATES = {
    "first_right": "the first name is a hidden effect",
    "family_right": "the first name is a hidden effect or one of its family",
    "in_first_three": "a hidden effect is among the first three names and the rivals of the first",
    "exact": "exactly the hidden effects are named",
    "confidently_wrong": "it says all is explained, by a cause outside the family",
    "beyond_confusions": "the same, by a cause that is not declared to be confused with it either",
    "false_alarms": "something is named where nothing is hidden",
    "over_oracle_to_1.05": "the held-out error after the extension is within 1.05 of an oracle's",
    "right_after_asking": "the first name is right once the run that was asked for is there",
    "lone_right": "a single name without a rival is a hidden effect",
    "sure_right": "a name told with a probability of 0.9 and more is a hidden effect",
}


def _rates(found: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    for key, words in RATES.items():
        if found.get(key, (0, 0))[1]:
            yield _rate(words, *found[key])


def _by_strength(found: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """The first name, where a refit of the network leaves so much of the effects, over the noise."""
    for band, (count, of) in found["by_strength"].items() if "first_right" in found else ():
        if of:
            yield _rate(f"the first name is a hidden effect of which a refit leaves {band} of the noise", count, of)


def _rate(words: str, count: int, of: int) -> tuple[str, str, str]:
    from scipy.stats import binomtest

    low, high = binomtest(count, of).proportion_ci(method="exact")
    return words, f"{count} of {of}", f"{low:.0%} to {high:.0%}"


def _designs(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    for name, row in found["by_design"].items():
        pairs = [f"{row[key][0]} of {row[key][1]}" for key in ("right", "exact", "confidently_wrong")]
        yield name, str(row["cases"]), *pairs


def _told(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    for one in found["reliability"]:
        yield f"{one['from']:g} to {one['to']:g}", f"{one['told']:.3f}", *_rate("", *one["right"])[1:]


def _mistaken(confusion: Mapping[str, Mapping[str, int]]) -> Iterator[tuple[str, str, str]]:
    """What is beside the diagonal of the confusion matrix."""
    for hidden, named in sorted(confusion.items()):
        for word, count in sorted(named.items()):
            if word not in hidden.split("+") and not (hidden == "null" and word == "nothing_missing"):
                yield _words([hidden]), word.replace("_", " "), str(count)


def _words(names: list[str]) -> str:
    return ", ".join(name.replace("_", " ") for name in names)
