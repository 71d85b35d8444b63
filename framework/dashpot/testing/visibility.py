"""NaN stays visible: it never becomes a number again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.kernel.compiler.trace import Sight, trace_branch
from dashpot.kernel.eager import EagerBranch, simulate_eagerly
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element, Motion
from dashpot.testing.motion import random_drive
from dashpot.testing.specimen import Specimen, draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination

Array = NDArray[np.float64]
Simulate = Callable[[Drive, Array], Array]

SAMPLES = 80
NOTICEABLE = 1e-6
NUDGE = 1.03
ADVICE = "Turn conditions round so that the case with NaN computes: np.where(x > 1, a, b) hides NaN in x."


def check_visibility(element: type[Element], seed: int | None = None) -> None:
    """NaN in a number or in the motion gives NaN as long as it matters: with memory of it, from then on."""
    examination = Examination.begin(element, "visibility", seed)
    rng = examination.rng()
    sizes = draw_sizes(rng)
    drive = random_drive(rng, "multisine", sizes.length, sizes.time, SAMPLES)
    for specimen in draw_specimens(element, rng, sizes, lanes=1):
        for how, simulate in _runners(specimen).items():
            _check_numbers(examination, specimen, simulate, drive, f"with {specimen.form}, {how}")
            _check_motion(examination, specimen, simulate, drive, f"with {specimen.form}, {how}")


def _runners(specimen: Specimen) -> dict[str, Simulate]:
    network = compile_network(specimen.spec)
    return {
        "in its own code": lambda drive, values: simulate_eagerly(specimen.spec, drive, values),
        "compiled": lambda drive, values: network.along(drive)(values),
    }


def _check_numbers(examination: Examination, specimen: Specimen, simulate: Simulate, drive: Drive, case: str) -> None:
    paths = [slot.path for slot in specimen.spec.slots()]
    if not paths:
        return
    base = specimen.values[0]
    nudged = base + np.diag(np.where(base == 0.0, NUDGE - 1.0, (NUDGE - 1.0) * base))
    blinded = np.where(np.eye(base.size, dtype=bool), np.nan, base)
    force = simulate(drive, base[None])
    change = np.abs(simulate(drive, nudged) - force)
    matters = _from_then_on(examination.element, change > NOTICEABLE * np.max(np.abs(force)))
    hidden = matters & ~np.isnan(simulate(drive, blinded))
    if hidden.any():
        slot, sample = np.argwhere(hidden)[0]
        examination.fail(f"{case}: NaN as '{paths[slot]}' gives a number at sample {sample}", ADVICE)


def _check_motion(examination: Examination, specimen: Specimen, simulate: Simulate, drive: Drive, case: str) -> None:
    sample = drive.samples // 2
    same, other, unknown = (_struck(drive, sample, factor) for factor in (1.0, NUDGE, np.nan))
    force = simulate(same, specimen.values)
    change = np.abs(simulate(other, specimen.values) - force)
    matters = change > NOTICEABLE * np.max(np.abs(force))
    if _remembers(specimen, same, other, sample):
        matters[:, sample:] = True
    hidden = matters & ~np.isnan(simulate(unknown, specimen.values))
    examination.demand(
        not hidden.any(),
        f"{case}: NaN in the motion at sample {sample} gives a number at sample {int(np.argmax(hidden.any(axis=0)))}",
        ADVICE,
    )


def _remembers(specimen: Specimen, same: Drive, other: Drive, sample: int) -> bool:
    """Whether a state after the step to a sample is another one where the motion there is."""
    sight, law = trace_branch(specimen.branch).sight, EagerBranch(specimen.branch, specimen.numbers)
    states = law.rest(specimen.values.shape[0])
    for step in range(1, sample):
        states = dict(law.respond(_motion(same, step, sight), states, same.dt).states)
    kept, moved = (law.respond(_motion(drive, sample, sight), states, same.dt).states for drive in (same, other))
    return any(bool(np.any(kept[key] != moved[key])) for key in kept)


def _motion(drive: Drive, step: int, sight: Sight) -> Motion:
    path = drive.displacement[step - 1], drive.displacement[step]
    if sight == "monotone":
        return Motion(*path, np.nan, np.nan, np.nan)
    return Motion(*path, drive.velocity[step - 1], drive.velocity[step], drive.acceleration[step])


def _struck(drive: Drive, sample: int, factor: float) -> Drive:
    # a turning point on a path that is not known is not known either
    factors = np.where(np.arange(drive.samples) == sample, factor, 1.0)
    kept = (drive.turn_step != sample) & (drive.turn_step != sample + 1)
    return replace(
        drive,
        displacement=factors * drive.displacement,
        velocity=factors * drive.velocity,
        acceleration=factors * drive.acceleration,
        turn_step=drive.turn_step[kept],
        turn_displacement=drive.turn_displacement[kept],
    )


def _from_then_on(element: type[Element], matters: NDArray[np.bool_]) -> NDArray[np.bool_]:
    return np.maximum.accumulate(matters, axis=1) if element.declares.states else matters
