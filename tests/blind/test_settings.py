"""A law that follows a setting is found with it: rubber that relaxes less, the warmer it is.

In the mean over the temperatures neither the law nor the setting explains much. The force of the relaxing part is the
closed form of a spring in series with a dashpot that a sine begins to move; its stiffness is an exponential of the
temperature, along which no element goes.
"""

from __future__ import annotations

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.diagnose.diagnose import diagnose
from dashpot.model.reading import parse_network, read_network

PLAIN = """\
format: dashpot-network/1
name: plain
branches:
  stiffness: {element: spring, stiffness: {start: 30 N/mm}}
  damping: {element: damper, damping: {start: 200 N*s/m}}
"""
STEP, NOISE = 2e-3, 2.0
TEMPERATURES, SOFTER = (293.15, 313.15, 333.15, 343.15), 0.035  # K, 1/K
RATES = {0.5: 12e-3, 1.6: 12e-3, 4.5: 4e-3}  # Hz, m
STIFFNESS, FALLS, DAMPING = 90e3, 350.0, 150.0  # N/m, N/m for each K, N*s/m
RELAXING, TIME = 60e3, 0.07  # N/m, s


def force(time: np.ndarray, rate: float, amplitude: float, warmer: float) -> np.ndarray:
    """The force (n,) N along a sine that begins at zero."""
    w = 2.0 * np.pi * rate
    relaxing = RELAXING * np.exp(-SOFTER * warmer) * amplitude * w * TIME / (1.0 + (w * TIME) ** 2)
    course = w * TIME * np.sin(w * time) + np.cos(w * time) - np.exp(-time / TIME)
    elastic = (STIFFNESS - FALLS * warmer) * amplitude * np.sin(w * time)
    return elastic + DAMPING * amplitude * w * np.cos(w * time) + relaxing * course


def measured(seed: int) -> Dataset:
    """Three sines at each temperature, in mixed order."""
    rng = np.random.default_rng(seed)
    conditions = [(rate, amplitude, hot) for hot in TEMPERATURES for rate, amplitude in RATES.items()]
    runs = []
    for order, k in enumerate(rng.permutation(len(conditions)).tolist()):
        rate, amplitude, hot = conditions[k]
        time = STEP * np.arange(int(max(4.0 / rate, 2.0) / STEP))
        shown = force(time, rate, amplitude, hot - TEMPERATURES[0]) + NOISE * rng.standard_normal(time.size)
        motion = amplitude * np.sin(2.0 * np.pi * rate * time)
        settings = {"amplitude": amplitude, "preload": 0.0, "frequency": rate, "temperature": hot}
        channels = {"displacement": motion, "force": shown}
        runs.append(Run(f"r{k}", "harmonic", time, channels, settings, None, f"r{k}", order=order))
    return Dataset("rubber", tuple(runs))


def test_a_law_whose_numbers_follow_a_setting_is_found_with_it(seed):
    registry = load_registry()
    model = read_network("kelvin_voigt", registry.elements)
    found = diagnose(model, measured(seed), registry=registry).as_dict()
    print(found["verdict"], [(cause["cause"], cause["probability"]) for cause in found["causes"]], found["rmse"])
    names = {cause["cause"] for cause in found["causes"] if cause["accepted"]}
    assert "setting_dependence" in names and names & {"relaxation", "compliant_damper"}
    assert not any(cause["class"] == "measurement" for cause in found["causes"] if cause["accepted"])
    assert all("on temperature" in each["title"] for each in found["causes"] if each["cause"] == "setting_dependence")
    assert found["rmse"]["after"]["train"] < 2.0 * NOISE


AREA = 9e-4  # m^2


def sealed(seed: int) -> Dataset:
    """Eight sweeps of spring and dashpot with a pressure behind a piston, in no order."""
    rng, runs = np.random.default_rng(seed), []
    for number, pressure in enumerate((1.0, 2.0, 3.0, 4.0, 1.5, 3.5, 2.5, 2.0)):
        amplitude = (1e-3, 2e-3, 3e-3)[number % 3]
        time = 1e-3 * np.arange(4000)
        phase = 2.0 * np.pi * (time + 2.0 * time**2)
        motion, speed = amplitude * np.sin(phase), amplitude * 2.0 * np.pi * (1.0 + 4.0 * time) * np.cos(phase)
        shown = 50e3 * motion + 400.0 * speed + AREA * 1e5 * pressure + NOISE * rng.standard_normal(time.size)
        settings = {"amplitude": amplitude, "preload": 0.0, "pressure": 1e5 * pressure}
        channels = {"displacement": motion, "force": shown}
        runs.append(Run(f"r{number}", "sweep", time, channels, settings, None, f"r{number}", order=number))
    return Dataset("piston", tuple(runs))


def test_a_pressure_on_a_piston_is_a_force_over_the_pressure(seed):
    """Its mean is a force at zero deflection, and not a gas spring that nothing tells."""
    registry = load_registry()
    spec = parse_network(PLAIN, registry.elements)
    found = diagnose(spec, sealed(seed), registry=registry)
    assert {named.cause.word for named in found.named if named.accepted} == {"setting_dependence", "stiffness_curve"}
    slopes = [slot.value.over.numbers[0].number for slot in found.written.slots() if slot.value.over]
    assert slopes == pytest.approx([AREA], rel=0.02)
    assert found.after.held_out < 1.05 * NOISE
