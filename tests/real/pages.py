"""The pages of the documentation on measured sets: ``python tests/real/pages.py --keep results``.

Written from the trials that ``run.py`` keeps in a folder. Pictures are drawn from the measurements, which have to be
beside the repository; without a set its page stays as it is.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from real import judge
from real.catalogue import SETS
from real.pictures import pictures
from real.run import summary, trials
from real.sets import MeasuredSet
from real.trial import Outcome, Trial, is_current, kept_outcome

import dashpot
from dashpot.text.digits import number

PAGES = Path(__file__).resolve().parents[2] / "docs" / "real"
RESEMBLED = 3  # causes that are listed where none is named
HELD_OUT = ("before.held_out", "after.held_out")  # errors of the files that are shown
INDEX = (
    "set",
    "diagnoses",
    f"within {judge.NEAR} times the explainable error",
    "said to be unexplained or partly explained",
    "same names",
    "same names where any is named",
    "accuse the rig",
)
READING = "How to read the pages"
WORDS = f"""\
- A cause that stands in a table without a further word is **named**: the number in brackets behind it is 0.9 or more.
- **Probably** stands before a cause that is more likely than not, with a number above 0.5. With other runs another one
  may come out.
- **Resembles** stands where nothing is named or probable: a term of this form describes a part of the force in the
  written file, and its cause is open. The first three of such terms are listed.
- **Or** parts a cause from its rivals: these runs hardly tell which of them it is.
- The **number in brackets**, from 0 to 1, is how sure it is that the cause, or a rival that stands behind its "or", is
  at work; of a fault of the measurement, that it is this one. It is cut after two digits.
- The **same names** are counted over repetitions of a set from one network: how many of them name just what most of
  them name. That nothing is named counts as an answer in the first figure; the second one is of those sets and networks
  where at least one repetition names something.
- A diagnosis is **within {judge.NEAR} times the explainable error** by the error of its written file on held-out runs
  alone. Whether its verdict is *unexplained* or *partly explained* is counted by itself."""
Kept = Sequence[tuple[Trial, Outcome]]


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def common_unit(forces: Iterable[float | None]) -> tuple[float, str]:
    """The size in N and the name of the one unit in which some forces (N) are shown: kN from 10 kN on."""
    largest = max((abs(force) for force in forces if force is not None), default=0.0)
    return (1e3, "kN") if largest >= 1e4 else (1.0, "N")


def short(force: float | None, size: float) -> str:
    """A force in N as a number in a unit of this size."""
    return number(None if force is None else force / size)


def page(one: MeasuredSet, kept: Kept, keep: Path, folder: Path) -> Iterator[str]:
    """The page of a set."""
    with tempfile.TemporaryDirectory() as place:
        seen = dashpot.look(dashpot.load_dataset(one.write(Path(place)), allow_outside=True))
    about, look = one.owners, seen.as_dict()
    yield f"# {one.title}"
    yield (
        f"Source: [{about['source']}]({about['url']}), licence {about['licence']}. The measurements are not part of "
        "dashpot."
    )
    yield "## What its owners say"
    yield about["owners"]
    yield "## The runs"
    yield one.cut + " " + told_runs(look["runs"])
    final = best_file(kept, keep / one.name)
    if final:
        yield (
            f"Black is measured, blue the written file `{final.network.stem}`: of those with seed {kept[0][0].seed} "
            f"the one with the smallest {final.by}."
        )
        drawn = pictures(seen, final.network, final.network.parent, folder / one.name)
        yield "\n\n".join(f"![{words}]({path.name})" for words, path in drawn)
    yield "## What can be explained"
    errors = {
        "noise floor": look["noise_floor"].get("value"),
        "explainable, on held-out runs": look["explainable"].get("held_out"),
    }
    outcomes = [outcome for _, outcome in kept]
    size, unit = common_unit([*errors.values(), *errors_of(outcomes)])
    yield table(("error (seed 0)", unit), [(words, short(error, size)) for words, error in errors.items()])
    yield (
        "Explainable is what [a general model of the past motion](../explanation/look.md#the-explainable-error) "
        "leaves on runs that it has not seen; it differs with the runs that are held out."
    )
    yield "## What is diagnosed"
    yield f"[{READING}](index.md#{READING.lower().replace(' ', '-')}) tells what the words and numbers mean."
    yield diagnoses(outcomes, size, unit)
    yield remarks(outcomes, one)


def told_runs(runs: Sequence[dict[str, object]]) -> str:
    """Numbers of the runs in a sentence or two."""

    def reach(key: str, factor: float) -> str:
        values = [factor * float(run[key]) for run in runs]
        low, high = number(min(values)), number(max(values))
        return low if low == high else f"{low} to {high}"

    largest = max(abs(float(run[key])) for run in runs for key in ("least_force", "largest_force"))
    size, unit = common_unit([largest])
    back = [str(run["run"]) for run in runs if run["gives_back"]]
    energy = f"Work is given back by {', '.join(back)}." if back else "Every run takes up work."
    return (
        f"{len(runs)} runs of {reach('duration', 1.0)} s at {reach('sampling', 1.0)} Hz, amplitudes of "
        f"{reach('amplitude', 1e3)} mm, peak speeds of {reach('peak_speed', 1e3)} mm/s, forces up to "
        f"{short(largest, size)} {unit}. {energy}"
    )


@dataclass(frozen=True)
class Best:
    """The file that a page draws, and the error by which it was chosen, in words."""

    network: Path
    by: str


def best_file(kept: Kept, folder: Path) -> Best | None:
    """The network with the smallest error on training runs left out in turn, of the first seed and all runs.

    Where one of them tells no such error, that on the training runs themselves decides.
    """
    folders = [
        folder / trial.word / "diagnosis"
        for trial, outcome in kept
        if outcome.files and not trial.fewer and trial.seed == kept[0][0].seed
    ]
    if not folders:
        return None
    told = {found: json.loads((found / "diagnosis.json").read_text()) for found in folders}
    unseen = all(one.get("left_out") is not None for one in told.values())
    found = min(told, key=lambda one: told[one]["left_out"] if unseen else told[one]["rmse"]["after"]["train"])
    network = found / (told[found]["extended_model"] or told[found]["fitted_model"])
    return Best(network, f"error on training runs{' left out in turn' * unseen}")


def errors_of(outcomes: Sequence[Outcome]) -> list[float | None]:
    """All errors in N that a table of diagnoses shows."""
    return [error for one in outcomes for error in (*map(one.files.get, HELD_OUT), one.explainable)]


def diagnoses(outcomes: Sequence[Outcome], size: float, unit: str) -> str:
    """A line for each diagnosis, with all errors in one unit of a size in N."""
    rows = [
        (
            f"`{one.base}`",
            f"{one.seed}{', fewer runs' if one.fewer else ''}",
            one.verdict.replace("_", " "),
            "; ".join(_said(cause) for cause in one.causes if cause["class"] == "specimen") or _resembled(one),
            "; ".join(
                [
                    *(_said(cause) for cause in one.causes if cause["class"] == "measurement"),
                    *(f"{fault['kind'].replace('_', ' ')} of {fault['run']}" for fault in one.faults),
                ]
            )
            or "–",
            *(short(one.files.get(key), size) for key in HELD_OUT),
            short(one.explainable, size),
        )
        for one in outcomes
    ]
    head = (
        "from",
        "seed",
        "verdict",
        "missing in the model (how sure)",
        "faults of the measurement",
        f"file before, held out ({unit})",
        f"file after, held out ({unit})",
        f"explainable ({unit})",
    )
    return table(head, rows)


def _said(cause: dict[str, object]) -> str:
    link = f"[{str(cause['cause']).replace('_', ' ')}](../generated/causes.md#{str(cause['cause']).replace('_', '-')})"
    rivals = cause["indistinguishable_from"]
    beside = f" or {' or '.join(str(rival).replace('_', ' ') for rival in rivals)}" if rivals else ""
    return f"{'probably ' * (cause['standing'] == 'probable')}{link}{beside} ({how_sure(cause['presence'])})"


def how_sure(presence: float) -> str:
    """The number that decides what is said of a cause, cut to two digits, so that it stays below what it is below."""
    return f"{math.floor(100.0 * presence) / 100.0:.2f}" if presence >= 0.01 else "below 0.01"


def _resembled(outcome: Outcome) -> str:
    """The first few that the force resembles where nothing of the specimen is named."""
    told = [_said(cause) for cause in outcome.resembled if cause["class"] == "specimen"][:RESEMBLED]
    return f"resembles {'; '.join(told)}" if told else "–"


def remarks(outcomes: Sequence[Outcome], one: MeasuredSet) -> str:
    """How often the names come again, and what the files say, in counts."""
    alike = sum(outcome.failed is None and not judge.unlike(outcome) for outcome in outcomes)
    naming = judge.same_names(judge.naming(outcomes))
    within = [
        f"{some} of {most} from `{base}`{'' if (one.name, base) in naming else ' (none is named)'}"
        for (_, base), (some, most) in judge.same_names(outcomes).items()
    ]
    guilty = sum(bool(judge.accused(outcome, one.known_faults)) for outcome in outcomes)
    near, admitted = (sum(map(of, outcomes)) for of in (judge.near, judge.admitted))
    return "\n".join(
        [
            *([f"- The same names: {', '.join(within)}."] if within else []),
            f"- Told errors are those of the files, read again: {alike} of {len(outcomes)}.",
            f"- A fault of the rig that the owners do not know of: {guilty} of {len(outcomes)}.",
            f"- Within {judge.NEAR} times the explainable error on held-out runs: {near} of {len(outcomes)}.",
            f"- Said to be unexplained or partly explained: {admitted} of {len(outcomes)}.",
        ]
    )


def index(found: dict[str, list[Outcome]], older: int) -> Iterator[str]:
    """The page that leads to the others; ``older`` trials were run by an earlier engine than the present one."""
    yield "# Measured by others"
    yield (
        "What dashpot says of measurements by others: each set from two shipped networks, with up to three draws "
        "of the held-out runs, and once more with a fifth of the training runs removed (fewer runs). The errors are "
        "those of the written files, read again and simulated."
    )
    yield table(INDEX, [index_row(name, outcomes) for name, outcomes in found.items()])
    yield "\n".join(f"- {line}" for line in summary([one for each in found.values() for one in each]))
    if older:
        yield (
            f"{older} of them were run by an earlier state of dashpot than the present one: "
            "names and probabilities can differ."
        )
    yield f"## {READING}"
    yield WORDS
    yield "```{toctree}\n:hidden:\n\n" + "\n".join(found) + "\n```"
    yield (
        "Where the sets lie beside the repository, `python tests/real/run.py --keep results` runs all diagnoses, "
        "and `python tests/real/pages.py --keep results` writes these pages."
    )


def index_row(name: str, outcomes: Sequence[Outcome]) -> tuple[str, ...]:
    """What the diagnoses of a set come to, in counts and shares."""
    again = [judge.same_names(some) for some in (outcomes, judge.naming(outcomes))]
    return (
        f"[{SETS[name].title}]({name}.md)",
        str(len(outcomes)),
        str(sum(map(judge.near, outcomes))),
        str(sum(map(judge.admitted, outcomes))),
        *(f"{judge.share(counts):.0%}" if counts else "–" for counts in again),
        str(sum(bool(judge.accused(one, SETS[name].known_faults)) for one in outcomes)),
    )


def kept_trials(one: MeasuredSet, keep: Path) -> list[tuple[Trial, Outcome]]:
    """The trials of a set whose outcome was kept."""
    folders = [(trial, keep / one.name / trial.word) for trial in trials(one)]
    return [(trial, known[1]) for trial, folder in folders if (known := kept_outcome(folder))]


def older_trials(one: MeasuredSet, keep: Path) -> int:
    """How many kept trials of a set were run by another engine than the present one."""
    kept = [kept_outcome(keep / one.name / trial.word) for trial in trials(one)]
    return sum(known is not None and not is_current(*known) for known in kept)


def main() -> None:
    """Write the pages of all sets with kept trials, and the index over every page that there is."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", type=Path, required=True, help="folder of the trials")
    parser.add_argument("--output", type=Path, default=PAGES)
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    found, older = {}, 0
    for name, one in SETS.items():
        kept = kept_trials(one, options.keep.resolve())
        if kept and one.present:
            parts = page(one, kept, options.keep.resolve(), options.output)
            (options.output / f"{name}.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
            found[name] = [outcome for _, outcome in kept]
            older += older_trials(one, options.keep.resolve())
            print(options.output / f"{name}.md")
    (options.output / "index.md").write_text("\n\n".join(index(found, older)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
