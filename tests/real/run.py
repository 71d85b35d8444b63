"""Diagnoses of measured sets as a command: ``python tests/real/run.py --set o_ring --keep results``.

Each set is diagnosed from two bases, with three seeds, and once more with a fifth of its training runs removed.
Finished trials are kept in a folder each and run again only where the source of dashpot has changed; ``--stale`` takes
them as they are. Writes table.csv and table.md there.
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from real import judge
from real.catalogue import SETS
from real.sets import MeasuredSet
from real.trial import Outcome, Trial, is_current, kept_outcome

COLUMNS = (
    "set",
    "base",
    "seed",
    "fewer",
    "verdict",
    "names",
    "faults",
    "before train",
    "before held out",
    "after train",
    "after held out",
    "explainable",
    "floor",
    "files alike",
    "near",
    "admitted",
    "seconds",
    "MB",
)


def trials(one: MeasuredSet, seeds: Sequence[int] = (), bases: Sequence[str] = (), whole: bool = False) -> list[Trial]:
    """All repetitions of a set: every base with every seed, and once with fewer runs unless it is to be `whole`."""
    seeds = seeds or one.seeds
    return [
        trial
        for base in (bases or one.bases)
        for trial in [*(Trial(one, base, seed) for seed in seeds), *[Trial(one, base, seeds[0], True)] * (not whole)]
    ]


def outcome(trial: Trial, keep: Path, stale: bool = False) -> Outcome:
    """The kept outcome of a trial, or that of running it."""
    folder = keep / trial.set.name / trial.word
    known = kept_outcome(folder)
    if known and (stale or is_current(*known)):
        return known[1]
    return trial.run(folder)


def kept(keep: Path) -> list[Outcome]:
    """Every outcome in a folder, in the order of the catalogue."""
    found = [
        known[1]
        for one in SETS.values()
        for trial in trials(one)
        if (known := kept_outcome(keep / one.name / trial.word))
    ]
    return found


def row(one: Outcome) -> dict[str, object]:
    """A line of the table, errors in N."""
    said = {kind: [cause for cause in one.causes if cause["class"] == kind] for kind in ("specimen", "measurement")}
    listed = {
        kind: ", ".join(
            f"{cause['cause']} {cause['presence']:.2f}{'?' * (cause['standing'] == 'probable')}" for cause in causes
        )
        for kind, causes in said.items()
    }
    triage = [f"{fault['kind']} of {fault['run']}" for fault in one.faults]
    errors = {name.replace("_", " ").replace(".", " "): f"{value:.4g}" for name, value in one.told.items()}
    return {
        "set": one.set,
        "base": one.base,
        "seed": one.seed,
        "fewer": "yes" if one.fewer else "",
        "verdict": f"{one.verdict} ({one.failed})" if one.failed else one.verdict,
        "names": listed["specimen"],
        "faults": ", ".join(filter(None, [listed["measurement"], *triage])),
        **errors,
        "explainable": _short(one.explainable),
        "floor": _short(one.floor),
        "files alike": "" if one.failed else "no" if judge.unlike(one) else "yes",
        "near": "yes" if judge.near(one) else "no",
        "admitted": "yes" if judge.admitted(one) else "no",
        "seconds": f"{one.seconds:.0f}",
        "MB": f"{one.megabytes:.0f}",
    }


def _short(value: float | None) -> str:
    return "" if value is None else f"{value:.4g}"


def summary(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """What the acceptance asks, in counts."""
    known = {name: one.known_faults for name, one in SETS.items()}
    count = len(outcomes)
    yield f"{count} diagnoses of {len({one.set for one in outcomes})} sets"
    yield f"{sum(one.verdict == 'failed' for one in outcomes)} failed"
    alike = sum(one.failed is None and not judge.unlike(one) for one in outcomes)
    yield f"told errors are those of the files: {alike} of {count}"
    guilty = sum(bool(judge.accused(one, known[one.set])) for one in outcomes)
    yield f"a fault of the rig that its owners do not know is named: {guilty} of {count}"
    yield (
        f"within {judge.NEAR} times the explainable error on held-out runs: {sum(map(judge.near, outcomes))} of {count}"
    )
    yield f"said to be unexplained or partly explained: {sum(map(judge.admitted, outcomes))} of {count}"
    if again := judge.same_names(outcomes):
        yield f"same accepted causes within set and base, none counting as an answer: {judge.share(again):.0%}"
        yield _where_named(judge.same_names(judge.naming(outcomes)), len(again), "groups")
    beyond = judge.same_beyond_bases(outcomes)
    yield f"the same from both bases, but for what they do of themselves: {judge.share(beyond):.0%}"
    yield _where_named(judge.same_beyond_bases(judge.naming_beyond_bases(outcomes)), len(beyond), "sets")


def _where_named(counts: Mapping[object, tuple[int, int]], count: int, what: str) -> str:
    share = f"{judge.share(counts):.0%}" if counts else "–"
    return f"the same where any of these is accepted: {share} in {len(counts)} of {count} {what}"


def write_tables(outcomes: Sequence[Outcome], keep: Path) -> None:
    """Write table.csv and table.md."""
    rows = [row(one) for one in outcomes]
    with (keep / "table.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, restval="")
        writer.writeheader()
        writer.writerows(rows)
    lines = ["| " + " | ".join(str(each.get(key, "")) for key in COLUMNS) + " |" for each in rows]
    head = ["| " + " | ".join(COLUMNS) + " |", "|" + " --- |" * len(COLUMNS)]
    points = [f"- {line}" for line in summary(outcomes)]
    (keep / "table.md").write_text("\n".join([*points, "", *head, *lines]) + "\n")


def main() -> None:
    """Run what was asked for, and write the tables after every trial."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--set", nargs="*", default=list(SETS), choices=list(SETS), help="all without it")
    parser.add_argument("--base", nargs="*", default=[], help="shipped names; those of the set without it")
    parser.add_argument("--seeds", type=int, nargs="*", default=[], help="those of the set without it")
    parser.add_argument("--whole", action="store_true", help="no trial with a fifth of the training runs removed")
    parser.add_argument("--keep", type=Path, required=True, help="folder for trials and tables")
    parser.add_argument("--stale", action="store_true", help="keep trials of an older dashpot")
    options = parser.parse_args()
    options.keep.mkdir(parents=True, exist_ok=True)
    for name in options.set:
        if not SETS[name].present:
            print(f"{name}: not here, {SETS[name].folder} is missing")
            continue
        for trial in trials(SETS[name], options.seeds, options.base, options.whole):
            one = outcome(trial, options.keep.resolve(), options.stale)
            told = [f"{key} {value}" for key, value in list(row(one).items())[4:] if value]
            print(f"{name} {trial.word}: {', '.join(told)}", flush=True)
            write_tables(kept(options.keep), options.keep)
    print("\n".join(summary(kept(options.keep))))


if __name__ == "__main__":
    main()
