"""The equations of W1 as somebody would write them for an integrator, by hand."""

from __future__ import annotations

import numpy as np
from laws import Equations, Tongue, table_of
from workload import FASTEST, SLOWEST, Sweep, network

HELD = "damping.scale"


def tire_equations(sweep: Sweep, tongue: Tongue) -> Equations:
    """Tire model 5 on a sweep, with the numbers of its file."""
    read, dahl, prandtl = tongue.read, tongue.dahl, tongue.prandtl
    compiled = network()
    numbers = dict(zip(compiled.paths, compiled.start.tolist(), strict=True))
    spring, held = (table_of(compiled.curves[path], path == HELD) for path in ("stiffness.stiffness", HELD))
    laws = np.array(
        [
            *((numbers[f"maxwell_{k}.stiffness"], numbers[f"maxwell_{k}.relaxation_time"]) for k in (1, 2, 3)),
            *((numbers[f"prandtl_{k}.stiffness"], numbers[f"prandtl_{k}.limit"]) for k in (1, 2, 3)),
            (numbers["friction.stiffness"], numbers["friction.limit"]),
        ]
    )
    damping, amplitude, preload = numbers["damping.damping"], sweep.amplitude, sweep.preload
    faster = (FASTEST - SLOWEST) / sweep.seconds

    @tongue.compiled
    def motion(t):  # noqa: ANN001, ANN202
        phase, turning = 2.0 * np.pi * (SLOWEST + 0.5 * faster * t) * t, 2.0 * np.pi * (SLOWEST + faster * t)
        return preload + amplitude * np.sin(phase), amplitude * np.cos(phase) * turning

    @tongue.compiled
    def rate(t, y, dy):  # noqa: ANN001, ANN202
        v = motion(t)[1]
        for k in range(3):
            dy[k] = laws[k, 0] * v - y[k] / laws[k, 1]
            dy[3 + k] = prandtl(y[3 + k], v, laws[3 + k])
        dy[6] = dahl(y[6], v, laws[6])

    @tongue.compiled
    def force(t, y):  # noqa: ANN001, ANN202
        x, v = motion(t)
        total = read(spring, x) + damping * read(held, x) * v
        for k in range(7):
            total += y[k]
        return (total,)

    return Equations(rate, force, np.zeros(7), np.ones(7))
