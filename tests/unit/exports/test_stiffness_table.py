"""Tables of dynamic stiffness."""

from __future__ import annotations

import csv

import numpy as np
import pytest

from dashpot import declare, load_registry
from dashpot.text.problem import InputError

VISCOELASTIC = """
format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: 220 N/mm}
  damping: {element: damper, damping: 500 N*s/m}
  relaxation: {element: maxwell, stiffness: 150 N/mm, relaxation_time: 10 ms}
"""
DRY = """
format: dashpot-network/1
name: mount
branches: {friction: {element: dahl, stiffness: 100 kN/mm, limit: 50 N}}
"""
COUPLED = """
format: dashpot-network/1
name: mount
nodes: {left: driven, right: driven}
branches: {rubber: {element: spring, between: [left, right], stiffness: 220 N/mm}}
"""


def rows(text: str, **options) -> np.ndarray:
    files = load_registry().exports["stiffness_table"](**options).files(declare(text))
    assert files["mount_stiffness.txt"].startswith(b"mount: network ")
    content = files["mount_stiffness.csv"]
    head, units, *lines = csv.reader(content.decode().splitlines())
    assert head[:3] == ["frequency", "amplitude", "preload"] and units[:3] == ["Hz", "m", "m"]
    return np.array(lines, dtype=float)


def test_a_linear_network_has_the_stiffness_of_the_textbook():
    found = rows(VISCOELASTIC, preloads=(0.0, 5e-3))
    rate = 2j * np.pi * found[:, 0]
    expected = 220e3 + 500.0 * rate + 150e3 * rate * 0.01 / (1.0 + rate * 0.01)
    assert found[:, 3] + 1j * found[:, 4] == pytest.approx(expected, rel=1e-4)
    assert found[:, 5] == pytest.approx(abs(expected), rel=1e-4)
    assert found[:, 6] == pytest.approx(np.degrees(np.angle(expected)), abs=0.01)


def test_dry_friction_loses_the_same_force_at_every_frequency():
    found = rows(DRY)
    assert found[:, 4] * found[:, 1] == pytest.approx(np.full(len(found), 4.0 / np.pi * 50.0), rel=0.02)


def test_a_network_with_two_driven_ends_is_refused():
    with pytest.raises(InputError, match="needs a network with one driven end, got 2"):
        rows(COUPLED)


def test_a_negative_amplitude_is_refused():
    with pytest.raises(ValueError, match="expected more than 0"):
        rows(DRY, amplitudes=(-1.0,))


def test_rows_outside_of_the_identification_are_told():
    seen = VISCOELASTIC + "identified: {range: {preload: [2 mm, 6 mm], frequency: [2 Hz, 20 Hz]}}\n"
    told = load_registry().exports["stiffness_table"]().files(declare(seen))["mount_stiffness.txt"].decode()
    assert "outside of the range of identification: frequency 1 Hz to 25 Hz, identified in 2 Hz to 20 Hz." in told
    assert set(rows(seen)[:, 2]) == {2e-3, 4e-3, 6e-3}
