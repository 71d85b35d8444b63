"""The designs that dampers and bushings are really tested with, each with the specimens that are driven so."""

from __future__ import annotations

from dataclasses import dataclass

NO_LAW = "no_law"


@dataclass(frozen=True)
class Scenario:
    """A design of `truth.design.DESIGNS` and the specimens on it in turn.

    ``model``: the network that is diagnosed, None for that of the specimen; ``kind``: what is hidden, None for drawn.
    """

    design: str
    specimens: tuple[str, ...]
    model: str | None = None
    kind: str | None = None


SCENARIOS: dict[str, Scenario] = {
    "one speed a run": Scenario("speeds", ("damper", "kelvin_voigt")),
    "one sine a run": Scenario("sines", ("kelvin_voigt", "ftire")),
    "second harmonic": Scenario("second_harmonic", ("kelvin_voigt", "ftire")),
    "random only": Scenario("random", ("kelvin_voigt", "damper", "ftire")),
    "few runs": Scenario("few", ("kelvin_voigt", "ftire", "damper")),
    "no repeats": Scenario("no_repeats", ("kelvin_voigt", "ftire", "polynomial")),
    "no slow run": Scenario("no_quasi_static", ("kelvin_voigt", "ftire", "polynomial")),
    "richer model": Scenario("amplitudes", ("kelvin_voigt",), model="tire_model_3"),
    "poorer model": Scenario("amplitudes", ("ftire",), model="kelvin_voigt"),
    "no law fits": Scenario("full", ("kelvin_voigt", "ftire"), kind=NO_LAW),
}
