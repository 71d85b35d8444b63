"""The run that is asked for next, where a model depends on a setting of the runs."""

import numpy as np
from unit.diagnose.rig import NETWORK, NOISE, SAMPLES, bench, dataset

from dashpot.diagnose.next_run import next_run
from dashpot.diagnose.whitening import Noise, learn_filter

OVER_PRELOAD = NETWORK.replace(
    "{start: 200 N*s/m}", "{start: 200 N*s/m, over: {setting: preload, at: 8 mm, rate: {start: 0 /m}}}"
)
SPRING = NETWORK.replace("  damping: {element: damper, damping: {start: 200 N*s/m}}\n", "")


def asked(first, second):
    """What is asked for between two networks fitted to the same runs, and the first of these."""
    data = dataset()
    one, other = bench(data, first), bench(data, second)
    white = learn_filter(NOISE * np.random.default_rng(0).standard_normal(SAMPLES), 1e-9)
    names = [run.name for run in one.refitter.runs]
    noise = Noise(dict.fromkeys(names, 1), dict.fromkeys(names, white))
    return next_run(one.refitter, one.model, other.model, noise), names[0]


def test_a_run_is_asked_for_with_the_settings_that_a_model_needs():
    found, first = asked(OVER_PRELOAD, SPRING)
    assert found.like == first
    assert f"with the settings of '{first}'" in found.words


def test_settings_that_no_model_needs_are_not_told():
    found, _ = asked(NETWORK, SPRING)
    assert found.like == "" and "settings" not in found.words
