"""The words for a misfit, on residuals whose nature is known."""

import numpy as np
import pytest
from seeds import seed_of

from dashpot.compare.misfit import describe_misfit
from dashpot.data.run import Run

TIME = np.arange(10_000) * 1e-3
PHASE = 2.0 * np.pi * (2.0 * TIME + 0.9 * TIME**2)


def sweep(name, amplitude):
    """A sweep from 2 to 20 Hz about 20 mm."""
    x = 0.02 + amplitude * np.sin(PHASE)
    return Run(name, "sweep", TIME, {"displacement": x, "force": 2e5 * x})


def words(residual):
    """What is said of a residual of one run of 2 mm."""
    return describe_misfit([sweep("a", 2e-3)], {"a": residual})


def test_a_residual_in_phase_is_storage_stiffness():
    """Positive residual in phase with deflection: the model is too soft."""
    found = words(50.0 * np.sin(PHASE))[0]
    assert found.what.startswith("storage stiffness of the model too small")
    assert found.share > 0.9


def test_a_residual_in_quadrature_is_loss_stiffness():
    """Negative residual in phase with velocity: the model has too much loss."""
    assert words(-50.0 * np.cos(PHASE))[0].what.startswith("loss stiffness of the model too large")


def test_harmonics_are_told_apart():
    """Second and third harmonic have their own words."""
    assert words(20.0 * np.sin(2.0 * PHASE))[0].what.startswith("second harmonic")
    assert words(20.0 * np.sin(3.0 * PHASE))[0].what.startswith("third and fifth harmonic")


def test_shares_are_those_of_the_time():
    """Half of the time of a sweep the model is too soft, in the other half its mean is wrong by as much squared."""
    slow = np.where(TIME < 5.0, 1.0, 0.0)
    found = words(slow * 50.0 * np.sin(PHASE) + (1.0 - slow) * 50.0 / np.sqrt(2.0))
    shares = {misfit.what.partition(" ")[0]: misfit.share for misfit in found}
    assert np.allclose([shares["storage"], shares["mean"]], 0.5, atol=0.03)


@pytest.mark.parametrize("power", [-1.0, 0.0, 1.0, 2.0])
def test_shares_are_of_one_total(power):
    """However the error changes along the sweep, and whatever is wrong before it begins to oscillate."""
    size = (2.0 + 1.8 * TIME) ** power
    assert 0.9 < sum(misfit.share for misfit in words(size * (np.sin(PHASE) + 0.5 * np.cos(2.0 * PHASE)))) <= 1.0
    rest = np.where(TIME < 4.0, 0.0, 1.0)
    late = 2.0 * np.pi * 5.0 * (TIME - 4.0)
    x = 2e-3 * rest * np.sin(late)
    run = Run("late", "harmonic", TIME, {"displacement": x, "force": 2e5 * x})
    found = describe_misfit([run], {"late": 30.0 * rest * np.sin(late) + 200.0 * (1.0 - rest)})
    assert sum(misfit.share for misfit in found) <= 1.0 and all(misfit.share < 0.1 for misfit in found)


def test_the_band_is_where_the_error_is():
    """An error in the upper half of the sweep is placed there."""
    late = np.where(TIME > 7.5, 1.0, 0.0) * 50.0 * np.sin(PHASE)
    assert words(late)[0].where["band"].startswith("15")


def test_small_amplitudes_are_named_when_the_error_is_relatively_larger_there():
    """The same force error at 0.5 and 5 mm is a ten times larger stiffness error at 0.5 mm."""
    runs = [sweep("small", 5e-4), sweep("large", 5e-3)]
    found = describe_misfit(runs, {run.name: 30.0 * np.cos(PHASE) for run in runs})
    assert "at small amplitude" in found[0].what


def test_runs_without_a_phase_are_described_by_run():
    """Random motion has no harmonics: the worst run is named."""
    rng = np.random.default_rng(seed_of("test_misfit"))
    runs = [Run(n, "random", TIME, {"displacement": rng.standard_normal(TIME.size), "force": TIME}) for n in ("a", "b")]
    found = describe_misfit(runs, {"a": np.ones(TIME.size), "b": np.full(TIME.size, 9.0)})
    assert found[0].where["run"] == "b"


def harmonic(name, amplitude, frequency=2.0):
    """A steady run about the middle; its phase, too."""
    phase = 2.0 * np.pi * frequency * TIME
    x = amplitude * np.sin(phase)
    return Run(name, "harmonic", TIME, {"displacement": x, "force": 2e5 * x}), phase


def test_a_stiffness_wrong_in_both_ways_is_told_with_both_ends():
    """A constant stiffness through one that softens with amplitude is too small here and too large there."""
    (small, phase), (large, _) = harmonic("small", 1e-3), harmonic("large", 20e-3)
    found = describe_misfit([small, large], {"small": 30.0 * np.sin(phase), "large": -200.0 * np.sin(phase)})
    assert found[0].what == (
        "storage stiffness of the model too small at small amplitude and too large at large amplitude"
    )


def test_words_and_place_of_a_stiffness_error_agree():
    """A force error that is larger at 20 mm is a smaller error of stiffness there: the place is 1 mm."""
    (small, phase), (large, _) = harmonic("small", 1e-3), harmonic("large", 20e-3)
    found = describe_misfit([small, large], {"small": 30.0 * np.cos(phase), "large": 90.0 * np.cos(phase)})
    assert found[0].what.endswith("too small at small amplitude")
    assert found[0].where["amplitude"] == "1 mm"


def test_what_all_runs_share_is_no_place():
    """Runs of one frequency about one middle have neither a band nor a preload where the error is."""
    (small, phase), (large, _) = harmonic("small", 1e-3), harmonic("large", 20e-3)
    found = describe_misfit([small, large], {"small": 30.0 * np.cos(phase), "large": 30.0 * np.cos(phase)})
    assert set(found[0].where) == {"amplitude"}


def test_the_frequency_of_steady_runs_is_named():
    """With steady runs at two frequencies the place is a frequency, not a band between them."""
    (slow, one), (fast, other) = harmonic("slow", 1e-3, 2.0), harmonic("fast", 1e-3, 7.0)
    found = describe_misfit([slow, fast], {"slow": 1.0 * np.cos(one), "fast": 30.0 * np.cos(other)})
    assert found[0].where["band"] == "7 Hz"
