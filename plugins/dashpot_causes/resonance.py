"""A mass that resonates inside the specimen."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, branch_lines, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch

Array = NDArray[np.float64]
UNITS = {"stiffness": "N/m", "fluid_mass": "kg", "damping": "N*s/m"}
BROAD, NARROW = (0.25, 9), (0.06, 28)  # damping ratio, and how many frequencies it takes to miss none
LOWEST, HIGHEST = 0.15, 3.0  # of the end of the measured band
SMALLEST_MASS = 1.01e-3  # kg


class Resonance(Cause):
    """A mass behind a spring: fluid in a track, a belt, a column of gas."""

    word = "resonance"
    kind = "specimen"
    about = "an inner resonance"
    shows = (
        "a dip and a peak of storage stiffness with a narrow maximum of loss stiffness between them, at one frequency"
    )
    confused_with = {
        "moving_mass": "a sweep to higher frequency: a resonance turns round, a mass does not",
        "relaxation": "a sweep to higher frequency: relaxation has no peak of storage stiffness",
        "hum": "a run at rest: hum stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A mass behind a spring over resonance frequencies, weakly or strongly damped."""
        end = view.speed / (np.pi * view.stroke)
        band = LOWEST * end, min(HIGHEST * end, 0.15 / view.dt)
        places = [(float(f), ratio) for ratio, count in (BROAD, NARROW) for f in np.geomspace(*band, count)]

        def values(stiffness: float, place: float) -> dict[str, float]:
            frequency, ratio = places[int(place)]
            speed = 2.0 * np.pi * frequency
            damping = 2.0 * ratio * stiffness / speed
            return {"stiffness": stiffness, "fluid_mass": stiffness / speed**2, "damping": damping}

        def columns(view: View, run: str) -> Array:
            return view.respond(run, "hydro", [values(1.0, place) for place in grid])

        def extend(text: str, atoms: Sequence[Atom]) -> str:
            found = values(*atoms[0])
            found["fluid_mass"] = max(found["fluid_mass"], SMALLEST_MASS)
            return add_branch(text, branch_lines(free_name(text, "resonance"), "hydro", found, UNITS))

        grid = tuple(float(number) for number in range(len(places)))
        yield Suspect("a mass behind a spring", grid, columns, extend, unknowns=2, quantity="stiffness", unit="N/m")
