"""Every optimizer on every problem of the zoo: `python tests/zoo/run.py --seeds 20`, with `--write` into the docs.

Printed are the share of seeds that come within 1.01 x noise floor, from a random start, and the median number of
parameter vectors of those that do.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from zoo.problems import GOAL, ZOO, evaluations_to_goal  # noqa: E402

from dashpot import load_registry  # noqa: E402

PAGE = Path(__file__).resolve().parents[2] / "plugins" / "README.md"
BEGIN, END = "<!-- measured: zoo -->", "<!-- end: zoo -->"
CHAINS = ("pso+least_squares", "cmaes+least_squares")


def methods() -> list[str]:
    """Every optimizer that is installed and has its library, and two chains."""
    known = load_registry().optimizers
    return [*(word for word, made in known.items() if not made.missing()), *CHAINS]


def cell(word: str, problem: str, seeds: int, first: int, budget: int) -> str:
    """Success rate and median cost of one method on one problem."""
    spent = np.array([evaluations_to_goal(word, problem, [first, number], budget) for number in range(seeds)])
    reached = spent[np.isfinite(spent)]
    share = f"{100.0 * reached.size / seeds:.0f} %"
    return f"{share}, {np.median(reached):.0f}" if reached.size else share


def page_with(table: str) -> str:
    """The page with the table between its comments."""
    text = PAGE.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    return head + f"{BEGIN}\n\n{table}\n\n{END}" + rest.split(END)[1]


def main() -> None:
    """Print the table, and write it where that is wanted."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--budget", type=int, default=20_000)
    parser.add_argument("--write", action="store_true")
    given = parser.parse_args()
    rows = [["optimizer", *ZOO], ["---"] * (1 + len(ZOO))]
    for word in methods():
        began = time.perf_counter()
        rows.append([f"`{word}`", *(cell(word, name, given.seeds, given.first, given.budget) for name in ZOO)])
        print(" | ".join(rows[-1]), f"({time.perf_counter() - began:.0f} s)", flush=True)
    table = "\n".join("| " + " | ".join(row) + " |" for row in rows)
    about = f"{given.seeds} seeds, at most {given.budget} parameter vectors, goal {GOAL:g} x noise floor:"
    print(f"\n{about}\n\n{table}")
    if given.write:
        PAGE.write_text(page_with(f"{about}\n\n{table}"), encoding="utf-8")


if __name__ == "__main__":
    main()
