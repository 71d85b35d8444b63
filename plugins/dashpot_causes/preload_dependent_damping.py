"""Damping that changes with deflection."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, free_name
from dashpot.model.network import Branch, NetworkSpec
from dashpot.model.patch import add_branch, add_to_branch
from dashpot.text.quantity import pretty
from dashpot_causes.stiffness_curve import hats

Array = NDArray[np.float64]
KNOTS = 4
SMALLEST_FACTOR, LARGEST_FACTOR = 0.05, 20.0
BOUNDS = "bounds: [0.02, 50]"


class PreloadDependentDamping(Cause):
    """A force in proportion to velocity with a factor over deflection."""

    word = "preload_dependent_damping"
    kind = "specimen"
    about = "damping that changes with preload"
    shows = "loss stiffness changes with preload; a second harmonic in phase with velocity"
    confused_with = {
        "delay": "a second amplitude at each preload; or a known steel spring: a delay stays",
        "stiffness_curve": "the phase of the second harmonic: damping shows in sin, stiffness in cos",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A factor over deflection, through few knots, on the network's dashpot, or on a further one."""
        knots = tuple(np.linspace(*view.reach, KNOTS))

        def columns(view: View, run: str) -> Array:
            return hats(knots, view.displacement(run)) * view.velocity(run)

        extend = next((_OnBranch(*found) for found in map(_plain_dashpot, network.root.members) if found), _extend)
        yield Suspect(f"{KNOTS} knots", knots, columns, extend, joint=True, sign=0, unknowns=0)


def _plain_dashpot(member: object) -> tuple[str, float] | None:
    """Name and damping of a straight dashpot without a factor, else None."""
    if not isinstance(member, Branch) or member.element.word != "damper" or member.scale is not None:
        return None
    curve = member.curves["damping"]
    return (member.name, curve.values[0].number) if curve.form == "constant" else None


@dataclass(frozen=True)
class _OnBranch:
    branch: str
    damping: float

    def __call__(self, text: str, atoms: Sequence[Atom]) -> str:
        strengths = np.array([strength for strength, _ in atoms])
        # the knot that changes least keeps the factor one, so that the damping found before is a good start
        reference = int(np.argmin(np.abs(strengths)))
        factors = np.clip(1.0 + strengths / self.damping, SMALLEST_FACTOR, LARGEST_FACTOR)
        return add_to_branch(text, self.branch, "\n".join(_scale_lines(atoms, factors, reference)))


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    strengths = np.array([strength for strength, _ in atoms])
    strengths = strengths - min(0.0, strengths.min()) + 1e-3 * np.ptp(strengths) + 1e-9
    reference = int(np.argmax(strengths))
    factors = np.maximum(strengths / strengths[reference], SMALLEST_FACTOR)
    lines = [
        f"{free_name(text, 'preload_dependent_damping')}:",
        "  element: damper",
        f"  damping: {{start: {pretty(strengths[reference], 'N*s/m', 6)}}}",
        *(f"  {line}" for line in _scale_lines(atoms, factors, reference)),
    ]
    return add_branch(text, "\n".join(lines))


def _scale_lines(atoms: Sequence[Atom], factors: Array, reference: int) -> list[str]:
    texts = ["1" if k == reference else f"{{start: {factor:.5g}, {BOUNDS}}}" for k, factor in enumerate(factors)]
    at = ", ".join(pretty(place, "m", 6) for _, place in atoms)
    return ["scale:", f"  deflection: [{at}]", f"  factor: [{', '.join(texts)}]"]
