"""What is told of the smallest effect that would have been found, against effects of just that size."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.assess.limits import Limit, find_limits, left_force, of_interest
from dashpot.assess.noise import flat_noise
from dashpot.assess.projection import SparseRows
from dashpot.assess.screen import Candidate, Columns, screen
from dashpot.contract.cause import Cause, Suspect

SAMPLES = 2000
PLACES = 4
WHITE = flat_noise({"a": 1.0, "b": 1.0})


class Made(Cause):
    """A cause for tests."""

    word, kind, about, shows = "made", "specimen", "made for a test", "in no way"

    def suspects(self, view, network):
        """None of its own."""
        return ()


def columns_of(rng, strengths, **suspect):
    """Two runs with three tangents, and a bank of columns that resemble the first one; `strengths` are hidden."""
    tangents = {run: rng.standard_normal((3, SAMPLES)) for run in "ab"}
    bank = {run: rng.standard_normal((PLACES, SAMPLES)) + 0.5 * tangents[run][0] for run in "ab"}
    residual = {run: np.asarray(strengths) @ bank[run] + rng.standard_normal(SAMPLES) for run in "ab"}
    form = Suspect("form", tuple(np.arange(1.0, PLACES + 1.0)), None, None, **suspect)
    rows = [SparseRows.of(part) for part in (tangents, {run: np.empty((0, SAMPLES)) for run in "ab"}, bank)]
    return Columns(residual, *rows, np.empty(0), (Candidate(Made, form, slice(0, PLACES)),))


def limit_of(columns, least_force=0.0):
    """The only one."""
    ((_, limit),) = find_limits(columns, screen(columns, WHITE), least_force)
    return limit


@pytest.mark.parametrize("suspect", [{"sign": 1}, {"sign": 0}, {"joint": True, "sign": 0}], ids=str)
@pytest.mark.parametrize(("share", "least", "most"), [(1.0, 32, 40), (0.5, 0, 8)])
def test_effects_are_found_from_the_limit_on(suspect, share, least, most):
    """95 % power: of 40 draws fewer than 32 with P = 1e-4; at half the size hardly any is found."""
    rng = np.random.default_rng()
    strengths = share * limit_of(columns_of(rng, np.zeros(PLACES), **suspect)).strengths
    found = sum(screen(columns_of(rng, strengths, **suspect), WHITE).best is not None for _ in range(40))
    assert least <= found <= most


def test_the_force_of_a_limit_is_what_its_columns_add():
    columns = columns_of(np.random.default_rng(), np.zeros(PLACES), joint=True, sign=0)
    limit = limit_of(columns)
    added = np.concatenate([limit.strengths @ columns.bank.values[run] for run in "ab"])
    assert limit.force == pytest.approx(np.sqrt(np.mean(added**2)))
    assert left_force(limit, columns) < limit.force


def test_together_places_show_less_force_than_any_of_them():
    """Where columns act together the limit is that of the strengths that the data tell best."""
    rng = np.random.default_rng()
    columns = columns_of(rng, np.zeros(PLACES), joint=True, sign=0)
    seen = screen(columns, WHITE)
    limit = limit_of(columns)
    told = limit.strengths @ seen.projected.spread @ limit.strengths / limit.force**2
    gram = columns.bank.gram(np.arange(PLACES)) / seen.samples
    for strengths in rng.standard_normal((50, PLACES)):
        assert strengths @ seen.projected.spread @ strengths / (strengths @ gram @ strengths) <= told * (1.0 + 1e-9)


def test_what_the_numbers_of_the_model_make_up_for_has_no_limit():
    columns = columns_of(np.random.default_rng(), np.zeros(PLACES))
    hidden = {run: np.tile(columns.tangents.values[run][0], (PLACES, 1)) for run in "ab"}
    assert limit_of(replace(columns, bank=SparseRows.of(hidden))) is None


def test_a_cause_that_would_have_to_be_larger_than_it_can_be_has_no_limit():
    columns = columns_of(np.random.default_rng(), np.zeros(PLACES))
    size = limit_of(columns).size
    for largest, told in ((1.01 * size, True), (0.99 * size, False)):
        suspect = replace(columns.candidates[0].suspect, largest=largest)
        bounded = replace(columns, candidates=(replace(columns.candidates[0], suspect=suspect),))
        assert (limit_of(bounded) is not None) is told


def test_a_limit_is_raised_to_what_is_of_interest():
    """Of the effect a refit leaves what is no constant; what it seems to be scatters by its deviation."""
    ramp = {"a": np.linspace(0.0, 2.0, 1001)[None, :]}
    tangents = SparseRows.dense({"a": np.ones((1, 1001))})
    columns = Columns(ramp, tangents, SparseRows.dense({"a": np.empty((0, 1001))}), SparseRows.dense(ramp),
                      np.empty(0), ())  # fmt: skip
    limit = Limit(SimpleNamespace(columns=slice(0, 1)), np.array([4.0]), 10.0, 0.125)
    left = 1.0 / np.sqrt(3.0)
    assert of_interest(limit, columns, 1.0 * left).size == limit.size
    raised = of_interest(limit, columns, 16.0 * left)
    assert raised.size == pytest.approx(16.0 + 1.645 * 0.5, rel=2e-3)
    assert raised.force == pytest.approx(2.5 * raised.size)
    assert raised.scatter * raised.size == pytest.approx(0.5)
