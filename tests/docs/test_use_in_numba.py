"""The lines of the page on numba run as they stand there."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from architecture.source import ROOT
from docs.test_pages import blocks
from scipy.integrate import solve_ivp

PAGE = ROOT / "docs" / "how-to" / "use-in-numba.md"
STIFFNESS, DAMPING = 200e3, 400.0
MOUNT = """\
format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: 200 N/mm}
  damping: {element: damper, damping: 0.4 N*s/mm}
"""


@cache
def first() -> dict[str, Any]:
    names: dict[str, Any] = {}
    exec(blocks(PAGE, "python")[0], names)
    return names


@pytest.fixture
def names(tmp_path, monkeypatch) -> dict[str, Any]:
    (tmp_path / "my_mount.yaml").write_text(MOUNT)
    monkeypatch.chdir(tmp_path)
    return dict(first())


def test_the_page_has_a_record_an_integrator_and_jax(names):
    assert [list(filter(None, block.splitlines()))[0].split()[1] for block in blocks(PAGE, "python")] == [
        "dashpot",
        "scipy.integrate",
        "jax",
    ]
    assert names["force"] == pytest.approx(STIFFNESS * names["x"] + DAMPING * names["v"], rel=1e-9)


def test_the_integrator_follows_the_motion_of_the_linear_mount(names):
    exec(blocks(PAGE, "python")[1], names)
    step, mass, place = names["STEP"], names["MASS"], names["place"]
    time = step * np.arange(1, place.size + 1)

    def motion(t, y):
        return y[1], (50.0 * np.sin(40.0 * t) - STIFFNESS * y[0] - DAMPING * y[1]) / mass

    expected = solve_ivp(motion, (0.0, time[-1]), (0.0, 0.0), t_eval=time, rtol=1e-10, atol=1e-14).y[0]
    # along its tangent a linear mount is followed exactly
    assert place == pytest.approx(expected, abs=1e-5 * np.max(np.abs(expected)))


def test_jax_calls_the_solver(names):
    pytest.importorskip("jax")
    exec(blocks(PAGE, "python")[2], names)
    record = names["x"], names["v"], names["force"]
    assert float(names["misfit"](names["solver"].parameters, *record)) == 0.0
    assert float(names["misfit"](1.1 * names["solver"].parameters, *record)) > 0.0
