"""The pages of the documentation on measured sets: ``python tests/real/pages.py --keep results``.

Written from the trials that ``run.py`` keeps in a folder. Pictures are drawn from the measurements, which have to be
beside the repository; without a set its page stays as it is.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from real import judge
from real.catalogue import SETS
from real.pictures import pictures
from real.run import summary, trials
from real.sets import MeasuredSet
from real.trial import Outcome, Trial, engine_digest, kept_outcome

import dashpot

PAGES = Path(__file__).resolve().parents[2] / "docs" / "real"
RESEMBLED = 3  # causes that are listed where none is named
Kept = Sequence[tuple[Trial, Outcome]]


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def short(value: float | None) -> str:
    """A force in N, or in kN."""
    if value is None:
        return "–"
    return f"{value / 1e3:.3g} kN" if value >= 1e4 else f"{value:.3g} N"


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
    drawn = pictures(seen, *final, folder / one.name) if final else []
    if final:
        name = f"`{final[0].stem}`"
        yield f"Black is measured, blue the written file {name}: the one with the smallest error on training runs."
        yield "\n\n".join(f"![{words}]({path.name})" for words, path in drawn)
    yield "## What can be explained"
    rows = [
        ("noise floor", short(look["noise_floor"].get("value"))),
        ("explainable, on held-out runs", short(look["explainable"].get("held_out"))),
    ]
    yield table(("error (seed 0)", ""), rows)
    yield (
        "Explainable is what [a general model of the past motion](../explanation/look.md#the-explainable-error) "
        "leaves on runs that it has not seen; it differs with the runs that are held out."
    )
    yield "## What is diagnosed"
    yield diagnoses([outcome for _, outcome in kept])
    yield remarks([outcome for _, outcome in kept], one)


def told_runs(runs: Sequence[dict[str, object]]) -> str:
    """Numbers of the runs in a sentence or two."""

    def reach(key: str, factor: float) -> str:
        values = [factor * float(run[key]) for run in runs]
        low, high = f"{min(values):.3g}", f"{max(values):.3g}"
        return low if low == high else f"{low} to {high}"

    largest = max(abs(float(run[key])) for run in runs for key in ("least_force", "largest_force"))
    back = [str(run["run"]) for run in runs if run["gives_back"]]
    energy = f"Work is given back by {', '.join(back)}." if back else "Every run takes up work."
    return (
        f"{len(runs)} runs of {reach('duration', 1.0)} s at {reach('sampling', 1.0)} Hz, amplitudes of "
        f"{reach('amplitude', 1e3)} mm, peak speeds of {reach('peak_speed', 1e3)} mm/s, forces up to "
        f"{short(largest)}. {energy}"
    )


def best_file(kept: Kept, folder: Path) -> tuple[Path, Path] | None:
    """The network with the smallest error on training runs, of the first seed and all runs; and its folder."""
    whole = [
        (outcome.files["after.train"], trial)
        for trial, outcome in kept
        if "after.train" in outcome.files and not trial.fewer and trial.seed == kept[0][0].seed
    ]
    if not whole:
        return None
    trial = min(whole, key=lambda pair: pair[0])[1]
    found = folder / trial.word / "diagnosis"
    told = json.loads((found / "diagnosis.json").read_text())
    return found / (told["extended_model"] or told["fitted_model"]), found


def diagnoses(outcomes: Sequence[Outcome]) -> str:
    """A line for each diagnosis."""
    rows = [
        (
            f"`{one.base}`",
            f"{one.seed}{', a fifth of the runs removed' if one.fewer else ''}",
            one.verdict.replace("_", " "),
            "; ".join(_said(cause) for cause in one.causes if cause["class"] == "specimen") or _resembled(one),
            "; ".join(
                [
                    *(_said(cause) for cause in one.causes if cause["class"] == "measurement"),
                    *(f"{fault['kind'].replace('_', ' ')} of {fault['run']}" for fault in one.faults),
                ]
            )
            or "–",
            short(one.files.get("before.held_out")),
            short(one.files.get("after.held_out")),
            short(one.explainable),
        )
        for one in outcomes
    ]
    head = (
        "from",
        "seed",
        "verdict",
        "missing in the model (probability)",
        "faults of the measurement",
        "file before, held out",
        "file after, held out",
        "explainable",
    )
    return table(head, rows)


def _said(cause: dict[str, object]) -> str:
    link = f"[{str(cause['cause']).replace('_', ' ')}](../generated/causes.md#{str(cause['cause']).replace('_', '-')})"
    rivals = cause["indistinguishable_from"]
    beside = f" or {' or '.join(str(rival).replace('_', ' ') for rival in rivals)}" if rivals else ""
    return f"{'probably ' * (cause['standing'] == 'probable')}{link}{beside} ({float(cause['probability']):.2g})"


def _resembled(outcome: Outcome) -> str:
    """The first few that the force resembles where nothing of the specimen is named."""
    told = [_said(cause) for cause in outcome.resembled if cause["class"] == "specimen"][:RESEMBLED]
    return f"resembles {'; '.join(told)}" if told else "–"


def remarks(outcomes: Sequence[Outcome], one: MeasuredSet) -> str:
    """How often the names come again, and what the files say, in counts."""
    alike = sum(outcome.failed is None and not judge.unlike(outcome) for outcome in outcomes)
    within = [f"{some} of {most} from `{base}`" for (_, base), (some, most) in judge.same_names(outcomes).items()]
    guilty = sum(bool(judge.accused(outcome, one.known_faults)) for outcome in outcomes)
    near = sum(map(judge.near_or_admitted, outcomes))
    return "\n".join(
        [
            *([f"- The same names: {', '.join(within)}."] if within else []),
            f"- Told errors are those of the files, read again: {alike} of {len(outcomes)}.",
            f"- A fault of the rig that the owners do not know of: {guilty} of {len(outcomes)}.",
            f"- Within {judge.NEAR} times the explainable error on held-out runs, or said to be unexplained or partly "
            f"explained: {near} of {len(outcomes)}.",
        ]
    )


def index(found: dict[str, list[Outcome]], older: int) -> Iterator[str]:
    """The page that leads to the others; ``older`` trials were run by an earlier engine than the present one."""
    yield "# Measured by others"
    yield (
        "What dashpot says of measurements by others: each set from two shipped networks, with up to three draws "
        "of the held-out runs, and once more with a fifth of the runs removed. The errors are those of the written "
        "files, read again and simulated."
    )
    rows = [
        (
            f"[{SETS[name].title}]({name}.md)",
            str(len(outcomes)),
            str(sum(map(judge.near_or_admitted, outcomes))),
            f"{judge.share(again):.0%}" if (again := judge.same_names(outcomes)) else "–",
            str(sum(bool(judge.accused(one, SETS[name].known_faults)) for one in outcomes)),
        )
        for name, outcomes in found.items()
    ]
    head = ("set", "diagnoses", "near the explainable error, or admitted", "same names", "accuse the rig")
    yield table(head, rows)
    yield "\n".join(f"- {line}" for line in summary([one for each in found.values() for one in each]))
    if older:
        yield (
            f"{older} of them were run by an earlier state of dashpot than the present one: "
            "names and probabilities can differ."
        )
    yield "```{toctree}\n:hidden:\n\n" + "\n".join(found) + "\n```"
    yield (
        "Where the sets lie beside the repository, `python tests/real/run.py --keep results` runs all diagnoses, "
        "and `python tests/real/pages.py --keep results` writes these pages."
    )


def kept_trials(one: MeasuredSet, keep: Path) -> list[tuple[Trial, Outcome]]:
    """The trials of a set whose outcome was kept."""
    folders = [(trial, keep / one.name / trial.word) for trial in trials(one)]
    return [(trial, known[1]) for trial, folder in folders if (known := kept_outcome(folder))]


def older_trials(one: MeasuredSet, keep: Path) -> int:
    """How many kept trials of a set were run by another engine than the present one."""
    kept = [kept_outcome(keep / one.name / trial.word) for trial in trials(one)]
    return sum(known is not None and known[0] != engine_digest() for known in kept)


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
