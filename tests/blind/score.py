"""Scoring blind cases: confusion matrix and rates."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

NULL = "null"
NOTHING = "nothing_missing"


@dataclass(frozen=True)
class Outcome:
    """One case after its label was opened."""

    seed: int
    base: str
    truth: Any
    verdict: dict
    seconds: float

    @property
    def kinds(self) -> tuple[str, ...]:
        """What was hidden."""
        return tuple(self.truth.kinds)

    @property
    def named(self) -> list[str]:
        """What was named, best first."""
        return [cause["cause"] for cause in self.verdict["causes"]]

    @property
    def first(self) -> str:
        """The first name, or the verdict when nothing was named."""
        return self.named[0] if self.named else self.verdict["verdict"]

    @property
    def strength(self) -> float:
        """Effect over noise left by a refit of the base, largest of all effects."""
        return max((effect.strength_left for effect in self.truth.effects), default=0.0)

    @property
    def right(self) -> bool:
        """Whether the first name is one of the hidden effects, or nothing was named where nothing is hidden."""
        return self.first == NOTHING if not self.kinds else self.first in self.kinds

    @property
    def exact(self) -> bool:
        """Whether exactly the hidden effects were named."""
        return set(self.named) == set(self.kinds)

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
        mark = "ok " if self.right and (self.exact or not self.kinds) else "~  " if self.right else "BAD"
        return (f"{mark} {self.seed} {self.base}: {hidden or NULL} -> {self.verdict['verdict']}: {names or '-'} "
                f"[{self.seconds:.1f} s]")  # fmt: skip


def summary(outcomes: Sequence[Outcome]) -> dict:
    """Rates and the confusion matrix."""
    hidden = [o for o in outcomes if o.kinds]
    null = [o for o in outcomes if not o.kinds]
    found = [o for o in hidden if o.strength > 0.05]
    return {
        "cases": len(outcomes),
        "false_alarms": [sum(bool(o.named) for o in null), len(null)],
        "first_right": [sum(o.right for o in found), len(found)],
        "exact": [sum(o.exact for o in found), len(found)],
        "named_or_rival": [sum(o.open_set for o in found), len(found)],
        "confusion": _confusion(outcomes),
        "seconds": sorted(o.seconds for o in outcomes)[len(outcomes) // 2] if outcomes else None,
        "outcomes": [{"seed": o.seed, "base": o.base, "hidden": list(o.kinds), "strength": o.strength,
                      "verdict": o.verdict["verdict"], "named": o.named} for o in outcomes],
    }  # fmt: skip


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
    print(f"first name right (effects above 0.05 of the noise after a refit): {_of(rates['first_right'])}")
    print(f"exactly the hidden effects: {_of(rates['exact'])}; truth named or a declared rival: "
          f"{_of(rates['named_or_rival'])}")  # fmt: skip
    print(f"median time of a diagnosis: {rates['seconds']:.1f} s")


def _confusion(outcomes: Sequence[Outcome]) -> dict[str, Counter]:
    table: dict[str, Counter] = {}
    for outcome in outcomes:
        table.setdefault("+".join(outcome.kinds) or NULL, Counter())[outcome.first] += 1
    return table


def _of(pair: Sequence[int]) -> str:
    return f"{pair[0]} of {pair[1]}"


def _percent(share: float | None) -> str:
    return "(no held-out run)" if share is None else f"{share:.1%}"
