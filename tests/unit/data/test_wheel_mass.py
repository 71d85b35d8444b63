"""The mass of a wheel from contact force and wheel motion; truth: an oscillator in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.wheel_mass import WheelRun, wheel_mass

DT = 1e-3
TIME = DT * np.arange(12000)
ANGLE = 2.0 * np.pi * (5.0 + 15.0 / 12.0 * TIME / 2.0) * TIME
OMEGA = 2.0 * np.pi * (5.0 + 15.0 / 12.0 * TIME)
SPRING, DAMPING = 25e3, 1800.0


@pytest.fixture
def random() -> np.random.Generator:
    seed = seed_of("test_wheel_mass")
    return np.random.default_rng(seed)


def sweep(mass: float, added: float, random: np.random.Generator, rubber: float = np.inf) -> WheelRun:
    """A wheel that goes through its resonance, a sweep slow enough to be in its steady state.

    The damper grows weaker with speed, so that its loss and its mass can be told apart.
    """
    whole = mass + added
    amplitude = 3e-3 / np.sqrt((1.0 - OMEGA**2 * whole / 250e3) ** 2 + (0.25 * OMEGA / 70.0) ** 2)
    damping = DAMPING / (1.0 + amplitude * OMEGA / 0.8)
    damper = 1j * OMEGA * damping
    if np.isfinite(rubber):
        damper = damper * rubber / (damper + rubber)
    stiffness = SPRING - whole * OMEGA**2 + damper
    wheel = amplitude * np.sin(ANGLE)
    force = 3500.0 + np.imag(stiffness * amplitude * np.exp(1j * ANGLE))
    return WheelRun(
        wheel + 1e-6 * random.standard_normal(wheel.size), force + 5.0 * random.standard_normal(wheel.size), DT, added
    )


def variants(mass: float, random: np.random.Generator, rubber: float = np.inf) -> list[WheelRun]:
    return [sweep(mass, added, random, rubber) for added in (0.0, 8.0, 15.0)]


def test_a_wheel_with_a_rigid_damper_is_weighed(random):
    mass = random.uniform(35.0, 55.0)
    found = wheel_mass(variants(mass, random))
    assert found.mass == pytest.approx(mass, rel=2e-3)
    assert found.interval[0] - 0.05 <= mass <= found.interval[1] + 0.05


def test_rubber_that_is_left_out_makes_the_mass_too_small_and_is_found(random):
    mass, rubber = random.uniform(35.0, 55.0), random.uniform(300e3, 800e3)
    runs = variants(mass, random, rubber)
    rigid, elastic = wheel_mass(runs), wheel_mass(runs, elastic=True)
    assert rigid.mass < mass - 0.5
    assert elastic.mass == pytest.approx(mass, rel=0.01)
    assert 1.0 / elastic.compliance == pytest.approx(rubber, rel=0.25)


def test_a_single_frequency_cannot_tell_mass_from_spring():
    wheel = 3e-3 * np.sin(2.0 * np.pi * 10.0 * TIME)
    with pytest.raises(ValueError, match="sweep through the wheel resonance"):
        wheel_mass([WheelRun(wheel, 1e5 * wheel, DT)])
