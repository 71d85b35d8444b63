"""A fit without forces or without runs says what is missing before anything is searched."""

import numpy as np
import pytest

from dashpot.contract.registry import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network, prepare
from dashpot.model.reading import read_network
from dashpot.text.problem import InputError

REGISTRY = load_registry()
TIME = 1e-3 * np.arange(2000)
X = 1e-3 * np.sin(20.0 * TIME)


@pytest.mark.parametrize(
    "channels",
    [
        {"displacement@wheel": X, "displacement@body": 2.0 * X},
        {"displacement@wheel": X, "force@platform": 1e5 * X},
        {"displacement": X, "acceleration": X},
    ],
)
def test_runs_without_a_force_at_a_known_motion_are_named(channels):
    runs = tuple(Run(name, "harmonic", TIME, channels, group=name, source=f"{name}.csv") for name in ("r1", "r2"))
    with pytest.raises(InputError) as caught:
        prepare(Dataset("made", runs))
    assert len(caught.value.problems) == 2
    problem = caught.value.problems[0]
    assert problem.place.file == "r1.csv"
    assert "run 'r1' measures no force at a place whose displacement it measures" in problem.message
    assert all(f"'{name}'" in problem.message for name in channels)
    assert "force@NODE" in problem.hint


def test_nothing_is_fitted_to_held_out_runs_alone():
    channels = {"displacement": X, "force": 1e5 * X}
    runs = tuple(Run(name, "harmonic", TIME, channels, group=name, held_out=True) for name in ("r1", "r2"))
    with pytest.raises(InputError, match="expected runs to fit a network to, got 2, all of them held out"):
        fit_network(read_network("spring", REGISTRY.elements), Dataset("made", runs), registry=REGISTRY)
