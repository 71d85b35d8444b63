"""The blind benchmark as a command: ``python tests/blind/run.py --cases 60 --seed 7``.

Cases are drawn from seeds; the engine sees a folder, its verdict is recorded, only then the label is opened. Prints the
confusion matrix and the rates, with the seed that repeats them.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from score import Outcome, print_table, summary
from truth import KINDS_OF_BASE, draw_case

NETWORKS = Path(__file__).parent / "networks"


@dataclass(frozen=True)
class Bench:
    """How cases are made and diagnosed.

    ``design``: which runs are driven; ``sensors``: the force channel errs within its data sheet; ``without``: the
    engine is robbed of the cause plugins that would name what is hidden.
    """

    design: str = "full"
    sensors: bool = False
    without: bool = False
    jobs: int = 2

    def run(self, seed: int, base: str, kind: str | None = None, strength: float | None = None) -> Outcome:
        """Draw, diagnose, record the verdict, open the label."""
        if self.without and kind is None:
            kind = random.Random(seed).choice(KINDS_OF_BASE[base])
        case = draw_case(seed, base, kind, strength, design=self.design, sensors=self.sensors)
        began = time.perf_counter()
        verdict = diagnose_folder(case.folder, base, self.jobs, kind.split("+") if self.without else [])
        seconds = time.perf_counter() - began
        named = [cause["cause"] for cause in verdict["causes"]]
        truth = case.label.open(json.dumps({"verdict": verdict["verdict"], "named": named}))
        return Outcome(seed, base, truth, verdict, seconds, self.without)


def diagnose_folder(folder: Path, base: str, jobs: int, without: list[str]) -> dict:
    """The verdict of the engine on a dataset, from the network of a base, without the plugins of some causes."""
    from dashpot.assess.diagnose import diagnose
    from dashpot.contract.registry import load_registry
    from dashpot.data.dataset import read_dataset
    from dashpot.model.reading import read_network

    registry = load_registry()
    registry = replace(registry, causes={word: c for word, c in registry.causes.items() if word not in without})
    dataset = read_dataset(folder, {word: reader() for word, reader in registry.formats.items()})
    own = NETWORKS / f"{base}.yaml"
    spec = read_network(own if own.exists() else base, registry.elements)
    return diagnose(spec, dataset, jobs=jobs, registry=registry).as_dict()


def command_of(options: argparse.Namespace, seed: int, cases: int) -> str:
    """What repeats the cases of a run."""
    words = ["python tests/blind/run.py", f"--cases {cases}", f"--seed {seed}", f"--base {' '.join(options.base)}"]
    words += [f"--{key} {value}" for key in ("kind", "strength") if (value := getattr(options, key)) is not None]
    words += [f"--design {options.design}"] if options.design != "full" else []
    return " ".join(words + [f"--{flag}" for flag in ("sensors", "without") if getattr(options, flag)])


def main() -> None:
    """Run the cases that were asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=30)
    parser.add_argument("--seed", type=int, default=None, help="repeats a run; drawn anew without it")
    parser.add_argument("--base", nargs="*", default=list(KINDS_OF_BASE), choices=list(KINDS_OF_BASE))
    parser.add_argument("--kind", default=None, help="a cause word, 'null', or words joined by '+'")
    parser.add_argument(
        "--strength", type=float, default=None, help="effect over noise; drawn from 0.1 to 10 without it"
    )
    parser.add_argument("--design", default="full")
    parser.add_argument("--sensors", action="store_true", help="the force channel errs within its data sheet")
    parser.add_argument("--without", action="store_true", help="the engine lacks the plugin of what is hidden")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--output", type=Path, default=None, help="a JSON file for all outcomes")
    options = parser.parse_args()
    first = int.from_bytes(os.urandom(4), "little") if options.seed is None else options.seed
    print(f"seed {first}: --seed {first} repeats this run")
    bench = Bench(options.design, options.sensors, options.without, options.jobs)
    outcomes = []
    for number in range(options.cases):
        base = options.base[number % len(options.base)]
        outcomes.append(bench.run(first + number, base, options.kind, options.strength))
        print(outcomes[-1].line(), flush=True)
        if options.output:  # what was done stays when the run is interrupted
            kept = {"seed": first, "command": command_of(options, first, len(outcomes)), **summary(outcomes)}
            options.output.write_text(json.dumps(kept, indent=1) + "\n")
    print_table(outcomes)


if __name__ == "__main__":
    main()
