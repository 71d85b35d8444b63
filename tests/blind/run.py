"""The blind benchmark as a command: ``python tests/blind/run.py --cases 60 --seed 7``.

Cases are drawn from seeds; the engine sees a folder, its verdict is recorded, only then the label is opened. Prints the
confusion matrix and the rates, with the seed that repeats them.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from score import Outcome, print_table, summary
from truth import draw_case

POLYNOMIAL = """\
format: dashpot-network/1
name: polynomial
branches:
  stiffness:
    element: spring
    stiffness: {polynomial: [{start: 200 N/mm}, {start: 1 N/mm^2}]}
  damping: {element: damper, damping: {start: 100 N*s/m}}
"""


def diagnose_case(case, base: str, jobs: int):
    """The verdict of the engine on a case's folder."""
    from dashpot.assess.diagnose import diagnose
    from dashpot.contract.registry import load_registry
    from dashpot.data.dataset import read_dataset
    from dashpot.model.reading import parse_network, read_network

    registry = load_registry()
    dataset = read_dataset(case.folder, {word: reader() for word, reader in registry.formats.items()})
    if base == "polynomial":
        spec = parse_network(POLYNOMIAL, registry.elements)
    else:
        spec = read_network(base, registry.elements)
    return diagnose(spec, dataset, jobs=jobs, registry=registry).as_dict()


def run_case(seed: int, base: str, kind: str | None, strength: float | None, design: str, jobs: int) -> Outcome:
    """Draw, diagnose, record the verdict, open the label."""
    case = draw_case(seed, base, kind, strength, design=design)
    began = time.perf_counter()
    verdict = diagnose_case(case, base, jobs)
    seconds = time.perf_counter() - began
    named = [cause["cause"] for cause in verdict["causes"]]
    truth = case.label.open(json.dumps({"verdict": verdict["verdict"], "named": named}))
    return Outcome(seed, base, truth, verdict, seconds)


def main() -> None:
    """Run the cases that were asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=30)
    parser.add_argument("--seed", type=int, default=None, help="repeats a run; drawn anew without it")
    parser.add_argument("--base", nargs="*", default=["kelvin_voigt", "spring", "ftire", "polynomial"])
    parser.add_argument("--kind", default=None, help="a cause word, 'null', or words joined by '+'")
    parser.add_argument(
        "--strength", type=float, default=None, help="effect over noise; drawn from 0.3 to 10 without it"
    )
    parser.add_argument("--design", default="full")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--output", type=Path, default=None, help="a JSON file for all outcomes")
    options = parser.parse_args()
    first = int.from_bytes(os.urandom(4), "little") if options.seed is None else options.seed
    print(f"seed {first}: --seed {first} repeats this run")
    outcomes = []
    for number in range(options.cases):
        base = options.base[number % len(options.base)]
        kind = "stiffness_curve" if base == "polynomial" and options.kind is None else options.kind
        outcome = run_case(first + number, base, kind, options.strength, options.design, options.jobs)
        outcomes.append(outcome)
        print(outcome.line(), flush=True)
        if options.output:  # what was done stays when the run is interrupted
            options.output.write_text(json.dumps({"seed": first, **summary(outcomes)}, indent=1) + "\n")
    print_table(outcomes)


if __name__ == "__main__":
    main()
