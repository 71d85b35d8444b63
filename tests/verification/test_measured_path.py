"""Forces along a measured path: what the estimate of rates and turning points adds to them is next to nothing.

The phantom of a noisy displacement sensor is what stays of the error on average over many measurements of one motion.
The truth are closed forms along the exact path.
"""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from verification.alone import network_of

from dashpot.data.drive import drive_from_samples, moved_drive

DT, SENSOR, DRAWS = 1e-3, 2e-6, 20
NOISE = 5.0  # N, of a good load cell below a tire
SHARE = 0.02
INSIDE = slice(200, -30)
FINE = 20  # parts of a sample
STIFFNESS, LIMIT = 80e3, 40.0
LAWS = {
    "damper": ({"damping": "400 N*s/m"}, lambda x, v, a: 400.0 * v),
    "quadratic_damper": ({"damping": "300 N*s^2/m^2"}, lambda x, v, a: 300.0 * v * np.abs(v)),
    "inerter": ({"inertance": "0.5 kg"}, lambda x, v, a: 0.5 * a),
    "dahl": ({"stiffness": "80 N/mm", "limit": "40 N"}, lambda x, v, a: friction(x)),
}


def friction(x):
    """The force relaxes towards the limit on the side of the motion, exactly so between two points of a fine path."""
    force = np.zeros(x.size)
    for number, change in enumerate(np.diff(x), 1):
        aim = np.copysign(LIMIT, change)
        force[number] = aim + (force[number - 1] - aim) * np.exp(-abs(change) * STIFFNESS / LIMIT)
    return force


def sweep(amplitude, seconds=5.0, start=1.0, stop=25.0):
    time, rate = np.arange(0.0, seconds, DT / FINE), 2.0 * np.pi * (stop - start) / seconds
    angle, speed = 2.0 * np.pi * start * time + 0.5 * rate * time**2, 2.0 * np.pi * start + rate * time
    x, v = amplitude * np.sin(angle), amplitude * speed * np.cos(angle)
    return x, v, amplitude * (rate * np.cos(angle) - speed**2 * np.sin(angle))


def slow_stroke(amplitude, seconds=12.0):
    time, omega = np.arange(0.0, seconds, DT / FINE), 2.0 * np.pi / seconds
    x, v = amplitude * (1.0 - np.cos(omega * time)), amplitude * omega * np.sin(omega * time)
    return x, v, amplitude * omega**2 * np.cos(omega * time)


MOTIONS = {"large sweep": sweep(5e-3), "small sweep": sweep(0.5e-3), "slow stroke": slow_stroke(18e-3)}


@pytest.mark.parametrize("element", LAWS)
def test_a_noisy_path_leaves_no_phantom(element, state):
    (numbers, law), rng = LAWS[element], np.random.default_rng(seed_of("test_measured_path"))
    network = network_of(element, **numbers)
    for name, motion in MOTIONS.items():
        truth, x = law(*motion)[::FINE], motion[0][::FINE]
        noisy = [x + SENSOR * rng.standard_normal(x.size) for _ in range(DRAWS)]
        errors = np.array([network.simulate(network.prepare(drive_from_samples(DT, path))) - truth for path in noisy])
        errors = errors[:, INSIDE]
        chance = np.mean(np.var(errors, axis=0, ddof=1)) / DRAWS
        phantom = np.sqrt(max(np.mean(np.mean(errors, axis=0) ** 2) - chance, 0.0))
        state(f"{element}, {name}: a phantom of {phantom:.4f} N, {phantom / NOISE:.4f} of the noise")
        assert phantom < SHARE * NOISE


def test_the_velocity_of_a_slow_path_is_smoother_than_that_of_a_fast_one():
    errors, rng = {}, np.random.default_rng(seed_of("test_measured_path2"))
    for name, (x, v, _) in MOTIONS.items():
        noisy = x[::FINE] + SENSOR * rng.standard_normal(x[::FINE].size)
        errors[name] = np.std((drive_from_samples(DT, noisy).velocity - v[::FINE])[INSIDE])
    assert errors["slow stroke"] < 0.3 * errors["large sweep"]


def test_a_moved_path_is_not_smoothed_once_more():
    noise = np.random.default_rng(seed_of("test_measured_path3")).standard_normal(5000)
    x = MOTIONS["small sweep"][0][::FINE] + SENSOR * noise
    drive = drive_from_samples(DT, x)
    same = moved_drive(drive, np.zeros(x.size))
    assert np.array_equal(same.displacement, drive.displacement)
    assert np.array_equal(same.velocity, drive.velocity)
    change, v, _ = (signal[::FINE] for signal in slow_stroke(1e-4, 5.0))
    moved = moved_drive(drive, change)
    assert moved.displacement - drive.displacement == pytest.approx(change, abs=1e-12)
    assert moved.velocity - drive.velocity == pytest.approx(v, abs=1e-7)
