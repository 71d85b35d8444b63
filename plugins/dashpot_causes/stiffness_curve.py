"""A spring characteristic of another shape than the network's."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, added_branch, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot.text.quantity import pretty, pretty_all

Array = NDArray[np.float64]
KNOTS = (6, 12, 24)
POWERS = (2.0, 3.0)


class StiffnessCurve(Cause):
    """An elastic force over deflection that the network's own curve cannot follow."""

    word = "stiffness_curve"
    kind = "specimen"
    about = "shape of the stiffness curve"
    shows = "storage stiffness is wrong at some preloads at every frequency; even harmonics in phase with deflection"
    confused_with = {
        "end_stop": "a finer quasi-static loop: a stop has one knee, a curve bends everywhere",
        "preload_dependent_damping": "the quasi-static curve: damping does not show in it",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A constant force; a square and a cube of the deflection; a correction curve through few or many knots over
        what is covered.
        """
        constant = added_branch(
            "constant_force",
            "constant_force",
            (0.0,),
            lambda force, place: {"force": force},
            {"force": "N"},
            sign=0,
            unknowns=0,
            form="a constant force",
        )
        yield replace(constant, of=("the force at zero deflection",))
        bent = _Powers(float(np.abs(view.reach).max()))
        yield Suspect(
            "a polynomial",
            POWERS,
            bent,
            bent.extend,
            sign=0,
            unknowns=0,
            most=len(POWERS),
            quantity="force at the end of the reach",
            unit="N",
            of_motion=True,
        )
        for count in KNOTS:
            knots = tuple(np.linspace(*view.reach, count))
            yield Suspect(
                f"{count} knots",
                knots,
                _Correction(knots),
                _extend,
                joint=True,
                sign=0,
                unknowns=0,
                quantity="force at a knot",
                unit="N",
                of_motion=True,
            )


@dataclass(frozen=True)
class _Powers:
    """Powers of the deflection that are one at ``far``."""

    far: float

    def __call__(self, view: View, run: str) -> Array:
        return np.array([(view.displacement(run) / self.far) ** power for power in POWERS])

    def extend(self, text: str, atoms: Sequence[Atom]) -> str:
        """A spring with these powers; those between that are not wanted are zero."""
        strengths = {power: strength / self.far**power for strength, power in atoms}
        span = 30.0 * max(abs(strength) for strength, _ in atoms)
        terms = ["0 N/m"]
        for power in np.arange(2.0, max(strengths) + 1.0):
            unit, most = f"N/m^{power:.0f}", span / self.far**power
            bounds = f"bounds: [{pretty(-most, unit)}, {pretty(most, unit)}]"
            found = power in strengths
            terms.append(f"{{start: {pretty(strengths[power], unit, 6)}, {bounds}}}" if found else f"0 {unit}")
        lines = [
            f"{free_name(text, 'stiffness_correction')}:",
            "  element: spring",
            f"  stiffness: {{polynomial: [{', '.join(terms)}]}}",
        ]
        return add_branch(text, "\n".join(lines))


@dataclass(frozen=True)
class _Correction:
    knots: tuple[float, ...]

    def __call__(self, view: View, run: str) -> Array:
        return hats(self.knots, view.displacement(run))


def hats(knots: Sequence[float], x: Array) -> Array:
    """The monotone cubics (knots, n) that are one at a knot and zero at all others."""
    from scipy.interpolate import PchipInterpolator

    at = np.clip(x, knots[0], knots[-1])
    return np.ascontiguousarray(PchipInterpolator(knots, np.eye(len(knots)), axis=0)(at).T)


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    at = ", ".join(pretty_all([place for _, place in atoms], "m", 6))
    span = 20.0 * max(max(abs(strength) for strength, _ in atoms), 1.0)
    bounds = f"bounds: [{pretty(-span, 'N')}, {pretty(span, 'N')}]"
    forces = ", ".join(f"{{start: {pretty(strength, 'N', 6)}, {bounds}}}" for strength, _ in atoms)
    lines = [
        f"{free_name(text, 'stiffness_correction')}:",
        "  element: spring",
        "  stiffness:",
        f"    deflection: [{at}]",
        f"    force: [{forces}]",
    ]
    return add_branch(text, "\n".join(lines))
