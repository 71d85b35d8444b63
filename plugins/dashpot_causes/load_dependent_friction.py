"""Dry friction that grows with the load."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, branch_lines, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
UNITS = {"limit": "N", "stiffness": "N/m"}
PLACES = 7
KNOTS = 5  # of the factor over the reach
FACTORS = (0.06, 0.4)
BOUNDS = "[0.02, 1.5]"
BACK = 0.4  # of how far the factor goes one way it may come back: at the ends of the reach little is known of it
CHANGES = 0.9  # friction that changes by less does not depend on the load


class LoadDependentFriction(Cause):
    """A slider whose force has a factor over deflection: it changes from one end of the reach to the other."""

    word = "load_dependent_friction"
    kind = "specimen"
    about = "dry friction that depends on the load"
    shows = "the width of a slow loop changes along the deflection; otherwise like dry friction"
    confused_with = {
        "friction": "a second preload: the width of the loop changes with it, or not",
        "preload_dependent_damping": "a slow triangle: damping disappears, friction stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Smooth sliders over yield travels, their force growing or falling along the reach."""
        travels = tuple(np.geomspace(5e-4 * view.stroke, 0.6 * view.stroke, PLACES))
        for rising in (True, False):
            for least in FACTORS:
                scaled = _Scaled(travels, view.reach, least, rising)
                yield Suspect("dahl growing with deflection" if rising else "dahl falling with deflection",
                              travels, scaled, scaled.extend, unknowns=KNOTS + 1, quantity="limit", unit="N",
                              admits=scaled.admits)  # fmt: skip


@dataclass(frozen=True)
class _Scaled:
    travels: tuple[float, ...]
    reach: tuple[float, float]
    least: float
    rising: bool

    @property
    def places(self) -> tuple[float, ...]:
        return tuple(np.linspace(*self.reach, KNOTS).tolist())

    @property
    def factors(self) -> tuple[float, ...]:
        ends = (self.least, 1.0) if self.rising else (1.0, self.least)
        return tuple(np.linspace(*ends, KNOTS).tolist())

    def admits(self, found: Mapping[str, float]) -> bool:
        """Whether the factor goes mostly one way, and far enough."""
        factors = [found.get(f"scale[{number}]", 1.0) for number in range(KNOTS)]
        rising = factors if self.rising else factors[::-1]
        steps = [high - low for low, high in pairwise(rising)]
        up, down = sum(step for step in steps if step > 0.0), sum(-step for step in steps if step < 0.0)
        return down <= BACK * up and rising[0] < CHANGES * rising[-1]

    def __call__(self, view: View, run: str) -> Array:
        plain = view.respond(run, "dahl", [{"limit": 1.0, "stiffness": 1.0 / travel} for travel in self.travels])
        return plain * np.interp(view.displacement(run), self.places, self.factors)

    def extend(self, text: str, atoms: Sequence[Atom]) -> str:
        limit, travel = atoms[0]
        factors = ["1" if factor == 1.0 else f"{{start: {factor:g}, bounds: {BOUNDS}}}" for factor in self.factors]
        values = {"limit": limit, "stiffness": limit / travel}
        lines = [
            branch_lines(free_name(text, "load_dependent_friction"), "dahl", values, UNITS),
            "  exponent: {start: 1}",
            "  scale:",
            f"    deflection: [{', '.join(pretty(place, 'm', 6) for place in self.places)}]",
            f"    factor: [{', '.join(factors)}]",
        ]
        return add_branch(text, "\n".join(lines))
