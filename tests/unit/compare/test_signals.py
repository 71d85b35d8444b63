"""The evidence of a report groups runs by what they were meant to be."""

from dataclasses import replace

import numpy as np
import pytest

from dashpot.compare.signals import WHOLE_RUN, signal_evidence
from dashpot.data.run import Run

TIME = np.arange(8000) * 1e-3


def run(name, amplitude, stop=2.0, kind="sweep"):
    """From 2 Hz to ``stop``."""
    x = amplitude * np.sin(2.0 * np.pi * (2.0 * TIME + 0.5 * (stop - 2.0) / 8.0 * TIME**2))
    return Run(name, kind, TIME, {"displacement": x, "force": 1e5 * x}, {"amplitude": round(amplitude, 4)})


def evidence(*runs):
    """Of a model that is a tenth too soft."""
    return signal_evidence(runs, {"before": {each.name: 0.1 * each.force for each in runs}})


def test_repeats_of_an_amplitude_share_its_harmonics():
    """Two regulators' worth of 1 mm are one group."""
    assert list(evidence(run("a", 1.0003e-3), run("b", 0.9998e-3))["harmonics"]["before"]) == ["1 mm"]


def test_a_steady_run_is_one_point_of_dynamic_stiffness():
    """And a sweep many."""
    steady, sweep = evidence(run("a", 1e-3), run("b", 1e-3, 20.0))["dynamic_stiffness"]
    assert steady["frequency"].size == 1 and sweep["frequency"].size > 20
    assert steady["measured"]["stiffness"][0] == pytest.approx(1e5, rel=1e-3)
    assert steady["simulated"]["before"]["stiffness"][0] == pytest.approx(0.9e5, rel=1e-3)


def test_the_faded_ends_of_a_sweep_are_no_points_of_its_amplitude():
    """A force that grows less than the deflection is stiffer where the sweep fades out."""
    fade = np.clip(np.minimum(TIME, TIME[-1] - TIME) / 0.5, 0.0, 1.0)
    whole = run("a", 1e-3, 22.0)
    x = fade * whole.displacement
    softening = 1e5 * x * (1.0 - 2e5 * x**2)
    faded = replace(whole, channels={"displacement": x, "force": softening})
    [curve] = evidence(faded)["dynamic_stiffness"]
    # the fundamental of x - 2e5 x^3 at 1 mm
    assert curve["measured"]["stiffness"] == pytest.approx(1e5 * (1.0 - 0.75 * 2e5 * 1e-6), rel=0.01)


def test_an_amplitude_that_falls_over_the_whole_sweep_is_kept():
    """As that of a rig at constant speed."""
    whole = run("a", 1e-3, 22.0)
    slower = replace(whole, channels={name: values / (1.0 + TIME) for name, values in whole.channels.items()})
    kept, constant = (evidence(each)["dynamic_stiffness"][0]["frequency"] for each in (slower, whole))
    assert kept.max() == pytest.approx(constant.max(), rel=0.1)


def test_a_map_of_steady_runs_has_no_bands():
    """There is nothing to cut."""
    rows = evidence(run("a", 1e-3), run("b", 2e-3))["misfit_map"]
    assert [row["band"] for row in rows] == [WHOLE_RUN] * 2
    assert rows[1]["rmse"]["before"] == pytest.approx(0.1 * 1e5 * 2e-3 / np.sqrt(2.0), rel=1e-2)


def test_sweeps_are_cut_into_the_same_bands():
    """From the slowest to the fastest of them."""
    rows = evidence(run("a", 1e-3, 12.0), run("b", 1e-3, 22.0))["misfit_map"]
    bands = {name: [row["band"] for row in rows if row["run"] == name] for name in "ab"}
    assert bands["b"] == [(0, 5), (5, 10), (10, 15), (15, 20), (20, 25)]
    assert bands["a"] == bands["b"][:3]


def test_the_map_leaves_out_the_warm_up_as_all_errors_do():
    """A residual that ends with the warm-up is not shown."""
    each = run("a", 1e-3, kind="harmonic")
    each = replace(each, settings={**each.settings, "warm_up": 2.0})
    (row,) = signal_evidence((each,), {"before": {"a": np.where(TIME < 2.0, 1e3, 3.0)}})["misfit_map"]
    assert row["rmse"]["before"] == pytest.approx(3.0)
