"""Damping that changes with deflection."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot.text.quantity import pretty
from dashpot_causes.stiffness_curve import hats

Array = NDArray[np.float64]
KNOTS = 4
SMALLEST_FACTOR = 0.05


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
        """A damper with a factor over deflection, through few knots."""
        knots = tuple(np.linspace(*view.reach, KNOTS))

        def columns(view: View, run: str) -> Array:
            return hats(knots, view.displacement(run)) * view.velocity(run)

        yield Suspect(f"{KNOTS} knots", knots, columns, _extend, joint=True, sign=0, unknowns=0)


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    strengths = np.array([strength for strength, _ in atoms])
    strengths = strengths - min(0.0, strengths.min()) + 1e-3 * np.ptp(strengths) + 1e-9
    reference = int(np.argmax(strengths))
    factors = np.maximum(strengths / strengths[reference], SMALLEST_FACTOR)
    bounds = "bounds: [0.02, 50]"
    texts = ["1" if k == reference else f"{{start: {factor:.5g}, {bounds}}}" for k, factor in enumerate(factors)]
    at = ", ".join(pretty(place, "m", 6) for _, place in atoms)
    lines = [
        f"{free_name(text, 'preload_dependent_damping')}:",
        "  element: damper",
        f"  damping: {{start: {pretty(strengths[reference], 'N*s/m', 6)}}}",
        "  scale:",
        f"    deflection: [{at}]",
        f"    factor: [{', '.join(texts)}]",
    ]
    return add_branch(text, "\n".join(lines))
