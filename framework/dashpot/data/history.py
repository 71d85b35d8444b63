"""What a specimen has gone through before a run: the runs of a dataset stand in the order in which they were made."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from dashpot.data.run import Run

# settings that every run of a dataset with one displacement has: the largest deflection before it in m, and of the last
# run before it the integral of the squared velocity in m^2/s and the work that the specimen took up in J
REACHED, MOVED, WORKED = "reached", "moved", "worked"
NOTHING = {REACHED: 0.0, MOVED: 0.0, WORKED: 0.0}
EACH = (MOVED, WORKED)  # those that are told of every run before: `worked 2` is that of the last but one


def with_history(made: Iterable[tuple[Run, bool]]) -> Iterator[Run]:
    """The runs that count, of (run, whether it counts), knowing how far, how fast and by what work the specimen was
    moved before.

    What a run itself states as the setting ``reached`` counts from there on. A run without a displacement is none; one
    without a force has taken up no work.
    """
    reached = 0.0
    before: dict[str, list[float]] = {word: [] for word in EACH}
    for run, counts in made:
        reached = max(reached, run.settings.get(REACHED, 0.0))
        if counts:
            each = {name: value for word in EACH for name, value in _named(word, before[word])}
            yield replace(run, history={REACHED: reached, **each})
        if "displacement" in run.channels:
            reached = max(reached, float(np.max(np.abs(run.displacement))))
            before[MOVED].append(float(np.sum(np.gradient(run.displacement) ** 2)) / run.sample_time)
            before[WORKED].append(_work(run))


def runs_before(settings: Mapping[str, float], word: str) -> list[float]:
    """What a setting of `EACH` was in the runs before, the last one first."""
    found: list[float] = []
    while (name := name_of(word, len(found))) in settings:
        found.append(settings[name])
    return found


def knowing_better(run: Run, wrong: Run, force: float, displacement: float) -> Run:
    """A run that knows of a wrong one before it how much it moved and worked with its channels times these factors."""
    factors = {MOVED: displacement**2, WORKED: abs(force * displacement)}
    earlier = {word: len(runs_before(run.history, word)) - len(runs_before(wrong.history, word)) - 1 for word in EACH}
    better = {
        name: run.history[name] * factors[word]
        for word in EACH
        if earlier[word] >= 0 and (name := name_of(word, earlier[word])) in run.history
    }
    return replace(run, history={**run.history, **better})


def name_of(word: str, earlier: int) -> str:
    """The setting that tells of the run before, or of one so many runs earlier."""
    return f"{word} {earlier + 1}" if earlier else word


def is_history(name: str) -> bool:
    """Whether a setting tells of the runs before."""
    word, _, number = name.partition(" ")
    return word in NOTHING and (not number or (word in EACH and number.isdecimal()))


def _named(word: str, values: list[float]) -> Iterator[tuple[str, float]]:
    for earlier, value in enumerate(reversed(values)):
        yield name_of(word, earlier), value


def _work(run: Run) -> float:
    """The work in J that a run has turned into heat, by its size, as the sign of a channel may be wrong.

    What a path that does not close has left in the spring is taken off along a straight line back to its beginning.
    """
    if "force" not in run.channels:
        return 0.0
    force, path = run.force, run.displacement
    done = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(path)))
    return abs(done - 0.5 * float((force[0] + force[-1]) * (path[-1] - path[0])))
