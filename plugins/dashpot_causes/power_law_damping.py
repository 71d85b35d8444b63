"""Damping between dry friction and turbulence."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, added_branch, branch_lines, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot.text.quantity import pretty
from dashpot_causes.levelling import levelling_force
from dashpot_causes.powers import NEARLY_ONE, NEARLY_TWO, reference_speed

Array = NDArray[np.float64]
UNITS = {"force": "N", "exponent": "1", "reference": "m/s", "knee": "1"}
DIGRESSIVE = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8)
PROGRESSIVE = (1.2, 1.4, 1.6, 2.5, 3.0)
BOUNDS = ((0.2, NEARLY_ONE[0]), (NEARLY_ONE[1], NEARLY_TWO[0]), (NEARLY_TWO[1], 4.0))
AT_END = 0.01  # of the exponent
THINNING, KNEES = (0.25, 0.45, 0.65), (0.02, 0.05, 0.12, 0.3)  # powers of the velocity; of the largest one
KNEE = (0.015, 1.0)  # of the largest speed: a knee that the data show
LEVELLING, LEVELS = (0.02, 0.5), 5  # of the speed: where a digressive damper becomes level


class PowerLawDamping(Cause):
    """A force that follows a power of the velocity other than zero, one and two."""

    word = "power_law_damping"
    kind = "specimen"
    about = "damping with a power of the velocity"
    shows = (
        "loss stiffness follows a broken power of frequency and the same power, less one, of amplitude; where "
        "the force levels off it falls with amplitude and grows no more with frequency"
    )
    confused_with = {
        "viscous_damping": "an amplitude ladder at one frequency: the loss stiffness of a dashpot does not change",
        "quadratic_damping": "a wider range of velocities: the slope of force over velocity in a log-log plot",
        "friction": "a triangle at 0.1, 1 and 10 mm/s: the width of a friction loop does not change with speed",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """One dashpot with a power of the velocity; one from a knee on; one whose force becomes level."""
        reference = reference_speed(view)
        grid = DIGRESSIVE + PROGRESSIVE

        def values(force: float, exponent: float) -> dict[str, float]:
            return {"force": force, "exponent": exponent, "reference": reference}

        def columns(view: View, run: str) -> Array:
            return view.respond(run, "power_law_damper", [values(1.0, exponent) for exponent in grid])

        def extend(text: str, atoms: Sequence[Atom]) -> str:
            force, exponent = atoms[0]
            low, high = next(pair for pair in BOUNDS if pair[0] <= exponent <= pair[1])
            lines = [
                branch_lines(free_name(text, "power_law_damping"), "power_law_damper", {"force": force}, UNITS),
                f"  exponent: {{start: {exponent:g}, bounds: [{low:g}, {high:g}]}}",
                f"  reference: {pretty(reference, 'm/s')}",
            ]
            return add_branch(text, "\n".join(lines))

        yield Suspect(
            "power of velocity",
            grid,
            columns,
            extend,
            quantity="force",
            unit="N",
            admits=is_broken_power,
            of_motion=True,
        )
        yield _thinning(view, reference)
        yield levelling_force(view, "digressive_damping", LEVELLING, LEVELS, (0.75, 4.0), "digressive damping")


def _thinning(view: View, reference: float) -> Suspect:
    """The suspect of a dashpot that follows a power of the velocity from a knee on."""
    places = [(power, knee * view.speed / reference) for power, knee in product(THINNING, KNEES)]

    def values(force: float, number: float) -> dict[str, float]:
        exponent, knee = places[int(number)]
        return {"force": force, "exponent": exponent, "reference": reference, "knee": knee}

    knees = (KNEE[0] * view.speed / reference, KNEE[1] * view.speed / reference)
    suspect = added_branch(
        "power_law_damper",
        "power_law_damping",
        tuple(float(number) for number in range(len(places))),
        values,
        UNITS,
        unknowns=2,
        fixed=("reference",),
        bounds={"exponent": BOUNDS[0], "knee": knees},
        admits=is_broken_power,
        form="a power of the velocity from a knee on",
    )
    return replace(suspect, about="damping that thins with velocity")


def is_broken_power(numbers: Mapping[str, float]) -> bool:
    """Whether a refit has not driven the exponent to where viscous or quadratic damping begins."""
    exponent = numbers.get("exponent", 0.5)
    return all(abs(exponent - end) > AT_END for end in (*NEARLY_ONE, *NEARLY_TWO))
