"""How much of the residual is structure that no cause explains."""

import numpy as np
import pytest
from scipy.signal import lfilter
from unit.diagnose.rig import SAMPLES, STEP, bench, causes, dataset

from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.leftover import look_for_leftover
from dashpot.diagnose.look import look_at
from dashpot.diagnose.repeats import repeats_of
from dashpot.diagnose.whitening import reduction
from dashpot.fit.thinned import highest_frequency

AGAIN = {"again": "a3_p8", "once_more": "a1_p5"}
STRUCTURE, NOISE = 6.0, 8.0  # N


def coloured(seed, deviation, memory):
    """An autoregressive signal of the first order (n,) N, begun long before."""
    found = lfilter([1.0], [1.0, -memory], np.random.default_rng(seed).standard_normal(SAMPLES + 500))[500:]
    return deviation * found / np.std(found)


@pytest.mark.parametrize("memory", [0.0, 0.6, 0.9], ids=["white", "coloured", "slow"])
def test_the_share_of_a_structure_that_comes_again_is_that_of_the_squares_in_newtons(memory):
    """In runs and their repeats alike, beside noise of another spectrum: the share is known of the signals made."""
    pairs = [*AGAIN.items()]
    structure = {new: coloured(7 + k, STRUCTURE, 0.8) for k, (new, _) in enumerate(pairs)}
    structure |= {old: structure[new] for new, old in pairs}
    noise = {name: coloured(100 + k, NOISE, memory) for k, name in enumerate(structure)}
    fault = {name: lambda force, name=name: force + structure[name] + noise[name] for name in structure}
    made = bench(dataset(repeats=AGAIN, fault=fault, noise=0.01))
    look = look_at(made.refitter, made.model, causes("friction"), folds_of(made.refitter.runs, made.groups))
    found = look_for_leftover(made.refitter, look, repeats_of(made.refitter, made.groups))
    step = reduction(STEP, highest_frequency(made.refitter.runs))
    errors = {name: _means(structure[name] + noise[name], step) for name in structure}
    whole = sum(float(one @ one) for one in errors.values())
    made_alike = 2.0 * sum(float(errors[new] @ errors[old]) for new, old in pairs) / whole
    alike = sum(float(np.sum(_means(one, step) ** 2)) for one in structure.values()) / whole
    assert found.what == "comes again in repeated runs"
    assert found.share == pytest.approx(made_alike, abs=0.05)
    assert found.share == pytest.approx(alike, abs=0.1)  # noises of two runs are alike by chance, too


def _means(signal, step):
    """The means (m,) of a signal over blocks of samples."""
    return signal[: signal.size // step * step].reshape(-1, step).mean(axis=1)
