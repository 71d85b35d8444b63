"""What a bushing property file holds of a network, and what it says of the rest."""

from __future__ import annotations

import csv
import re

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from dashpot import declare, load_registry

HEAD = "format: dashpot-network/1\nname: mount\nbranches:\n"
PLAIN = (
    HEAD
    + """\
  rubber: {element: spring, stiffness: 220 N/mm}
  damping: {element: damper, damping: 500 N*s/m}
"""
)
DRY = PLAIN + "  friction: {element: dahl, stiffness: 2000 N/mm, limit: 50 N}\n"
LOSSY = (
    PLAIN.replace("  damping: {element: damper, damping: 500 N*s/m}\n", "")
    + """\
  relaxation: {element: maxwell, stiffness: 60 N/mm, relaxation_time: 5 ms}
  friction: {element: dahl, stiffness: 2000 N/mm, limit: 50 N, exponent: 0}
"""
)


def converted(text: str, **options) -> tuple[str, np.ndarray]:
    files = load_registry().exports["gbs"](**options).files(declare(text))
    head, units, *rows = csv.reader(files["mount_conversion.csv"].decode().splitlines())
    assert (head[-2:], units[-2:]) == (["error", "share"], ["N", "1"])
    return files["mount.gbs"].decode(), np.array(rows, dtype=float)


def curve(text: str) -> np.ndarray:
    return np.array(
        [line.split() for line in text.partition("{ disp force }\n")[2].partition("[")[0].splitlines()], dtype=float
    )


def test_a_spring_and_a_damper_are_converted_without_error():
    text, rows = converted(PLAIN)
    place, force = curve(text).T
    assert force == pytest.approx(220.0 * place, rel=1e-6, abs=1e-2)
    assert float(re.search(r"^C = (.*)$", text, re.MULTILINE)[1]) == pytest.approx(0.5, rel=1e-6)
    assert np.all(rows[:, 4] < 1e-6) and "the largest error" in text.lower()


def test_what_is_left_out_is_told_as_an_error():
    _, rows = converted(DRY)
    # dry friction is about its limit, of which the best viscous damping takes a part away
    assert np.all((rows[:, 3] > 5.0) & (rows[:, 3] < 100.0))
    text, _ = converted(DRY)
    place, force = curve(text).T
    assert force == pytest.approx(220.0 * place, rel=1e-3, abs=6.0)


def test_the_direction_is_the_only_active_one():
    text, _ = converted(PLAIN, direction="FX", preloads=(5e-3,))
    assert "'SPLINE_STIFFNESS' 1 0 0 0 0 0" in text and "'RUBBER_DAMPING' 0 0 0 0 0 0" in text
    assert "[SPLINE_STIFFNESS_FX]" in text and "[CONSTANT_DAMPING_FX]" in text
    assert curve(text)[-1, 0] == pytest.approx(7.0)
    with pytest.raises(ValueError, match="expected one of FX, FY, FZ, got 'TX'"):
        converted(PLAIN, direction="TX")


def relaxing_and_sliding(time: np.ndarray, x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """The force (n,) of LOSSY by its own equations, with short Runge-Kutta steps of the relaxation."""
    slipping, relaxing, force = 0.0, 0.0, [220e3 * x[0]]
    for k in range(1, time.size):
        step, middle = time[k] - time[k - 1], 0.5 * (v[k - 1] + v[k])
        rates = [60e3 * v[k - 1] - relaxing / 5e-3]
        rates += [60e3 * middle - (relaxing + 0.5 * step * rates[0]) / 5e-3]
        rates += [60e3 * middle - (relaxing + 0.5 * step * rates[1]) / 5e-3]
        rates += [60e3 * v[k] - (relaxing + step * rates[2]) / 5e-3]
        relaxing += step / 6.0 * (rates[0] + 2.0 * rates[1] + 2.0 * rates[2] + rates[3])
        # a slider behind a spring: the force follows the spring as far as the slider holds
        slipping = float(np.clip(slipping + 2000e3 * (x[k] - x[k - 1]), -50.0, 50.0))
        force.append(220e3 * x[k] + relaxing + slipping)
    return np.array(force)


def test_the_error_told_is_that_of_what_is_written_against_the_laws():
    text, rows = converted(LOSSY)
    place, given = curve(text).T
    damping = float(re.search(r"^C = (.*)$", text, re.MULTILINE)[1])
    for frequency, amplitude, preload, error, share in rows:
        # eight periods of 4000 samples, the last one counts; mm, N and N s/mm, as the head of the file says
        time = np.arange(8 * 4000 + 1) / (4000 * frequency)
        phase = 2.0 * np.pi * frequency * time
        x, v = preload + amplitude * np.sin(phase), 2.0 * np.pi * frequency * amplitude * np.cos(phase)
        truth = relaxing_and_sliding(time, x, v)[-4000:]
        written = CubicSpline(place, given)(1e3 * x[-4000:]) + damping * 1e3 * v[-4000:]
        own = np.sqrt(np.mean((written - truth) ** 2))
        assert error == pytest.approx(own, rel=1e-3)
        assert share == pytest.approx(own / np.std(truth), rel=1e-3)


IDENTIFIED = """
identified:
  range: {displacement: [5 mm, 15 mm], speed: [0 m/s, 1 m/s], amplitude: [1 mm, 4 mm], preload: [8 mm, 12 mm]}
"""


def test_sines_stand_at_the_preloads_of_the_identification_and_those_outside_are_told():
    text, rows = converted(DRY + IDENTIFIED)
    assert set(rows[:, 2]) == {8e-3, 10e-3, 12e-3}
    assert "$ Sines outside of the range of identification: amplitude 0.5 mm to 2 mm" in text
    text, _ = converted(DRY + IDENTIFIED, amplitudes=(2e-3,), frequencies=(1.0, 5.0))
    assert "Sines outside" not in text
