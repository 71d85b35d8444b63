"""Scoring blind cases: confusion matrix and rates."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from reliability import Told, as_text, brier, reliability
from scenarios import NO_LAW

NULL = "null"
LEAST_STRENGTH = 0.1  # weaker effects a refit of the base absorbs
LEAST_SHARE = 0.1  # of the strongest of two
SURE = 0.9  # a probability from which on nine names in ten are to be right
BINS = (0.03, 0.1, 0.3, 1.0, 3.0, 30.0)  # of the strength that a refit of the base leaves, over the noise

# causes whose forms overlap: a spread of sliders is friction and softening with amplitude, a power near two quadratic,
# one below one bends like a valve, which may be open to one side
FAMILIES = (
    {"friction", "amplitude_softening", "load_dependent_friction", "velocity_dependent_friction"},
    {"quadratic_damping", "power_law_damping", "viscous_damping", "valve"},
    {"valve", "asymmetric_damping"},
    {"stiffness_curve", "end_stop"},
    {"softening", "bedding_in", "creep"},
    {"offset", "drift", "gain"},
)
NOTHING, UNEXPLAINED = "nothing_missing", "unexplained"


@dataclass(frozen=True)
class Outcome:
    """One case after its label was opened.

    ``without``: the engine had no plugin for what is hidden; ``before``: its verdict before the runs that it asked for;
    ``oracle``: the held-out error [N] that a refit reaches where nothing is hidden, None where that is the noise;
    ``scenario``: the design that the case belongs to, in the table by designs.
    """

    seed: int
    base: str
    truth: Any
    verdict: dict
    seconds: float
    without: bool = False
    before: dict | None = None
    oracle: float | None = None
    scenario: str = ""

    @property
    def effects(self) -> list[Any]:
        """What was hidden in training runs: held-out runs decide nothing, and a fault of one of them is no name."""
        held_out = {run.partition("@")[0] for run in self.verdict["held_out"]}  # a run of an axle has two forces
        shows = [any(rms > 0.0 for run, rms in each.rms.items() if run not in held_out) for each in self.truth.effects]
        return [effect for effect, show in zip(self.truth.effects, shows, strict=True) if show]

    @property
    def kinds(self) -> tuple[str, ...]:
        """Their kinds."""
        return tuple(sorted(effect.kind for effect in self.effects))

    @property
    def named(self) -> list[str]:
        """What was named, best first."""
        return [cause["cause"] for cause in self.verdict["causes"] if cause["accepted"]]

    @property
    def first(self) -> str:
        """The first name, or the verdict when nothing was named."""
        return self.named[0] if self.named else self.verdict["verdict"]

    @property
    def strength(self) -> float:
        """Effect over noise unabsorbed RMS of the base, largest of all effects."""
        return max((effect.strength_left for effect in self.effects), default=0.0)

    @property
    def right(self) -> bool:
        """Whether the first name is one of the hidden effects, or nothing was named where nothing is hidden.

        Where no law fits, whether nothing is named and the verdict is that it is unexplained.
        """
        if NO_LAW in self.kinds:
            return self.first == UNEXPLAINED
        return self.first == NOTHING if not self.kinds else self.first in self.kinds

    @property
    def lone(self) -> bool:
        """Whether one candidate is named, without a rival."""
        return len(self.named) == 1 and not self.verdict["causes"][0]["indistinguishable_from"]

    @property
    def in_family(self) -> bool:
        """Whether the first name is a hidden effect or one of its family."""
        return self.right or any(self.first in family and set(self.kinds) & family for family in FAMILIES)

    @property
    def in_first_three(self) -> bool:
        """Whether a hidden effect is among the first three names and the rivals of the first."""
        rivals = self.verdict["causes"][0]["indistinguishable_from"] if self.named else []
        return bool(set(self.kinds) & {*self.named[:3], *rivals})

    @property
    def confidently_wrong(self) -> bool:
        """Whether it says that all is explained, by causes of which none is hidden nor of the family."""
        return self.verdict["verdict"] == "explained" and not self.in_family

    @property
    def beyond_confusions(self) -> bool:
        """Whether it is confidently wrong by a name that no plugin declares to be confused with what is hidden."""
        return self.confidently_wrong and not set(self.kinds) & confused_with(self.first)

    @property
    def over_oracle(self) -> float | None:
        """The held-out error after the extension over that of an oracle: the noise that is really in these runs."""
        after, runs = self.verdict["rmse"]["after"]["held_out"], self.verdict["held_out"]
        if after and self.oracle:
            return after / self.oracle
        if after is None or not runs or not set(runs) <= set(self.truth.noise_rms):
            return None  # of runs that were asked for the truth says nothing
        return after / (sum(self.truth.noise_rms[run] ** 2 for run in runs) / len(runs)) ** 0.5

    @property
    def gains(self) -> list[tuple[float, float]]:
        """Expected and realised gain of every named cause."""
        pairs = [(cause["expected_gain"], cause["gain"]) for cause in self.verdict["causes"]]
        return [pair for pair in pairs if None not in pair]

    @property
    def exact(self) -> bool:
        """Whether exactly the hidden effects were named.

        Those may be missing that a refit of the base absorbs, and those of less than a tenth of the strongest.
        """
        if NO_LAW in self.kinds:
            return self.right
        least = max(LEAST_STRENGTH, LEAST_SHARE * self.strength)
        due = {effect.kind for effect in self.effects if effect.strength_left >= least}
        return due <= set(self.named) <= set(self.kinds)

    @property
    def told(self) -> list[Told]:
        """The probability of every name, and whether it is that of a hidden effect."""
        return [
            (cause["probability"], cause["cause"] in self.kinds)
            for cause in self.verdict["causes"]
            if cause.get("probability") is not None
        ]

    @property
    def open_set(self) -> bool:
        """Whether the truth is among the names or their declared rivals."""
        rivals = {rival for cause in self.verdict["causes"] for rival in cause["indistinguishable_from"]}
        return set(self.kinds) <= set(self.named) | rivals

    def line(self) -> str:
        """The case in a line."""
        hidden = "+".join(
            f"{e.kind}({e.form}, {e.strength:.2g}, left {e.strength_left:.2g})" for e in self.truth.effects
        )
        names = ", ".join(f"{c['cause']} {_percent(c['gain'])}" for c in self.verdict["causes"])
        if self.without:
            mark = "BAD" if self.confidently_wrong else "ok "
        else:
            mark = "ok " if self.right and (self.exact or not self.kinds) else "~  " if self.right else "BAD"
        asked = (
            f"asked for a run ({self.before['verdict']}: {', '.join(_names(self.before))}) -> " if self.before else ""
        )
        return (
            f"{mark} {self.seed} {self.base}: {hidden or NULL} -> {asked}{self.verdict['verdict']}: {names or '-'} "
            f"[{self.seconds:.1f} s]"
        )


def confused_with(word: str) -> set[str]:
    """The causes that a cause declares to be confused with, or that declare it."""
    from dashpot.contract.registry import load_registry

    causes = load_registry().causes
    return {*causes[word].confused_with, *(other for other, cause in causes.items() if word in cause.confused_with)}


def summary(outcomes: Sequence[Outcome]) -> dict:
    """Rates and the confusion matrix."""
    hidden = [o for o in outcomes if o.kinds]
    null = [o for o in outcomes if not o.kinds]
    found = [o for o in hidden if o.strength >= LEAST_STRENGTH]
    known = [o for o in found if not o.without]  # what has no plugin cannot be named
    return {
        "cases": len(outcomes),
        "false_alarms": [sum(bool(o.named) for o in null), len(null)],
        "first_right": [sum(o.right for o in known), len(known)],
        "exact": [sum(o.exact for o in known), len(known)],
        "family_right": [sum(o.in_family for o in found), len(found)],
        "in_first_three": [sum(o.in_first_three for o in known), len(known)],
        "confidently_wrong": [sum(o.confidently_wrong for o in found), len(found)],
        "beyond_confusions": [sum(o.beyond_confusions for o in found), len(found)],
        "by_strength": _by_strength(hidden),
        "over_oracle": _quantiles([o.over_oracle for o in found if o.over_oracle is not None]),
        **_probabilities(outcomes),
        **({"by_design": by_design} if (by_design := _by_design(outcomes)) else {}),
        "gain_calibration": _rank_correlation([pair for o in outcomes for pair in o.gains]),
        "named_or_rival": [sum(o.open_set for o in known), len(known)],
        "confusion": _confusion(outcomes),
        "over_oracle_to_1.05": _share([o.over_oracle <= 1.05 for o in found if o.over_oracle is not None]),
        "right_after_asking": _share([o.right for o in found if o.before]),
        "lone_right": _share([o.right for o in known if o.lone]),
        "seconds": sorted(o.seconds for o in outcomes)[len(outcomes) // 2] if outcomes else None,
        "outcomes": [
            {
                "seed": o.seed,
                "base": o.base,
                "hidden": list(o.kinds),
                "strength": o.strength,
                "form": [effect.form for effect in o.truth.effects],
                "verdict": o.verdict["verdict"],
                "named": o.named,
                "told": o.told,
                "gains": o.gains,
                "over_oracle": o.over_oracle,
                "seconds": round(o.seconds, 1),
                **({"design": o.scenario} if o.scenario else {}),
            }
            for o in outcomes
        ],
    }


def print_table(outcomes: Sequence[Outcome]) -> None:
    """The confusion matrix (rows: hidden, columns: named first) and the rates."""
    confusion = _confusion(outcomes)
    columns = sorted({name for row in confusion.values() for name in row})
    width = max((len(row) for row in confusion), default=4) + 2
    print("\nhidden \\ named first")
    print(" " * width + "  ".join(columns))
    for row, counts in sorted(confusion.items()):
        print(row.ljust(width) + "  ".join(str(counts.get(name, "")).center(len(name)) for name in columns))
    rates = summary(outcomes)
    print(f"\nnull cases with a name: {_of(rates['false_alarms'])}")
    print(
        f"first name right (effects of {LEAST_STRENGTH:g} of the noise and more after a refit): "
        f"{_of(rates['first_right'])}"
    )
    print(
        f"exactly the hidden effects: {_of(rates['exact'])}; truth named or a declared rival: "
        f"{_of(rates['named_or_rival'])}"
    )
    print(
        f"first name of the right family: {_of(rates['family_right'])}; truth in the first three: "
        f"{_of(rates['in_first_three'])}; confidently wrong: {_of(rates['confidently_wrong'])}, "
        f"by a name that is not declared to be confused with it: {_of(rates['beyond_confusions'])}"
    )
    print(
        "first right by strength left: "
        + ", ".join(f"{band} {_of(pair)}" for band, pair in rates["by_strength"].items())
    )
    print(
        f"held-out error after over that of an oracle (median, 95 %): {rates['over_oracle']}; rank correlation of "
        f"expected and realised gain: {rates['gain_calibration']}"
    )
    print(
        f"held-out error within 1.05 of an oracle's: {_of(rates['over_oracle_to_1.05'])}; a single name without a "
        f"rival is right: {_of(rates['lone_right'])}"
    )
    if rates["brier"] is not None:
        print(
            f"\nBrier score of the probabilities: {rates['brier']:.3f}; told with 0.9 and more: "
            f"{_of(rates['sure_right'])} right\n" + as_text(reliability(_told(outcomes)))
        )
    _print_designs(rates.get("by_design", {}))
    if rates["right_after_asking"][1]:
        print(f"first name right once the run that was asked for is there: {_of(rates['right_after_asking'])}")
    print(f"median time of a diagnosis: {rates['seconds']:.1f} s")


def _told(outcomes: Sequence[Outcome]) -> list[Told]:
    return [one for outcome in outcomes if not outcome.without for one in outcome.told]


def _probabilities(outcomes: Sequence[Outcome]) -> dict:
    """Brier score, the names told with 0.9 and more, and the bins of the reliability diagram."""
    told = _told(outcomes)
    return {
        "brier": brier(told),
        "sure_right": _share([right for probability, right in told if probability >= SURE]),
        "reliability": [
            {"from": one.low, "to": one.high, "told": one.told, "right": [one.right, one.count]}
            for one in reliability(told)
        ],
    }


def _by_design(outcomes: Sequence[Outcome]) -> dict[str, dict]:
    """The rates of every scenario."""
    found = {}
    for name in dict.fromkeys(outcome.scenario for outcome in outcomes if outcome.scenario):
        mine = [outcome for outcome in outcomes if outcome.scenario == name]
        shown = [outcome for outcome in mine if not outcome.kinds or outcome.strength >= LEAST_STRENGTH]
        found[name] = {
            "cases": len(mine),
            "right": _share([o.right for o in shown]),
            "exact": _share([o.exact and o.right for o in shown]),
            "family": _share([o.in_family for o in shown]),
            "confidently_wrong": _share([o.confidently_wrong for o in shown]),
            "names": sum(len(o.named) for o in mine),
            "surplus": sum(not right for o in mine for _, right in o.told),
            "brier": brier(_told(mine)),
            "over_oracle": _quantiles([o.over_oracle for o in mine if o.over_oracle is not None]),
            "seconds": round(sorted(o.seconds for o in mine)[len(mine) // 2], 1),
        }
    return found


def _print_designs(designs: dict[str, dict]) -> None:
    if not designs:
        return
    heads = (
        "cases",
        "right",
        "exact",
        "family",
        "confidently_wrong",
        "names",
        "surplus",
        "brier",
        "over_oracle",
        "seconds",
    )
    width = max(map(len, designs)) + 2
    print("\n" + "design".ljust(width) + "  ".join(head.rjust(8) for head in heads))
    for name, row in designs.items():
        print(name.ljust(width) + "  ".join(_cell(head, row[head]).rjust(max(8, len(head))) for head in heads))


def _cell(head: str, value: Any) -> str:
    if value is None:
        return "-"
    if head == "over_oracle":
        return f"{value[0]:.2f}"
    if isinstance(value, list):
        return _of(value)
    return f"{value:.3f}" if head == "brier" else f"{value:g}"


def _confusion(outcomes: Sequence[Outcome]) -> dict[str, Counter]:
    table: dict[str, Counter] = {}
    for outcome in outcomes:
        table.setdefault("+".join(outcome.kinds) or NULL, Counter())[outcome.first] += 1
    return table


def _by_strength(outcomes: Sequence[Outcome]) -> dict[str, list[int]]:
    found = {}
    for low, high in zip((0.0, *BINS), BINS, strict=False):
        inside = [o for o in outcomes if low <= o.strength < high]
        if inside:
            found[f"{low:g} to {high:g}"] = [sum(o.right for o in inside), len(inside)]
    return found


def _quantiles(values: Sequence[float]) -> list[float] | None:
    if not values:
        return None
    ordered = sorted(values)
    return [round(ordered[int(share * (len(ordered) - 1))], 4) for share in (0.5, 0.95)]


def _share(marks: Sequence[bool]) -> list[int]:
    return [sum(marks), len(marks)]


def _rank_correlation(pairs: Sequence[tuple[float, float]]) -> float | None:
    from scipy.stats import spearmanr

    return round(float(spearmanr(*zip(*pairs, strict=True)).statistic), 3) if len(pairs) > 2 else None


def _names(verdict: dict) -> list[str]:
    return ["/".join([cause["cause"], *cause["indistinguishable_from"]]) for cause in verdict["causes"]]


def _of(pair: Sequence[int]) -> str:
    return f"{pair[0]} of {pair[1]}"


def _percent(share: float | None) -> str:
    return "(no held-out run)" if share is None else f"{share:.1%}"
