"""A linear quarter car under a wheel tester, and its frequency response in closed form, after a textbook."""

from __future__ import annotations

import numpy as np

BODY, WHEEL, SPRING, CARCASS, GRAVITY = 346.0, 36.0, 25.57e3, 150.0, 9.81
STATIC, AMPLITUDE = (BODY + WHEEL) * GRAVITY, 3e-3


def car(damping: float, tire: float) -> str:
    """The network of a car with a damping in N s/m and a stiffness of the tire in N/m."""
    return f"""\
format: dashpot-network/1
name: car
gravity: {GRAVITY} m/s^2
nodes:
  platform: driven
  wheel: {{mass: {WHEEL} kg, added_mass: {{setting: added_mass, value: 0 kg}}}}
  body: {{mass: {BODY} kg}}
branches:
  tire: {{element: spring, stiffness: {tire}, between: [platform, wheel], offset: {STATIC / tire}}}
  carcass: {{element: damper, damping: {CARCASS}, between: [platform, wheel]}}
  suspension: {{element: spring, stiffness: {SPRING}, between: [wheel, body], offset: {BODY * GRAVITY / SPRING}}}
  absorber: {{element: damper, damping: {damping}, between: [wheel, body]}}
"""


def response(frequency: np.ndarray, damping: float, tire: float, wheel: float = WHEEL) -> np.ndarray:
    """Contact force over platform motion (n,) in N/m: two masses on springs."""
    s = 2j * np.pi * frequency
    contact, inner = tire + s * CARCASS, SPRING + s * damping
    return contact * (1.0 - contact / (contact + wheel * s**2 + inner * BODY * s**2 / (BODY * s**2 + inner)))


def least_force(damping: float, tire: float, added: float = 0.0) -> float:
    """The least contact force in per cent of the static one, of a slow sweep, with so much ``added`` to the wheel."""
    largest = np.abs(response(np.arange(1.0, 25.0, 0.02), damping, tire, WHEEL + added)).max()
    return 100.0 * (1.0 - AMPLITUDE * float(largest) / (STATIC + added * GRAVITY))
