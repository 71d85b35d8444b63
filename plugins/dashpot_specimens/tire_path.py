"""What the rig does to the tire: quasi-static loops and sweeps, with the exact velocity, at eight steps per sample."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

STEP = 1.0 / 8000.0


@dataclass(frozen=True)
class DrivenPath:
    """Deflection [m] and its velocity [m/s] at every `STEP`, shape (steps,)."""

    deflection: np.ndarray
    velocity: np.ndarray


def sweep(amplitude: float, preload: float, start: float, stop: float, duration: float) -> DrivenPath:
    """A sine of linearly rising frequency [Hz] around `preload` [m]; the actuator loses 3 % of `amplitude` at 25 Hz."""
    time = np.arange(round(duration / STEP)) * STEP
    rate = (stop - start) / duration
    frequency = start + rate * time
    angle = 2 * np.pi * (start + rate * time / 2) * time
    fade, fade_slope = _smooth_step(time / 0.3)
    kept, kept_slope = 1 - 0.03 * (frequency / 25) ** 2, -0.06 * frequency * rate / 25**2
    level, level_slope = fade * kept, fade_slope / 0.3 * kept + fade * kept_slope
    velocity = level_slope * np.sin(angle) + level * 2 * np.pi * frequency * np.cos(angle)
    return DrivenPath(preload + amplitude * level * np.sin(angle), amplitude * velocity)


def loops(depth: float, duration: float, count: int) -> DrivenPath:
    """`count` triangles between zero and `depth` [m]; the speed fades out and in within 0.1 s of every corner."""
    period = duration / count
    time = np.arange(round(duration / STEP)) * STEP % period
    to_corner = np.abs((time + period / 4) % (period / 2) - period / 4)
    velocity = np.sign(period / 2 - time) * _smooth_step(to_corner / 0.1)[0]
    deflection = np.concatenate([[0.0], np.cumsum(0.5 * STEP * (velocity[1:] + velocity[:-1]))])
    scale = depth / deflection.max()
    return DrivenPath(scale * deflection, scale * velocity)


def _smooth_step(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """3 u^2 - 2 u^3 between zero and one, and its slope."""
    u = np.clip(u, 0.0, 1.0)
    return u * u * (3 - 2 * u), 6 * u * (1 - u)
