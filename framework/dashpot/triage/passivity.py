"""What runs that give work back over closed cycles most likely are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.data.resample import advance
from dashpot.data.run import Run
from dashpot.text.quantity import pretty
from dashpot.triage.agreement import MOSTLY
from dashpot.triage.energy import giving_back, runs_that_give_back, turned, works_of
from dashpot.triage.fault import ENERGY, Fault
from dashpot.triage.forecast import Sizes, compared, fitted, moments_of_run, swapped
from dashpot.triage.others import Others, Signals, farthest, missed, signals_of, unlike
from dashpot.triage.work import CycleWork

Array = NDArray[np.float64]

FEWEST_OTHERS = 2
FEWEST_TOGETHER = 2  # runs: what a single one has may be its own


@dataclass(frozen=True, eq=False)
class _Try:
    """A run as it would be without a fault, and how much of its force the others do not explain then.

    ``known`` says whether they have been where it would be.
    """

    kind: str
    unlike: float
    known: bool
    words: str
    cure: str
    factor: float | None = None
    channel: str = "force"


def work_faults(runs: Sequence[Run]) -> tuple[list[Fault], list[str]]:
    """The runs that give back work, each with what would correct it, and what is to be remarked of all runs."""
    works = works_of(runs)
    accused = giving_back(runs, works)
    bad = [run for run in runs if run.name in accused]
    sound = [run for run in runs if run.name in works and run.name not in accused]
    delay = _common_delay(bad, sound, works)
    if delay is not None:
        names = ", ".join(f"'{run.name}'" for run in bad)
        return [], [
            f"{names} give back work, which no passive specimen does; with the force of all runs earlier by "
            f"{pretty(delay, 's', 2)} or more none does: it comes late in all of them. Let the network identify the "
            "delay ('measurement:'), or write it under the force channel of all runs"
        ]
    if together := _turned_together(bad, sound, works):
        return [*together, *_turned_like(together, runs, works)], []
    return [_fault_of(run, works[run.name], sound) for run in bad], [] if bad else _all_pull(runs, works)


def _all_pull(runs: Sequence[Run], works: Mapping[str, CycleWork]) -> list[str]:
    """A remark where no run is certain to give back work, but all do, and each pulls along with its deflection."""
    judged = [run for run in runs if run.name in works]
    if len(judged) < FEWEST_TOGETHER or any(works[run.name].mean >= 0.0 or not _pulls(run) for run in judged):
        return []
    return [
        f"In all {len(judged)} runs with closed cycles the force falls as the deflection grows, and no work is taken "
        "up: where the signs of force and deflection are opposite, write 'sign: -1' under the force channel of all runs"
    ]


def _turned_together(bad: Sequence[Run], sound: Sequence[Run], works: Mapping[str, CycleWork]) -> list[Fault]:
    """The one fault of most runs: each of them pulls along with its deflection and takes up work if turned round.

    Where all runs do, or may, one that gives back work beyond doubt is enough.
    """
    every = len(bad) > 0 and len(bad) + len(sound) >= FEWEST_TOGETHER and _may_be_turned(sound, works)
    if not (every or (len(bad) >= FEWEST_TOGETHER and len(bad) > len(sound))):
        return []
    if any(_by_itself(run, works[run.name]).kind != "polarity" for run in bad):
        return []
    wrong = [*bad, *sound] if every else bad
    shares = [-works[run.name].power_factor for run in bad]
    given = "work is given back over closed cycles" if every else f"{len(bad)} of {len(works)} runs give back work"
    evidence = (
        f"{given}, {min(shares):.1%} to {max(shares):.1%} of what goes to and fro, which no passive specimen does; "
        f"with the force turned round it is taken up: the force of {'all' if every else 'most'} runs has the wrong sign"
    )
    cure = f"Write 'sign: -1' under the force channel of {'all' if every else 'these'} runs"
    return [Fault(run.name, "polarity", evidence, cure, -1.0, evidence_of=ENERGY) for run in wrong]


def _may_be_turned(runs: Sequence[Run], works: Mapping[str, CycleWork]) -> bool:
    """Whether each of some runs pulls along with its deflection, and none would give back work if it were turned."""
    pull = all(_by_itself(run, works[run.name]).kind == "polarity" for run in runs)
    return pull and not runs_that_give_back([turned(run) for run in runs])


def _turned_like(known: Sequence[Fault], runs: Sequence[Run], works: Mapping[str, CycleWork]) -> Iterator[Fault]:
    """The same fault of each run without closed cycles whose force goes the way of the turned ones, as measured."""
    named = {fault.run for fault in known}
    like = [run for run in runs if run.name in named]
    others = [run for run in runs if run.name not in works and np.ptp(run.displacement) > 0.0]
    sizes = Sizes.of(like)
    coefficients = fitted([moments_of_run(run, sizes) for run in like])
    every = named == set(works)
    for run in others:
        gain, likeness = compared(moments_of_run(run, sizes), coefficients)
        if (gain > 0.0 and likeness >= MOSTLY) or (every and _pulls(run)):
            yield replace(known[0], run=run.name)


def _common_delay(bad: Sequence[Run], sound: Sequence[Run], works: Mapping[str, CycleWork]) -> float | None:
    """The least delay in s that makes several runs give back work if the force of all runs comes late by it; or None.

    Which of them give it back is a matter of stiffness and loss then, as of one preload, and no fault of theirs. The
    others have to predict them, all forces taken earlier, as well as they predict each other, and better than if these
    runs alone were late; where they have not been, the course of the force alone. Where there are no others, each of
    these has to be late by itself.
    """
    if len(bad) < FEWEST_TOGETHER or 0 < len(sound) < FEWEST_OTHERS:
        return None
    least = max(_least_delay(works[run.name]) for run in bad)
    if any(least > _longest(run, works[run.name]) * run.sample_time for run in bad):
        return None
    if not sound:
        return least if all(_by_itself(run, works[run.name]).kind == "delay" for run in bad) else None
    others, later = Others.of(sound), Others.of(sound, [_earlier(run, least) for run in sound])
    known = [run for run in bad if later.know(run.displacement)]
    together = [later.apart(_earlier(run, least), missed) for run in known]
    alone = [min(others.apart(each, missed) for each, _ in _in_time(run, works[run.name])) for run in known]
    course = [later.apart(_earlier(run, least), unlike) for run in bad if run not in known]
    if max(together, default=0.0) > farthest(later.there.usual(missed)) or sum(together) > sum(alone):
        return None
    return least if max(course, default=0.0) <= farthest(later.beyond.usual(unlike)) else None


def _earlier(run: Run, delay: float) -> Signals:
    """The signals of a run with its force earlier."""
    x, rate, force = signals_of(run)
    return x, rate, advance(force, round(delay / run.sample_time))


def _in_time(run: Run, work: CycleWork) -> Iterator[tuple[Signals, float]]:
    """The signals of a run with its force earlier by so many seconds, of each delay that it may have."""
    for count in _delays(run, work):
        yield _earlier(run, count * run.sample_time), count * run.sample_time


def _fault_of(run: Run, work: CycleWork, sound: Sequence[Run]) -> Fault:
    back, share = pretty(-work.mean, "J", 3), -work.power_factor
    seen = f"it gives back {back} in each cycle, {share:.1%} of the work that goes to and fro"
    best = _most_likely(run, work, sound)
    if best is None:
        return Fault(
            run.name,
            "energy",
            f"{seen}, which no passive specimen does; neither another sign nor a delay nor swapped channels "
            "makes it agree with the other runs",
            "Check its channels, or leave it out",
            evidence_of=ENERGY,
        )
    return Fault(run.name, best.kind, f"{seen}: {best.words}", best.cure, best.factor, best.channel, ENERGY)


def _most_likely(run: Run, work: CycleWork, sound: Sequence[Run]) -> _Try | None:
    if len(sound) < FEWEST_OTHERS:
        return _by_itself(run, work)
    others = Others.of(sound)
    # where the others have been they tell more, and then the more usual mistake comes first
    tries = sorted(_tries(run, work, others), key=lambda each: not each.known)
    usual = {known: forecast.usual(unlike) for known, forecast in ((True, others.there), (False, others.beyond))}
    least = min(tries, key=lambda each: each.unlike)
    if least.unlike > farthest(usual[least.known]):
        return None
    # what differs by no more than the other runs do among themselves is told alike
    alike = max(max(each) - min(each) for each in usual.values())
    return next(each for each in tries if each.unlike - least.unlike <= alike)


def _tries(run: Run, work: CycleWork, others: Others) -> Iterator[_Try]:
    """What may have gone wrong, the more usual mistakes first.

    Of swapped channels the forecast leaves no more than of sound runs: but for it, any elastic run is like them.
    """
    x, rate, force = signals_of(run)
    yield _turned_force(others.apart((x, rate, -force), unlike), others.know(x))
    yield _Try(
        "polarity",
        others.apart((-x, -rate, force), unlike),
        others.know(-x),
        "with its displacement turned round it agrees with the others",
        "Write 'sign: -1' under its displacement channel",
        -1.0,
        "displacement",
    )
    swaps = [each for each in swapped(run) if _agrees_in_size(each, others)]
    if swaps:
        apart, best = min(((others.apart(each, unlike), each) for each in swaps), key=lambda one: one[0])
        yield _Try(
            "swapped_channels",
            apart,
            others.know(best[0]),
            "with its force and displacement taken for each other it agrees with the others",
            "Swap the columns of its force and displacement channels",
        )
    late = [(others.apart(each, unlike), delay) for each, delay in _in_time(run, work)]
    if late:
        apart, delay = min(late)
        told = pretty(delay, "s", 3)
        yield _Try(
            "delay",
            apart,
            others.know(x),
            f"with its force {told} earlier it agrees with the others",
            f"Write 'delay: {told}' under its force channel",
        )


def _agrees_in_size(signals: Signals, others: Others) -> bool:
    return others.apart(signals, missed) <= farthest(others.forecast(signals[0]).usual(missed))


def _turned_force(apart: float, known: bool) -> _Try:
    return _Try(
        "polarity",
        apart,
        known,
        "with its force turned round it takes up work and agrees with the others",
        "Write 'sign: -1' under its force channel, or swap the wires",
        -1.0,
    )


def _delays(run: Run, work: CycleWork) -> list[int]:
    """Delays in samples that let it take up work, at most a quarter of the mean cycle, each a tenth longer than the
    one before.
    """
    least, most = max(np.ceil(_least_delay(work) / run.sample_time), 1.0), _longest(run, work)
    if not least <= most:
        return []
    return [int(count) for count in np.unique(np.round(np.geomspace(least, most, 60)))]


def _least_delay(work: CycleWork) -> float:
    """The time in s by which the force has to be earlier for the run to take up work; infinite where it never does."""
    return -work.mean / work.per_delay if work.per_delay > 0.0 else np.inf


def _longest(run: Run, work: CycleWork) -> int:
    """A quarter of the mean cycle in samples."""
    return int(0.25 * work.period / run.sample_time)


def _pulls(run: Run) -> bool:
    """Whether a force goes against its deflection, as of a spring whose sign is wrong."""
    x, force = run.displacement - np.mean(run.displacement), run.force - np.mean(run.force)
    return float(x @ force) <= 0.0


def _by_itself(run: Run, work: CycleWork) -> _Try:
    """What a run is where no other one tells: late where it resists deflection as it stands, else turned round.

    A delay of more than a quarter of a cycle is none: the force of a dashpot that is turned round hardly resists.
    """
    delay = _least_delay(work)
    if _pulls(run) or delay > 0.25 * work.period:
        return _Try(
            "polarity",
            0.0,
            False,
            "with its force turned round it takes up work",
            "Write 'sign: -1' under its force channel, or swap the wires",
            -1.0,
        )
    least = pretty(delay, "s", 2)
    return _Try(
        "delay",
        0.0,
        False,
        f"it resists deflection, but its force comes late, by {least} or more",
        "Write its 'delay' under its force channel, or let the network identify it",
    )
