"""A mass that resonates inside the specimen."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, branch_lines, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot_causes.moving_mass import STIFF

Array = NDArray[np.float64]
UNITS = {
    "mass": "kg",
    "fluid_mass": "kg",
    "stiffness": "N/m",
    "damping": "N*s/m",
    "quadratic_damping": "N*s^2/m^2",
}
BROAD, NARROW = (0.25, 9), (0.06, 28)  # damping ratio, and how many frequencies it takes to miss none
TURBULENT = (0.2, 0.8)  # damping ratios of the turbulence alone, at half of the largest speed
LOWEST = 0.15  # of the end of the measured band
BELOW = 3.0  # times lower than where resonances are looked for
OVERDAMPED = 1.0  # damping ratio from which on it is relaxation
SMALLEST_MASS = 1.01e-3  # kg
MIDST = (0.05, 0.95)  # quantiles: the way up to a preload is no stroke


class Resonance(Cause):
    """A mass behind a spring, as fluid in a track or a column of gas, or hung on one, as a belt or a bracket."""

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
        """A mass behind a spring or hung on one, over resonance frequencies and dampings, linear or of turbulence."""
        end = view.highest_frequency
        band = Band(LOWEST * end, STIFF * end, 0.15 / view.dt, 0.5 * view.speed, tuple(_tops(view)))
        plain = [Mode(f, ratio) for ratio, count in (BROAD, NARROW) for f in band.frequencies(count)]
        turbulent = [Mode(f, NARROW[0], ratio / band.speed) for ratio in TURBULENT for f in band.frequencies(BROAD[1])]
        for words, element, mass in (
            ("a mass behind a spring", "hydro", "fluid_mass"),
            ("a mass hung on a spring", "vibration_absorber", "mass"),
        ):
            yield _form(words, element, mass, plain, 2, band)
            yield _form(f"{words}, in turbulence", element, mass, turbulent, 3, band)


@dataclass(frozen=True)
class Mode:
    """A resonance: its frequency in Hz, its damping ratio, and what turbulence adds to that per speed, in s/m."""

    frequency: float
    ratio: float
    turbulence: float = 0.0

    def values(self, mass: str, stiffness: float) -> dict[str, float]:
        """The parameters of an element with a stiffness in N/m; ``mass`` is the word for its mass."""
        speed = 2.0 * np.pi * self.frequency
        found = {"stiffness": stiffness, mass: stiffness / speed**2, "damping": 2.0 * self.ratio * stiffness / speed}
        return found | ({"quadratic_damping": 2.0 * self.turbulence * stiffness / speed} if self.turbulence else {})


@dataclass(frozen=True)
class Band:
    """Where resonances are looked for, in Hz, up to what is ``sampled`` often enough, and a usual ``speed`` in m/s.

    ``tops`` has the highest frequency in Hz and half of the largest speed in m/s of each run.
    """

    low: float
    high: float
    sampled: float
    speed: float
    tops: Sequence[tuple[float, float]]

    def frequencies(self, count: int) -> list[float]:
        """Evenly spread on a logarithmic scale."""
        return np.geomspace(self.low, min(self.high, self.sampled), count).tolist()

    def shows(self, mass: float, stiffness: float, damping: float, quadratic_damping: float = 0.0) -> bool:
        """Whether a mass on a spring swings, and not so far beyond the band that it is a mass, nor so far below it
        that it stands still: its damping is one to ground, then. Turbulence may keep it from that in all but the
        calmest of the runs that come near its frequency.
        """
        frequency = np.sqrt(stiffness / mass) / (2.0 * np.pi)
        speed = min((calm for top, calm in self.tops if STIFF * top > frequency), default=self.speed)
        ratio = (damping + quadratic_damping * speed) / (2.0 * np.sqrt(stiffness * mass))
        return bool(self.low / BELOW < frequency < self.high and ratio < OVERDAMPED)


def _tops(view: View) -> Iterator[tuple[float, float]]:
    """Of each run the highest frequency in Hz, that of a sine of its stroke and speed, and half of its speed in m/s."""
    for run in view.runs:
        low, high = np.quantile(view.displacement(run), MIDST)
        speed = float(np.max(np.abs(view.velocity(run))))
        yield speed / max(np.pi * float(high - low), 1e-300), 0.5 * speed


def _form(form: str, element: str, mass: str, modes: Sequence[Mode], unknowns: int, band: Band) -> Suspect:
    def columns(view: View, run: str) -> Array:
        return view.respond(run, element, [mode.values(mass, 1.0) for mode in modes])

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        strength, place = atoms[0]
        found = modes[int(place)].values(mass, strength)
        found[mass] = max(found[mass], SMALLEST_MASS)
        return add_branch(text, branch_lines(free_name(text, "resonance"), element, found, UNITS))

    def admits(found: Mapping[str, float]) -> bool:
        return band.shows(found[mass], found["stiffness"], found["damping"], found.get("quadratic_damping", 0.0))

    grid = tuple(map(float, range(len(modes))))
    return Suspect(
        form, grid, columns, extend, unknowns=unknowns, quantity="stiffness", unit="N/m", admits=admits, of_motion=True
    )
