"""Tables in which every lane finds its own segment: vectors of lanes that stand in different ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator
from seeds import seed_of
from unit.kernel.networks import compiled

from dashpot.data.drive import drive_from_path
from dashpot.kernel.system import CompiledSystem

LANES, SAMPLES, DT, AMPLITUDE = 43, 150, 1e-3, 0.012
AT = np.array([-0.011, -0.008, -0.004, -0.001, 0.0, 0.002, 0.003, 0.007, 0.010])
PATHS = """
    it:
      series:
        soft: {{element: spring, stiffness: {{deflection: {at}, force: {force}}}{scale}}}
        stiff: {{element: spring, stiffness: 100 N/mm}}
"""
SCALE = ", scale: {deflection: [-9 mm, -2 mm, 1 mm, 4 mm, 8 mm], factor: [1.4, 1.1, 1.0, 1.2, 1.7]}"


@pytest.fixture(scope="module")
def rng() -> np.random.Generator:
    seed = seed_of("test_lookups")
    print(f"seed {seed}")
    return np.random.default_rng(seed)


@pytest.fixture(scope="module")
def force(rng) -> np.ndarray:
    """Forces at the knots, rising."""
    heights = np.cumsum(np.append(0.0, np.diff(AT) * rng.uniform(5e4, 5e5, AT.size - 1)))
    return heights - heights[4]


def network(force: np.ndarray, scale: str = "") -> CompiledSystem:
    return compiled(PATHS.format(at=[f"{at} m" for at in AT], force=[f"{value:.9f} N" for value in force], scale=scale))


def run(system: CompiledSystem):
    omega, time = 2.0 * np.pi * 9.0, DT * np.arange(SAMPLES)
    x, v = AMPLITUDE * np.sin(omega * time), AMPLITUDE * omega * np.cos(omega * time)
    return system.prepare(drive_from_path(DT, x, v, -(omega**2) * x))


def spread_out(system: CompiledSystem, rng: np.random.Generator) -> np.ndarray:
    """Lanes in which the stiff spring takes from hardly anything to nearly all of the way."""
    values = np.repeat(system.start[None], LANES, axis=0)
    values[:, system.paths.index("it.stiff.stiffness")] = np.resize(np.geomspace(1e4, 1e8, 8), LANES) * np.exp(
        rng.uniform(-0.3, 0.3, LANES)
    )
    return values


def way(system: CompiledSystem, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How far the soft spring is pressed in every lane (lanes, samples), and the force."""
    found = system.solve(run(system), values)
    stiff = values[:, system.paths.index("it.stiff.stiffness")]
    return run(system).excitation.motions[system.outputs[0]].displacement - found.force[:, 0] / stiff[
        :, None
    ], found.force[:, 0]


def test_each_lane_has_the_force_of_its_own_segment(rng, force):
    system = network(force)
    values = spread_out(system, rng)
    pressed, found = way(system, values)
    segments = np.searchsorted(AT, pressed)
    assert len(np.unique(segments)) == AT.size + 1
    assert np.mean([len(np.unique(column)) > 2 for column in segments[:8].T]) > 0.5
    curve = PchipInterpolator(AT, [float(f"{value:.9f}") for value in force])
    ends = AT[0], AT[-1]
    beyond = pressed - np.clip(pressed, *ends)
    slope = np.where(beyond < 0.0, *(curve.derivative()(end) for end in ends))
    expected = curve(np.clip(pressed, *ends)) + slope * beyond
    assert np.abs(found - expected).max() < 1e-6 * np.abs(force).max()


@pytest.mark.parametrize("scale", ["", SCALE])
def test_company_in_other_segments_changes_no_bit(rng, force, scale):
    system = network(force, scale)
    values = spread_out(system, rng)
    together = system.solve(run(system), values)
    for number, lane in enumerate(values):
        alone = system.solve(run(system), lane)
        assert np.array_equal(alone.force[0], together.force[number])
        assert np.array_equal(alone.motion[0], together.motion[number])
