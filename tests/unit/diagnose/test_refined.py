"""A curve that the slow loop gives badly is refined to all runs, and what is told is what the file says."""

from dataclasses import replace

import numpy as np
import pytest
from unit.diagnose.rig import MOTIONS, SAMPLES, STIFFNESS, dataset

import dashpot as dp
from dashpot.data.run import Run
from dashpot.model.reading import parse_network

CURVED = """\
format: dashpot-network/1
name: curved
branches:
  stiffness: {element: spring, stiffness: {from: quasi_static}}
  damping: {element: damper, damping: {start: 200 N*s/m}}
"""


def with_slow_run(wander):
    """The sound runs, and a slow triangle over all deflections whose force wanders by so much in N."""
    data = dataset()
    time = 0.05 * np.arange(4 * SAMPLES)
    x = np.interp(time, time[-1] * np.array([0.0, 0.5, 1.0]), [1e-3, 15e-3, 1e-3])
    force = STIFFNESS * x + wander * np.cos(6.0 * np.pi * time / time[-1])
    slow = Run("slow", "quasi_static", time, {"displacement": x, "force": force}, group="slow", order=len(MOTIONS))
    return replace(data, runs=(*data.runs, slow))


def test_a_slow_loop_that_wanders_does_not_give_the_curve_of_the_file():
    registry = dp.load_registry()
    found = dp.diagnose(parse_network(CURVED, registry.elements), with_slow_run(60.0), jobs=1)
    assert found.named == () and found.extended_name == "curved+refined.yaml"
    assert found.after.train < 0.9 * found.before.train
    assert "its curves refined to all runs" in found.extended_text


def test_a_curve_that_follows_all_runs_stays_as_the_slow_loop_gives_it():
    found = dp.diagnose(parse_network(CURVED, dp.load_registry().elements), with_slow_run(0.0), jobs=1)
    assert found.named == () and found.extended_name is None
    # what is told of runs left out is that of the written network as well: its curve is not fitted to the others
    [slot] = [slot for slot in found.fit.fitted.slots() if slot.value.searched]
    assert slot.path == "damping.damping"
    assert found.left_out == pytest.approx(found.after.train, rel=3e-4)
