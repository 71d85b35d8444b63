"""Runs whose force has the wrong sign, or whose force or displacement has the wrong unit, told by the other runs.

A well-known factor is a wrong unit where it lies as near as the spread of the others allows, and where their spread
does not allow what was measured. So a sound run is never rescaled: what differs by another factor is left to the
diagnosis. Beyond the conditions of the others the forecast may be wrong by more than this spread: by as much as their
conditions change their own stiffness or damping. No run stays in that is a plain factor off to that accuracy.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from dashpot.data.declaration import SETTING_UNITS
from dashpot.data.run import Run
from dashpot.text.quantity import pretty
from dashpot.triage.agreement import ACCURACY, FEWEST, MOSTLY, Agreement, find_agreement
from dashpot.triage.conditions import FRICTION, change_by_conditions, ratios
from dashpot.triage.energy import runs_that_give_back, turned
from dashpot.triage.fault import OTHER_RUNS, Fault
from dashpot.triage.forecast import Moments, Sizes, moments_of, moments_of_run, rate_of, swapped
from dashpot.triage.others import Others

# what was measured over what it is -> how that comes about
FORCES = {
    1000.0: "kN written as N",
    0.001: "N written as kN",
    1e6: "MN written as N",
    9.80665: "N written as kgf",
    1.0 / 9.80665: "kgf written as N",
    9806.65: "N written as tonf",
    1.0 / 9806.65: "tonf written as N",
    4.4482216: "N written as lbf",
    1.0 / 4.4482216: "lbf written as N",
    4448.2216: "N written as kip",
    1.0 / 4448.2216: "kip written as N",
    10.0: "a decimal point",
    0.1: "a decimal point",
}
DISPLACEMENTS = {
    1000.0: "mm written as m",
    0.001: "m written as mm",
    1e6: "um written as m",
    1e-6: "m written as um",
    25.4: "mm written as in",
    1.0 / 25.4: "in written as mm",
    10.0: "mm written as cm, or a decimal point",
    0.1: "cm written as mm, or a decimal point",
    100.0: "cm written as m",
    0.01: "m written as cm",
}
PREFIXES = (1000.0, 0.001, 1e6, 1e-6)
# what other settings do to a force is no matter of triage, but no setting makes it this many times as large
SETTLED = 999.0
# odds of two factors, which are those of their distances where nobody knows how wrong the forecast is: with a scale of
# normal errors that may be of any size (prior 1/s) the likelihood of a distance d is proportional to 1/d
CLEARLY = 3.0


@dataclass(frozen=True)
class Shared:
    """Where some runs have been, so that they can predict another one: deflections in m, and the largest speed."""

    low: float
    high: float
    speed: float

    @classmethod
    def of(cls, runs: Sequence[Run]) -> Shared:
        """Where these have been."""
        return cls(
            min(float(np.min(run.displacement)) for run in runs),
            max(float(np.max(run.displacement)) for run in runs),
            max(float(np.max(np.abs(rate_of(run)))) for run in runs),
        )

    def moments(self, run: Run, sizes: Sizes) -> Moments | None:
        """Those of a run where the others have been; None if this is less than half of its way and of theirs."""
        x, v = run.displacement, rate_of(run)
        there = (self.low <= x) & (x <= self.high) & (np.abs(v) <= self.speed)
        way = min(float(np.ptp(x)), self.high - self.low)
        if not there.any() or np.ptp(x[there]) < 0.5 * way:
            return None
        return moments_of(x[there], v[there], run.force[there], sizes)


def wrong_scales(runs: Sequence[Run]) -> list[Fault]:
    """Wrong polarities and units: among runs of the same settings, and the plainest ones among all."""
    found: dict[str, Fault] = {}
    alike = [group for group in _alike(runs) if len(group) >= FEWEST]
    for group in alike:
        found.update((fault.run, fault) for fault in _of_group(group, 1.0))
    if len(alike) != 1 or len(alike[0]) != len(runs):
        found = {**{fault.run: fault for fault in _of_group(runs, SETTLED)}, **found}
    return list(found.values())


def _alike(runs: Sequence[Run]) -> list[list[Run]]:
    """The runs by those of their settings that say more than how the rig moved."""
    groups: dict[object, list[Run]] = {}
    for run in runs:
        free = {key: value for key, value in run.settings.items() if key not in SETTING_UNITS}
        groups.setdefault((tuple(sorted(free.items())), tuple(sorted(run.notes.items()))), []).append(run)
    return list(groups.values())


def _of_group(runs: Sequence[Run], least: float) -> Iterator[Fault]:
    """Faults of runs that are compared with each other; factors below ``least`` (or above its inverse) are let pass."""
    moved = [run for run in runs if np.ptp(run.displacement) > 0.0 and np.any(run.force)]
    if len(moved) < FEWEST:
        return
    sizes = Sizes.of(moved)
    known = find_agreement([moments_of_run(run, sizes) for run in moved])
    if known is None:
        sized = (_size_fault(run, [other for other in moved if other is not run]) for run in moved)
        yield from (fault for fault in sized if fault)
        return
    inside = [moved[k] for k in known.inside]
    for number, run in enumerate(moved):
        if number not in known.inside and (fault := _fault_of(run, known, inside, sizes, least)):
            yield fault


def _fault_of(run: Run, known: Agreement, inside: Sequence[Run], sizes: Sizes, least: float) -> Fault | None:
    there = Shared.of(inside).moments(run, sizes)
    # beyond where the others have been nobody knows the law: its force is that of another setting
    beside = least if there else max(least, SETTLED)
    gain, likeness = known.compare(there) if there else Others.of(inside).course(run)
    like = known.is_like(likeness) and gain < 0.0 and abs(math.log(-gain)) <= known.reach
    if like and not _gives_back_if_turned(run, inside):
        return Fault(
            run.name,
            "polarity",
            f"its force is {gain:.3g} times that expected from all other runs: the channel has the wrong sign",
            "Write 'sign: -1' under its force channel, or swap the wires",
            -1.0,
            evidence_of=OTHER_RUNS,
        )
    change = change_by_conditions(inside)
    allowed = known.reach + change
    if gain > 0.0 and likeness >= MOSTLY and abs(math.log(gain)) <= known.reach:
        return None
    force = _force_fault(run, gain, likeness, known, beside) or _far_fault(run, gain, likeness, known, allowed, beside)
    # where a force hardly depends on the deflection, as friction, any divisor of this makes it like the others
    beyond = change_by_conditions([*inside, run]) - change > allowed
    stroke = _stroke_fault(run, known, sizes, allowed, least) if beyond else None
    if force and stroke:
        # an elastic force in proportion to its deflection shows the one as the other
        nearer = _nearer(run, stroke, inside, "displacement") > _nearer(run, force, inside, "force")
        return stroke if nearer else force
    unit = force or stroke or (_size_fault(run, inside) if likeness < MOSTLY else None)
    if unit and unit.factor is not None:
        return unit
    away = abs(math.log(gain)) if gain > 0.0 and likeness >= MOSTLY else math.inf
    return _swapped(run) if away > allowed and _swaps(run, known, sizes, away / CLEARLY) else unit


def _gives_back_if_turned(run: Run, others: Sequence[Run]) -> bool:
    """Whether a run with its force turned round gives back work: what pushes against its deflection is a mass then."""
    return run.name in runs_that_give_back([*others, turned(run)])


def _swaps(run: Run, known: Agreement, sizes: Sizes, nearest: float) -> bool:
    """Whether a run with force and displacement taken for each other is what the others expect, in its size as well."""
    seen = [known.compare(moments_of(*each, sizes)) for each in swapped(run)]
    within = min(known.tolerance, nearest)
    return any(gain > 0.0 and likeness >= MOSTLY and abs(math.log(gain)) <= within for gain, likeness in seen)


def _swapped(run: Run) -> Fault:
    return Fault(
        run.name,
        "swapped_channels",
        "with its force and displacement taken for each other it agrees with the others, as it is it does not",
        "Swap the columns of its force and displacement channels",
        evidence_of=OTHER_RUNS,
    )


def _size_fault(run: Run, others: Sequence[Run]) -> Fault | None:
    """A factor of 1000 and more where nothing foretells the course of a force, as in a hydraulic mount: by sizes alone.

    Of stiffness, damping and friction that counts which changes least between the others. A run is at fault if a plain
    factor brings it into their range, or beyond it by no more than that is wide, and is clear.
    """
    if len(others) < FEWEST:
        return None
    known, own = ratios(others), ratios([run])[:, 0]
    law = int(np.argmin(np.ptp(known, axis=1)))
    gain = math.exp(own[law] - 0.5 * (np.max(known[law]) + np.min(known[law])))
    near = _near(gain, FORCES, 1.5 * float(np.ptp(known[law])) + ACCURACY, SETTLED)
    if not (near and near[0] in PREFIXES and _is_clear(gain, near[0])):
        return None
    force, stroke = _unit_of_force(run, gain, near[:1], 1.0 / near[0]), _unit_of_stroke(run, [1.0 / near[0]])
    moved = law < FRICTION and _nearer(run, stroke, others, "displacement") > _nearer(run, force, others, "force")
    return stroke if moved else force


def _force_fault(run: Run, gain: float, likeness: float, known: Agreement, least: float) -> Fault | None:
    if not gain > 0.0 or likeness < MOSTLY or abs(math.log(gain)) <= known.reach:
        return None
    near = _near(gain, FORCES, known.tolerance, least)
    if not any(_may_be(factor, known, likeness) for factor in near):
        return None
    return _unit_of_force(run, gain, near, _correction(near))


def _far_fault(run: Run, gain: float, likeness: float, known: Agreement, allowed: float, least: float) -> Fault | None:
    """A force farther off than conditions explain: ``allowed``, in logs. Corrected only where the factor is clear.

    Below the factor that no setting has, a run of another setting is at fault only where the factor is clear.
    """
    if not gain > 0.0 or likeness < MOSTLY or abs(math.log(gain)) <= allowed:
        return None
    near = _near(gain, FORCES, allowed, SETTLED)
    nearest = near[0] if near else _near(gain, FORCES, math.inf, SETTLED)[0]
    clear = _is_clear(gain, nearest) and _may_be(nearest, known, likeness)
    near = near or [nearest] * clear
    if abs(math.log(gain)) < math.log(SETTLED) and not (clear if least > 1.0 else near):
        return None
    return _unit_of_force(run, gain, near, 1.0 / near[0] if clear else None)


def _may_be(factor: float, known: Agreement, likeness: float) -> bool:
    """Whether a unit may be mistaken: a prefix often is, another one where the course is as like as that of the others.

    No unit changes the course of a force. Clipping and a law that the others do not show do.
    """
    return factor in PREFIXES or known.is_like(likeness)


def _is_clear(gain: float, factor: float) -> bool:
    """Whether a factor is as much nearer than all others, one among them, as three to one asks for."""
    others = min(abs(math.log(gain / other)) for other in (1.0, *FORCES) if other != factor)
    return others >= CLEARLY * abs(math.log(gain / factor))


def _unit_of_force(run: Run, gain: float, near: Sequence[float], correction: float | None) -> Fault:
    like = " or ".join(FORCES[factor] for factor in near)
    return Fault(
        run.name,
        "unit",
        f"its force is {pretty(gain, '1', 4)} times that expected from all other runs, "
        + (f"like {like}" if like else "more than any conditions change it, and like no well-known mistake"),
        "Correct the 'unit' of its force channel",
        correction,
        evidence_of=OTHER_RUNS,
    )


def _stroke_fault(run: Run, known: Agreement, sizes: Sizes, allowed: float, least: float) -> Fault | None:
    """A divisor of the deflection with which the force is as expected; a plain one to what is ``allowed``, in logs."""
    rate = np.gradient(run.displacement, run.sample_time)
    fitting = {}
    for factor in DISPLACEMENTS:
        seen = moments_of(run.displacement / factor, rate / factor, run.force, sizes)
        gain, likeness = known.compare(seen)
        within = allowed if abs(math.log(factor)) >= math.log(SETTLED) else known.tolerance
        near = gain > 0.0 and abs(math.log(gain)) <= within and likeness >= MOSTLY
        if near and _may_be(factor, known, likeness) and abs(math.log(factor)) > max(known.reach, math.log(least)):
            fitting[factor] = abs(math.log(gain))
    if not fitting:
        return None
    return _unit_of_stroke(run, sorted(fitting, key=lambda each: fitting[each]))


def _unit_of_stroke(run: Run, fits: Sequence[float]) -> Fault:
    divisors = " or ".join(f"{factor:.6g} ({DISPLACEMENTS[factor]})" for factor in fits)
    return Fault(
        run.name,
        "unit_of_displacement",
        f"its force is like that of all others if its displacement is divided by {divisors}",
        "Correct the 'unit' of its displacement channel",
        _correction(fits),
        "displacement",
        OTHER_RUNS,
    )


def _near(gain: float, factors: dict[float, str], tolerance: float, least: float) -> list[float]:
    """The known factors that a gain may be, the nearest first."""
    apart = {factor: abs(math.log(gain / factor)) for factor in factors if abs(math.log(factor)) >= math.log(least)}
    return sorted((factor for factor in apart if apart[factor] <= tolerance), key=lambda factor: apart[factor])


def _correction(near: Sequence[float]) -> float | None:
    """What a channel is to be multiplied by; None where the spread of the others does not tell which factor it is.

    Of several that are possible the nearest is taken if it is one of the prefixes of the SI, which are mistaken most.
    """
    return 1.0 / near[0] if len(near) == 1 or near[0] in PREFIXES else None


def _nearer(run: Run, fault: Fault, inside: Sequence[Run], channel: str) -> float:
    """By how much correcting a fault brings the size of a channel nearer to the range of the other runs, in logs."""
    sizes = [size for other in inside if (size := float(np.std(other.channels[channel]))) > 0.0]
    size, factor = float(np.std(run.channels[channel])), fault.factor
    if not sizes or not size > 0.0 or factor is None:
        return 0.0

    def beyond(value: float) -> float:
        return max(0.0, math.log(min(sizes) / value), math.log(value / max(sizes)))

    return beyond(size) - beyond(size * factor)
