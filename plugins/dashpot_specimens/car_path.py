"""What the rigs do to the car and to its tire, at every 50 us."""

from __future__ import annotations

import numpy as np

from dashpot_specimens.car_laws import STEP


def sweep(amplitude: float, start: float, stop: float, duration: float) -> np.ndarray:
    """A sine of linearly rising frequency in Hz, shape (steps,); it fades in within half a second."""
    time = np.arange(round(duration / STEP)) * STEP
    angle = 2 * np.pi * (start + (stop - start) / duration * time / 2) * time
    u = np.clip(time / 0.5, 0.0, 1.0)
    return amplitude * u * u * (3 - 2 * u) * np.sin(angle)


def triangle(low: float, high: float, duration: float, loops: int = 2) -> np.ndarray:
    """Slow loops between two positions in m, from near zero and back, all corners rounded over a quarter second."""
    period = duration / loops
    phase = np.arange(round(duration / STEP) + 1) * STEP / period % 1.0
    first = 0.5 * high / (high - low)
    corners = np.interp(phase, [0.0, first, first + 0.5, 1.0], [0.0, high, low, 0.0])
    width = round(0.25 / STEP)
    edge = np.pad(corners, width, mode="edge")
    total = np.cumsum(np.pad(edge, (1, 0)))
    return (total[width:] - total[:-width])[width // 2 : width // 2 + corners.size] / width
