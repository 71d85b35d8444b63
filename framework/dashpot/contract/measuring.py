"""What stands between a specimen and the file: sensors with their errors, and on which side the load cell is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated


@dataclass(frozen=True)
class Measuring:
    """The measuring chain of a rig. Noise is Gaussian, its root mean square given.

    noise_memory: correlation time of one half of the power of the force noise, 0 for white noise. A load cell on the
    side of the ``platform`` also feels the force that moves ``platform_mass``; one at the ``hub`` does not. It shows
    ``gain * force(time - delay) + zero``. repeats: how often each dynamic run is measured.
    """

    force_noise: Annotated[float, "N"] = 0.0
    noise_memory: Annotated[float, "s"] = 0.0
    displacement_noise: Annotated[float, "m"] = 0.0
    side: str = "platform"
    platform_mass: Annotated[float, "kg"] = 0.0
    gain: float = 1.0
    delay: Annotated[float, "s"] = 0.0
    zero: Annotated[float, "N"] = 0.0
    repeats: int = 1

    def __post_init__(self) -> None:
        if self.side not in ("hub", "platform"):
            raise ValueError(f"side: expected hub or platform, got '{self.side}'")
        if min(self.force_noise, self.noise_memory, self.displacement_noise, self.platform_mass) < 0.0:
            raise ValueError("noise, noise_memory and platform_mass: expected numbers that are not negative")
        if self.repeats < 1:
            raise ValueError(f"repeats: expected at least 1, got {self.repeats}")
