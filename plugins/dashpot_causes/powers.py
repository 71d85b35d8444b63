"""What dampers with a power of the velocity share: which powers are turbulent, and where their force is told."""

from __future__ import annotations

from dashpot.contract.cause import View

NEARLY_ONE = (0.9, 1.1)  # exponents that count as viscous
NEARLY_TWO = (1.7, 2.3)  # powers that still stand for turbulent flow
SHARE = 0.3  # of the largest speed


def reference_speed(view: View) -> float:
    """The velocity in m/s, rounded, at which the force of a power is told."""
    return float(f"{SHARE * view.speed:.2g}")
