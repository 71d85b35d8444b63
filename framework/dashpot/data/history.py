"""What a specimen has gone through before a run: the runs of a dataset stand in the order in which they were made."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from dashpot.data.run import Run

# settings that every run of a dataset with one displacement has: the largest deflection before it in m, and of the last
# run before it the integral of the squared velocity in m^2/s. Both tell of motions, so that no measured force, as one
# of a held-out run, ever becomes an input of a simulation
REACHED, MOVED = "reached", "moved"
NOTHING = {REACHED: 0.0, MOVED: 0.0}


def with_history(made: Iterable[tuple[Run, bool]]) -> Iterator[Run]:
    """The runs that count, of (run, whether it counts), knowing how far and how fast the specimen was moved before.

    What a run itself states as the setting ``reached`` counts from there on. A run without a displacement is none.
    """
    reached, moved = 0.0, list[float]()
    for run, counts in made:
        reached = max(reached, run.settings.get(REACHED, 0.0))
        if counts:
            each = {name_of(MOVED, earlier): value for earlier, value in enumerate(reversed(moved))}
            yield replace(run, history={REACHED: reached, **each})
        if "displacement" in run.channels:
            reached = max(reached, float(np.max(np.abs(run.displacement))))
            moved.append(float(np.sum(np.gradient(run.displacement) ** 2)) / run.sample_time)


def runs_before(settings: Mapping[str, float], word: str) -> list[float]:
    """What a setting that is told of every run was in the runs before, the last one first: `moved 2` is the last but
    one.
    """
    found: list[float] = []
    while (name := name_of(word, len(found))) in settings:
        found.append(settings[name])
    return found


def knowing_better(run: Run, wrong: Run, displacement: float) -> Run:
    """A run that knows of a wrong one before it how much it moved with its displacement times this factor."""
    earlier = len(runs_before(run.history, MOVED)) - len(runs_before(wrong.history, MOVED)) - 1
    name = name_of(MOVED, earlier)
    if earlier < 0 or name not in run.history:
        return run
    return replace(run, history={**run.history, name: run.history[name] * displacement**2})


def corrected_reach(runs: Iterable[Run], factors: Mapping[str, float]) -> dict[str, float]:
    """The setting ``reached`` by run, where the displacements of some runs are put right by ``factors``.

    What is in no run that is here, as one that was set aside, counts where it shows in what a run knew. Runs that are
    one of several ends know nothing of how far the specimen was deflected.
    """
    found, said, reached = dict[str, float](), 0.0, 0.0
    for run in (run for run in runs if REACHED in run.history and not run.end):
        known = run.history[REACHED]
        reached = max(reached, run.settings.get(REACHED, 0.0), known if known > said else 0.0)
        found[run.name] = reached
        far = float(np.max(np.abs(run.displacement)))
        said = max(known, far)
        reached = max(reached, far * abs(factors.get(run.name, 1.0)))
    return found


def name_of(word: str, earlier: int) -> str:
    """The setting that tells of the run before, or of one so many runs earlier."""
    return f"{word} {earlier + 1}" if earlier else word


def is_history(name: str) -> bool:
    """Whether a setting tells of the runs before."""
    word, _, number = name.partition(" ")
    return word in NOTHING and (not number or (word == MOVED and number.isdecimal()))
