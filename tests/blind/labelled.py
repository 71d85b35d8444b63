"""Cases of other makers as a command: ``python tests/blind/labelled.py cases/main cases/null --keep results``.

Each folder holds datasets and a ``labels.json``: for every case the folder, the hidden effects, their strengths in
units of the noise, and for each effect the cause words that count as right. Words in capitals stand for a verdict:
NOTHING for nothing_missing, UNEXPLAINED for unexplained. Labels are read when all cases of a folder are diagnosed.
Finished cases are kept, and not run again.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, str(Path(__file__).parents[1]))

from real.trial import DASHPOT, Spent, measured_command
from reliability import Told, as_text, brier, reliability

STRONG = 1.0  # of the noise: such an effect is to be named
SURE = 0.9  # nine of ten names that are told with this are to be right
VERDICTS = {"NOTHING": "nothing_missing", "UNEXPLAINED": "unexplained"}


@dataclass(frozen=True)
class Judged:
    """What was said of a case, beside its label.

    ``hidden`` are the effects, ``strengths`` in units of the noise, ``accept`` the words that count as right for each.
    ``found`` is the content of ``diagnosis.json``, None where the command failed.
    """

    case: str
    hidden: Sequence[str]
    strengths: Sequence[float]
    accept: Sequence[Sequence[str]]
    found: Mapping[str, Any] | None
    spent: Spent

    @property
    def verdict(self) -> str:
        """The verdict."""
        return self.found["verdict"] if self.found else "failed"

    @property
    def names(self) -> list[str]:
        """The causes that were named, best first."""
        return [one["cause"] for one in self.found["causes"] if one["accepted"]] if self.found else []

    @property
    def hits(self) -> list[bool]:
        """Whether each of the effects was named."""
        told = {*self.names, *(word for word, verdict in VERDICTS.items() if verdict == self.verdict)}
        return [bool(told & set(words)) for words in self.accept]

    @property
    def surplus(self) -> list[str]:
        """Names of what is not hidden."""
        return [name for name in self.names if not any(name in words for words in self.accept)]

    @property
    def exact(self) -> bool:
        """Whether every effect was named, and nothing else."""
        return self.found is not None and all(self.hits) and not self.surplus

    @property
    def confidently_wrong(self) -> bool:
        """Whether all is explained, it says, by causes of which none is hidden."""
        return self.verdict == "explained" and len(self.surplus) == len(self.names)

    @property
    def told(self) -> list[Told]:
        """The probability of every cause in the written file, and whether it is hidden."""
        causes = self.found["causes"] if self.found else []
        return [(one["probability"], any(one["cause"] in words for words in self.accept)) for one in causes]

    def line(self) -> str:
        """The case in a line; an effect that was not named has an exclamation mark."""
        pairs = zip(self.hidden, self.strengths, self.hits, strict=True)
        hidden = ", ".join(f"{name} {strength:.2g}{'' if hit else '!'}" for name, strength, hit in pairs)
        causes = self.found["causes"] if self.found else []
        said = [f"{one['cause']} {one['probability']:.2f}{'?' * (not one['accepted'])}" for one in causes]
        mark, names = "ok " if self.exact else "   ", ", ".join(said) or self.spent.failed or "-"
        return f"{mark} {self.case}: {hidden or '-'} -> {self.verdict}: {names} [{self.spent.seconds:.0f} s]"


def diagnosed(model: str, seed: int, keep: Path, case: Path) -> tuple[Mapping[str, Any] | None, Spent]:
    """A case diagnosed by command, or what is kept of it."""
    folder = keep / case.parent.name / case.name
    spent, result = folder / "spent.json", folder / "diagnosis" / "diagnosis.json"
    if not spent.exists():
        folder.mkdir(parents=True, exist_ok=True)
        command = [*DASHPOT, "diagnose", model, case, "-o", result.parent, "--seed", seed, "--jobs", 1, "--force"]
        took = measured_command([*map(str, command), "--quiet"], folder / "log.txt")
        spent.write_text(json.dumps(asdict(took)) + "\n")
    took = Spent(**json.loads(spent.read_text()))
    return (None if took.failed else json.loads(result.read_text())), took


def judged(root: Path, model: str, seed: int, keep: Path, jobs: int, cases: slice) -> list[Judged]:
    """The cases of a folder, diagnosed; then the labels are opened."""
    folders = sorted(path.parent for path in root.glob("*/dataset.yaml"))[cases]
    if not folders:
        raise SystemExit(f"{root}: expected folders with a dataset.yaml beside labels.json, got none")
    with ThreadPoolExecutor(jobs) as pool:
        found = list(pool.map(partial(diagnosed, model, seed, keep), folders))
    labels = {one["case"]: one for one in json.loads((root / "labels.json").read_text())["cases"]}
    pairs = ((labels[folder.name], said) for folder, said in zip(folders, found, strict=True))
    return [Judged(one["case"], one["hidden"], one["strength"], one["accept"], *said) for one, said in pairs]


def summary(cases: Sequence[Judged]) -> Iterator[str]:
    """The rates of some cases."""
    strong = [hit for one in cases for hit, strength in zip(one.hits, one.strengths, strict=True) if strength >= STRONG]
    names = [name for one in cases for name in one.names]
    told = [each for one in cases for each in one.told]
    sure = [right for probability, right in told if probability >= SURE]
    score = brier(told)
    yield f"exact: {sum(one.exact for one in cases)} of {len(cases)}"
    yield f"effects of {STRONG:g} x noise and more named: {sum(strong)} of {len(strong)}"
    yield f"surplus names: {sum(len(one.surplus) for one in cases)} of {len(names)}"
    yield f"confidently wrong: {sum(one.confidently_wrong for one in cases)} of {len(cases)}"
    yield f"told with {SURE:g} and more and right: {sum(sure)} of {len(sure)}"
    yield f"Brier score: {score:.3f}" if score is not None else "Brier score: no name"
    seconds, megabytes = sorted(one.spent.seconds for one in cases), max(one.spent.megabytes for one in cases)
    yield f"s: median {seconds[len(seconds) // 2]:.0f}, most {seconds[-1]:.0f}; MB at most: {megabytes:.0f}"
    yield f"failed: {sum(one.found is None for one in cases)}"


def main() -> None:
    """Diagnose, open the labels, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=Path, nargs="+", metavar="FOLDER")
    parser.add_argument("--model", default="kelvin_voigt", help="the network that is diagnosed")
    parser.add_argument("--keep", type=Path, required=True, help="folder for the results")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, help="cases side by side")
    parser.add_argument("--cases", default=":", help="which of them, as 0:10")
    given = parser.parse_args()
    cases = slice(*(int(end) if end else None for end in given.cases.split(":")))
    everything = []
    for root in given.folders:
        found = judged(root, given.model, given.seed, given.keep, given.jobs, cases)
        print("\n".join([root.name, *(one.line() for one in found), *summary(found), ""]), flush=True)
        everything += found
    told = [each for one in everything for each in one.told]
    print("\n".join(["all", *summary(everything), "", as_text(reliability(told))]))


if __name__ == "__main__":
    main()
