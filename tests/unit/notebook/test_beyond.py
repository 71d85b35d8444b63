"""Python warns, as the command line does, where a model leaves the range of its identification."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import dashpot as dp

TIME = np.arange(0.0, 2.0, 1e-3)


def sine(amplitude: float, name: str) -> dp.Data:
    x = amplitude * np.sin(2.0 * np.pi * 5.0 * TIME)
    return dp.Data.from_arrays(TIME, x, 2e5 * x, name=name, settings={"amplitude": f"{amplitude} m"})


@pytest.fixture(scope="module")
def fit() -> dp.Fit:
    return dp.fit(
        dp.Network("rubber", {"it": {"element": "spring", "stiffness": {"start": "150 N/mm"}}}), sine(1e-3, "a")
    )


def test_no_extrapolation_in_silence(fit):
    with pytest.warns(UserWarning, match="run 'big' lies outside of the range of identification.* amplitude 4 mm"):
        dp.simulate(fit.model, sine(4e-3, "big"))
    with pytest.warns(UserWarning, match="run 'big' lies outside"):
        fit.predict(sine(4e-3, "big"))
    with pytest.warns(UserWarning, match="lies outside of the range of identification"):
        dp.measure(fit.model, "triangle", depth="20 mm", loops=1)


def test_no_more_than_three_runs_are_named(fit):
    many = dp.Data.join([sine(4e-3, f"run_{number}") for number in range(5)], name="many")
    with pytest.warns(UserWarning) as told:
        dp.simulate(fit.model, many)
    (message,) = [str(each.message) for each in told]
    assert message.count("lies outside") == 3
    assert message.endswith("... and 2 more runs")


def test_inside_there_is_no_warning(fit):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        dp.simulate(fit.model, sine(0.999e-3, "as before"))
        dp.simulate(dp.Network("never fitted", {"it": {"element": "spring", "stiffness": "1 N/mm"}}), sine(4e-3, "big"))
