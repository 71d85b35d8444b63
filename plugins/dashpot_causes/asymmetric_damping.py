"""Damping that is not the same in compression and rebound."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, branch_lines, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot_causes.powers import reference_speed

Array = NDArray[np.float64]
COMPRESSION, REBOUND = 1.0, -1.0
UNITS = {
    "compression": "N*s/m",
    "rebound": "N*s/m",
    "compression_exponent": "1",
    "rebound_exponent": "1",
    "reference": "m/s",
}
NOTHING = 0.01  # N s/m
POWERS = (0.5, 0.7, 1.4, 2.0)
EXPONENTS = (0.3, 3.0)


class AsymmetricDamping(Cause):
    """A force in proportion to velocity in one direction only, beyond what a dashpot does in both."""

    word = "asymmetric_damping"
    kind = "specimen"
    about = "different damping in compression and rebound"
    shows = "a second harmonic and a mean force that grow with velocity; the mean is 1.5 times the second harmonic"
    confused_with = {
        "stiffness_curve": "a quasi-static loop: damping does not show in it",
        "preload_dependent_damping": "a second preload: the difference between the directions stays",
        "offset": "a second frequency: an offset stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """One dashpot that acts in compression or in rebound only; one with a power of the velocity."""
        yield Suspect(
            "one direction",
            (COMPRESSION, REBOUND),
            _columns,
            _extend,
            unknowns=0,
            quantity="damping",
            unit="N*s/m",
            of_motion=True,
        )
        reference = reference_speed(view)
        grid = tuple(side * power for side in (COMPRESSION, REBOUND) for power in POWERS)

        def columns(view: View, run: str) -> Array:
            values = [_numbers(1.0, place, reference, 0.0) for place in grid]
            return view.respond(run, "asymmetric_damper", values)

        def extend(text: str, atoms: Sequence[Atom]) -> str:
            strength, place = atoms[0]
            return _branch(text, _numbers(strength, place, reference, NOTHING), place)

        yield Suspect(
            "a power in one direction", grid, columns, extend, quantity="damping", unit="N*s/m", of_motion=True
        )


def _columns(view: View, run: str) -> Array:
    velocity = view.velocity(run)
    return np.array([np.maximum(velocity, 0.0), np.minimum(velocity, 0.0)])


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    strength, place = atoms[0]
    acting, other = _sides(place)
    return _branch(text, {acting: strength, other: NOTHING}, place)


def _sides(place: float) -> tuple[str, str]:
    """The direction in which the damper acts, and the other one."""
    return ("compression", "rebound") if place > 0.0 else ("rebound", "compression")


def _numbers(strength: float, place: float, reference: float, elsewhere: float) -> dict[str, float]:
    """A damper with a power of the velocity in one direction and next to nothing in the other."""
    acting, other = _sides(place)
    return {acting: strength, f"{acting}_exponent": abs(place), other: elsewhere, "reference": reference}


def _branch(text: str, numbers: Mapping[str, float], place: float) -> str:
    acting, other = _sides(place)
    name = free_name(text, "asymmetric_damping")
    bounds = {f"{acting}_exponent": EXPONENTS}
    return add_branch(
        text, branch_lines(name, "asymmetric_damper", numbers, UNITS, fixed=(other, "reference"), bounds=bounds)
    )
