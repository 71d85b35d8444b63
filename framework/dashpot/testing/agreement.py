"""Eager, traced and compiled, a law gives the same force.

What is compared is measured by the force scale of a lane: the largest force, or a number of the law in newtons.

The compiled law computes the same in another order, so it rounds differently. A specimen that is struck again and again
makes more of each rounding with every contact; its force is compared as far as rounding leaves it determined: until the
results of its steps, changed in their last bits, change the force by the tolerance.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.kernel.eager import simulate_eagerly, simulate_interpreted
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element, Motion, Response
from dashpot.testing.motion import MOTIONS, random_drive
from dashpot.testing.specimen import Specimen, draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination
from dashpot.text.quantity import dimensions

Array = NDArray[np.float64]

TOLERANCE = 1e-12
SAMPLES = 160
LAST_BITS = 4.0 * np.finfo(float).eps
DRAWS = 2


def check_agreement(element: type[Element], seed: int | None = None) -> None:
    """The force of the element's own code, of its traced graph and of the compiled kernel agree to 1e-12."""
    examination = Examination.begin(element, "agreement", seed)
    rng = examination.rng()
    for kind in MOTIONS:
        sizes = draw_sizes(rng)
        drive = random_drive(rng, kind, sizes.length, sizes.time, SAMPLES)
        for specimen in draw_specimens(element, rng, sizes):
            _compare(examination, specimen, drive, f"{specimen.form}, {kind}", rng.spawn(1)[0])


def _compare(examination: Examination, specimen: Specimen, drive: Drive, case: str, rng: np.random.Generator) -> None:
    eager = simulate_eagerly(specimen.spec, drive, specimen.values)
    if not np.isfinite(eager).all():
        examination.fail(
            f"with {case}, the force is not finite for ordinary numbers: {_first(specimen, eager)}",
            "Guard the law against overflow and division by zero.",
        )
    traced = simulate_interpreted(specimen.spec, drive, specimen.values)
    compiled = compile_network(specimen.spec).along(drive)(specimen.values)
    scale = _force_scale(specimen, eager)
    advice = "A step may depend on its arguments only: no attributes of its own, no random numbers, no look at types."
    _demand_equal(examination, traced / scale, eager / scale, f"with {case}, the traced law", advice)
    if not np.all(np.abs(compiled - eager) <= TOLERANCE * scale):
        compiled = np.where(determined(specimen, drive, eager, scale, rng), compiled, eager)
    _demand_equal(
        examination,
        compiled / scale,
        eager / scale,
        f"with {case}, the compiled law",
        "Avoid differences of nearly equal large numbers.",
    )


def determined(
    specimen: Specimen, drive: Drive, force: Array, scale: Array, rng: np.random.Generator
) -> NDArray[np.bool_]:
    """Which samples (lanes, samples) of a force come before rounding of every step has moved it by TOLERANCE.

    ``force`` (lanes, samples) and ``scale`` (lanes, 1) in N.
    """
    branch = specimen.branch
    spec = replace(
        specimen.spec,
        root=replace(specimen.spec.root, members=(replace(branch, element=_rounding(branch.element, rng)),)),
    )
    moved = np.max([np.abs(simulate_eagerly(spec, drive, specimen.values) - force) for _ in range(DRAWS)], axis=0)
    return np.maximum.accumulate(moved / scale, axis=1) <= TOLERANCE


def _rounding(element: type[Element], rng: np.random.Generator) -> type[Element]:
    """The element with the results of each step changed in their last bits; what is traced stays as it is."""

    def rounded(value: Any) -> Any:
        if not isinstance(value, np.ndarray):
            return value
        return value * (1.0 + LAST_BITS * rng.choice([-1.0, 1.0], value.shape))

    class Rounding(element):  # type: ignore[misc, valid-type]
        def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
            response = super().step(x, z, p, dt)
            return Response(rounded(response.force), **{key: rounded(value) for key, value in response.states.items()})

    return Rounding


def _force_scale(specimen: Specimen, force: Array) -> Array:
    slots = zip(specimen.spec.slots(), specimen.values.T, strict=True)
    newtons = [column for slot, column in slots if dimensions(slot.value.unit) == (1.0, 0.0, 0.0)]
    return np.max(np.abs([np.max(np.abs(force), axis=1), *newtons]), axis=0)[:, None] + np.finfo(float).tiny


def _demand_equal(examination: Examination, found: Array, expected: Array, what: str, advice: str) -> None:
    error = np.abs(found - expected)
    lane, sample = np.unravel_index(np.argmax(np.where(np.isnan(error), np.inf, error)), error.shape)
    examination.demand(
        bool(error[lane, sample] <= TOLERANCE),
        f"{what} gives {found[lane, sample]:.16g} of the force "
        f"scale at sample {sample}, the element's own code {expected[lane, sample]:.16g}",
        advice,
    )


def _first(specimen: Specimen, force: Array) -> str:
    lane, sample = np.argwhere(~np.isfinite(force))[0]
    numbers = {path.rpartition(".")[2]: float(column[lane]) for path, column in specimen.numbers.items()}
    return f"{force[lane, sample]} at sample {sample} of lane {lane}, {numbers}"
