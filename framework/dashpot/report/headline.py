"""The answer in one sentence, in the engineer's words: the size of the error, its causes, the remaining residual."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from dashpot.report.cause_words import (
    PROBABLY,
    as_sure_as_it_is,
    cause_phrase,
    likely_causes,
    may_be,
    named,
    or_rivals,
    probably,
)
from dashpot.report.faults import told_faults
from dashpot.report.grids import (
    cause_title,
    cross_validated,
    explainable_value,
    floor_value,
)
from dashpot.report.readable import above_floor, counted_words, join, listed, percent
from dashpot.text.digits import quantity

Json = Mapping[str, Any]

# where an error is taken from, best first
RUNS = {"held_out": "held-out runs", "train": "training runs", "all": "all runs"}

UNKNOWN = "what was added makes up for a part of the force, and nothing tells what it is"
MOST = 0.9  # of an error: no longer only a part of it
MOST_HIDDEN = 3  # causes told by name
MOST_WORDS = 25  # of a short headline


@dataclass(frozen=True)
class Errors:
    """RMSE before and after the extension and the noise floor, N; on held-out runs wherever there are any."""

    before: float | None
    after: float | None
    floor: float | None
    runs: str

    @property
    def gain(self) -> float | None:
        return 1.0 - self.after / self.before if self.before and self.after is not None else None

    @property
    def written(self) -> float | None:
        """The RMSE of the network that goes with the result, N."""
        return self.before if self.after is None else self.after


def read_errors(diagnosis: Json) -> Errors:
    """The errors of a `dashpot-diagnosis/1` on its held-out runs, else on the training runs."""
    rmse = diagnosis.get("rmse") or {}
    before, after = rmse.get("before") or {}, rmse.get("after") or {}
    for key, runs in RUNS.items():
        if before.get(key) is not None:
            return Errors(before[key], after.get(key), floor_value(diagnosis), runs)
    return Errors(None, None, floor_value(diagnosis), "")


def headline(diagnosis: Json) -> str:
    """The verdict of a `dashpot-diagnosis/1` as one sentence, and what may go of the diagnosed network as another.

    Raises ValueError for a verdict it does not know.
    """
    verdict = diagnosis["verdict"]
    if verdict not in SENTENCES:
        raise ValueError(f"verdict: expected one of {', '.join(SENTENCES)}, got {verdict!r}")
    names = [f"'{name}'" for name in diagnosis.get("may_go") or ()]
    going = f" {join(names)} of the diagnosed network may go." if names else ""
    return f"{SENTENCES[verdict](diagnosis, read_errors(diagnosis))}{going}"


def short_headline(diagnosis: Json) -> str:
    """The verdict in 25 words at most: the error, and as many causes by name as there is room for."""
    errors, verdict = read_errors(diagnosis), diagnosis["verdict"]
    names = _titles(diagnosis)
    if verdict == "nothing_missing" and errors.written is not None and errors.floor:
        return _at_floor(errors)
    start, end = _short_frame(verdict, errors)
    # what remains is told where there is room for it beside a name
    for tail in dict.fromkeys((end, "")):
        for count in range(len(names), 0, -1):
            told = f"{start}{join([*names[:count], *_more(names[count:])])}{tail}."
            if len(told.split()) <= MOST_WORDS:
                return told
    return _without_names(verdict, errors, names)


def _more(names: Sequence[str]) -> list[str]:
    """How many more there are, as sure as they are."""
    probably = all(name.startswith(PROBABLY) for name in names)
    return [f"{PROBABLY if probably else ''}{len(names)} more"] if names else []


def _titles(diagnosis: Json) -> list[str]:
    """The causes that are told, each as sure as it is; all that the error resembles where nothing explains it."""
    if diagnosis["verdict"] == "unexplained":
        return [cause_title(cause) for cause in diagnosis["causes"] if may_be(cause)]
    likely = [probably(cause, cause_title(cause)) for cause in likely_causes(diagnosis)]
    return likely or (_resembled(diagnosis) if diagnosis["verdict"] == "ambiguous" else [])


def _resembled(diagnosis: Json) -> list[str]:
    """All that the error resembles: the causes in the file that may be it, and what may stand in their places."""
    found = [cause for cause in diagnosis["causes"] if may_be(cause)]
    rivals = [other for cause in found for other in cause.get("indistinguishable_from") or []]
    causes = [*found, *({"cause": word} for word in rivals)]
    return list(dict.fromkeys(cause_title(cause) for cause in causes))


def _short_frame(verdict: str, errors: Errors) -> tuple[str, str]:
    """What stands before and behind the names of causes."""
    error = _short_error(errors)
    if verdict == "bad_data":
        return "The measurement is at fault first; named: ", ""
    if verdict == "unexplained":
        return f"{error}: no known cause fits; it resembles ", ""
    if verdict == "ambiguous":
        return f"{error}: not distinguishable by these data: ", ""
    gained = errors.gain is None or errors.gain > 0.0
    part = f"; {percent(errors.gain)} of it is " if gained else f"; on {errors.runs} nothing is gained by "
    share = ": " if errors.gain is None else part
    left = f"; {quantity(errors.after, 'N')} remain" if verdict == "partly_explained" and errors.after else ""
    return f"{error}{share}", left


def _without_names(verdict: str, errors: Errors, names: Sequence[str]) -> str:
    if verdict == "bad_data":
        return "The measurement is at fault first."
    if verdict == "nothing_missing":
        return _without_floor(errors)
    none = "the cause is not identifiable from these data" if verdict == "ambiguous" else "no known cause fits"
    told = _counted(names) if names and verdict != "unexplained" else none
    return f"{_short_error(errors)}: {told}."


def _counted(names: Sequence[str]) -> str:
    """How many causes are named, and how many are probable."""
    probable = sum(name.startswith(PROBABLY) for name in names)
    sure = len(names) - probable
    told = [f"{counted_words(sure, 'cause')} {'is' if sure == 1 else 'are'} named"] if sure else []
    many = f"{probable} more" if sure else counted_words(probable, "cause")
    return ", ".join([*told, *([f"{many} {'is' if probable == 1 else 'are'} probable"] if probable else [])])


def _short_error(errors: Errors) -> str:
    if errors.before is None:
        return "The RMSE is unknown"
    floor = f", {above_floor(errors.before, errors.floor)}" if errors.floor else ""
    return f"RMSE {quantity(errors.before, 'N')}{floor}"


def error_phrase(errors: Errors) -> str:
    """The size of the error against what the measurement can resolve."""
    if errors.before is None:
        return "The RMSE is unknown"
    if not errors.floor:
        return f"RMSE {quantity(errors.before, 'N')} (noise floor unknown)"
    above = above_floor(errors.before, errors.floor)
    return f"RMSE {quantity(errors.before, 'N')}, {above} ({quantity(errors.floor, 'N')})"


def beside_references(diagnosis: Json) -> str:
    """The errors of a `dashpot-diagnosis/1` before and after beside what is explainable and the noise floor."""
    errors = read_errors(diagnosis)
    shown = {
        "before": errors.before,
        "after": errors.after,
        f"explainable{cross_validated(diagnosis)}": explainable_value(diagnosis),
        "noise floor": errors.floor,
    }
    known = [f"{name} {quantity(error, 'N')}" for name, error in shown.items() if error is not None]
    return f"RMSE on {errors.runs}: {', '.join(known)}." if errors.runs else ""


def _explained(diagnosis: Json, errors: Errors) -> str:
    causes = likely_causes(diagnosis)
    if not causes:
        return f"{error_phrase(errors)}."
    return f"{error_phrase(errors)}; {_part(errors.gain, causes, errors.runs)}."


def _part(gain: float | None, causes: list[Json], runs: str) -> str:
    """Which part of the error some causes are, or that runs that took no part gain nothing by them."""
    if gain is not None and gain <= 0.0:
        told = [as_sure_as_it_is(cause) for cause in causes]
        told = [text if cause.get("accepted") else f"what is {text}" for cause, text in zip(causes, told, strict=True)]
        return f"on {runs} nothing is gained by {listed(told)}"
    return f"{'part' if gain is None else percent(gain)} of it is {named(causes)}"


def _nothing_missing(diagnosis: Json, errors: Errors) -> str:
    if errors.written is None or not errors.floor:
        return f"{_without_floor(errors)}{_limit(diagnosis)}"
    return f"{_at_floor(errors)}{_limit(diagnosis)}"


def _without_floor(errors: Errors) -> str:
    error = "" if errors.written is None else f"; the error is {quantity(errors.written, 'N')}, its noise is unknown"
    return f"Nothing is missing as far as these data tell: they support no candidate cause{error}."


def _at_floor(errors: Errors) -> str:
    error, floor = quantity(errors.written, "N"), quantity(errors.floor, "N")
    return f"Nothing is missing: the error of {error} is at the noise floor ({floor})."


def _limit(diagnosis: Json) -> str:
    """How small an effect the silence is about."""
    limits = diagnosis.get("limits") or ()
    seen = [limit for limit in limits if limit.get("left")]
    if not seen:
        return ""
    left = quantity(max(limit["left"] for limit in seen), "N")
    hardest = max(seen, key=lambda limit: limit["force"])
    force, value = quantity(hardest["force"], "N"), quantity(hardest["value"], hardest["unit"])
    hidden = [cause_title(limit) for limit in limits if limit.get("value", 0.0) is None]
    each = "Each other" if hidden else "Each"
    return (
        f" {each} candidate cause is detected with 95 % power where a refit of the other parameters leaves {left} RMS "
        f"of it or more; the least detectable is {cause_title(hardest)}, from {force} RMS on "
        f"({hardest['quantity']} {value}).{_hidden(hidden)}"
    )


def _hidden(titles: Sequence[str]) -> str:
    """The causes that these runs cannot detect."""
    if not titles:
        return ""
    more = len(titles) - MOST_HIDDEN
    told = [*titles[:MOST_HIDDEN], f"{more} more"] if more > 0 else [*titles]
    return f" On these runs the parameters of the model absorb {join(told)}, which cannot be detected."


def _partly_explained(diagnosis: Json, errors: Errors) -> str:
    causes = likely_causes(diagnosis)
    left = _remaining(errors, " unexplained")
    departs = _departs(diagnosis)
    only = "only " if errors.gain is not None and 0.0 < errors.gain <= MOST and not departs else ""
    named = only + _part(errors.gain, causes, errors.runs) if causes else "it is only partly explained"
    return f"{error_phrase(errors)}; {named}; {departs or left}{_stands_in(causes)}{_leftover(diagnosis)}."


def _remaining(errors: Errors, how: str = "") -> str:
    """The error with all causes that are told, beside the noise floor."""
    beside = f", {above_floor(errors.after, errors.floor)}" if errors.floor and errors.after is not None else ""
    return f"{quantity(errors.after, 'N')} remain{how}{beside}"


def _stands_in(causes: list[Json]) -> str:
    """Which causes may not be what is hidden, though they explain it."""
    titles = [cause_title(cause) for cause in causes if cause.get("stands_in")]
    return f"; {join(titles)} had to be added twice, so the true law may be another one" if titles else ""


def _unexplained(diagnosis: Json, errors: Errors) -> str:
    missing = "something is missing in the model, and no known cause fits it"
    if (departs := _departs(diagnosis)) and not diagnosis["causes"]:
        missing = f"{departs}, in which nothing is missing"
    alike = [or_rivals(cause) for cause in diagnosis["causes"] if may_be(cause)]
    left = f", with which {_remaining(errors)}" if errors.after is not None else ""
    told = f"it resembles {listed(alike)}" if alike else UNKNOWN
    resembled = f"; {told}{left}" if diagnosis["causes"] else ""
    return f"{error_phrase(errors)}: {missing}{resembled}{_leftover(diagnosis)}."


def _departs(diagnosis: Json) -> str:
    """Which runs depart from all others; empty where none does."""
    apart = diagnosis.get("apart") or []
    if len(apart) == 1:
        return f"run '{apart[0]}' departs from what the others show"
    return f"runs {join([repr(run) for run in apart])} depart from what the others show" if apart else ""


def _leftover(diagnosis: Json) -> str:
    """What the remaining residual is correlated with, and how much of it; nothing where that is as good as noise."""
    left = diagnosis.get("leftover") or {}
    share = left.get("share")
    return f"; {percent(share)} of the square of the remaining residual {left['what']}" if share else ""


def _ambiguous(diagnosis: Json, errors: Errors) -> str:
    """What has no rival comes first; causes that fit alike explain the rest of it."""
    rivals, likely = _rivals(diagnosis), likely_causes(diagnosis)
    if len(rivals) < 2:
        resembled = _resembled(diagnosis)
        else_told = f"; it resembles {' or '.join(resembled)}" if resembled else f"; {UNKNOWN}"
        told = f", {named(likely)}" if likely else else_told
        return f"{error_phrase(errors)}: the cause is not identifiable from these data{told}."
    alone = [cause for cause in likely if not cause.get("indistinguishable_from")]
    known = [cause_title(cause) for cause in alone]
    names = join([f"more {cause_title(c)}" if cause_title(c) in known else cause_phrase(c) for c in rivals])
    if not alone:
        return f"{error_phrase(errors)}: {names} explain it equally well; these data do not distinguish them."
    gain = _gain_of(alone)
    further = "further " if gain is None or gain > 0.0 else ""
    rest = f"a {further}part is explained equally well by {names}; these data do not distinguish them"
    return f"{error_phrase(errors)}; {_part(gain, alone, errors.runs)}; {rest}."


def _gain_of(causes: list[Json]) -> float | None:
    """What several causes gain together, each on what the ones before it left."""
    gains: list[Any] = [cause.get("gain") for cause in causes]
    return None if None in gains else 1.0 - math.prod(1.0 - gain for gain in gains)


def _bad_data(diagnosis: Json, errors: Errors) -> str:
    told = [f"{evidence} ({runs})" for runs, evidence in told_faults(diagnosis.get("faults") or ())]
    first = "; ".join(told) or _measurement_faults(diagnosis)
    causes = [cause for cause in likely_causes(diagnosis) if cause.get("branch")]
    rest = f"; the sound runs show {named(causes)}" if causes else ""
    return f"The measurement is at fault first: {first}. {error_phrase(errors)}{rest}."


def _measurement_faults(diagnosis: Json) -> str:
    faults = [cause for cause in likely_causes(diagnosis) if cause.get("class") == "measurement"]
    return join([cause_phrase(cause) for cause in faults]) if faults else "see the findings below"


def _rivals(diagnosis: Json) -> list[Json]:
    causes = likely_causes(diagnosis)
    places = [other for cause in causes for other in cause.get("alternatives") or ()]
    if places:
        named = [cause for cause in causes if cause.get("indistinguishable_from")]
        return list({cause_title(cause): cause for cause in [*places, *named]}.values())[::-1]
    words = {cause["cause"] for cause in causes if cause.get("indistinguishable_from")}
    words |= {other for cause in causes for other in cause.get("indistinguishable_from") or []}
    known = {cause["cause"]: cause for cause in diagnosis["causes"]}
    return [known.get(word, {"cause": word}) for word in [*known, *sorted(words - set(known))] if word in words]


SENTENCES = {
    "explained": _explained,
    "nothing_missing": _nothing_missing,
    "partly_explained": _partly_explained,
    "unexplained": _unexplained,
    "ambiguous": _ambiguous,
    "bad_data": _bad_data,
}
