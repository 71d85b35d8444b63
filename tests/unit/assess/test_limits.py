"""What is told of the smallest effect that would have been found, against effects of just that size."""

from dataclasses import replace

import numpy as np
import pytest
from unit.assess.rig import Made

from dashpot.assess.limits import Limit, find_limits
from dashpot.assess.noise import flat_noise
from dashpot.assess.projection import SparseRows
from dashpot.assess.screen import Candidate, Columns, screen
from dashpot.contract.cause import Suspect

SAMPLES = 2000
PLACES = 4
WHITE = flat_noise({"a": 1.0, "b": 1.0})


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
@pytest.mark.parametrize(("share", "least", "most"), [(1.0, 32, 40), (0.4, 0, 8)])
def test_effects_are_found_from_the_limit_on(suspect, share, least, most):
    """95 % power: of 40 draws fewer than 32 with P = 1e-4; at 0.4 of the size 1 to 2 of 40 are found."""
    rng = np.random.default_rng()
    strengths = share * limit_of(columns_of(rng, np.zeros(PLACES), **suspect)).strengths
    found = sum(screen(columns_of(rng, strengths, **suspect), WHITE).best is not None for _ in range(40))
    assert least <= found <= most


def test_the_force_of_a_limit_and_what_a_refit_leaves_of_it():
    """By plain least squares; the runs weigh alike, however long they are."""
    columns = columns_of(np.random.default_rng(), np.zeros(PLACES), joint=True, sign=0)
    short = {"a": slice(None), "b": slice(0, SAMPLES // 4)}
    tangents, bank = (
        SparseRows.dense({run: part.values[run][:, cut] for run, cut in short.items()})
        for part in (columns.tangents, columns.bank)
    )
    residual = {run: columns.residual[run][cut] for run, cut in short.items()}
    empty = SparseRows.dense({run: np.empty((0, values.size)) for run, values in residual.items()})
    limit = limit_of(replace(columns, residual=residual, tangents=tangents, nuisance=empty, bank=bank))
    added, design = (
        np.concatenate([rows.values[run].T / np.sqrt(2 * residual[run].size) for run in short])
        for rows in (bank, tangents)
    )
    force = added @ limit.strengths
    assert limit.force == pytest.approx(np.linalg.norm(force))
    assert limit.left**2 == pytest.approx(np.linalg.lstsq(design, force, rcond=None)[1][0])


def test_few_shapes_of_columns_that_act_together_are_harder_to_see():
    """In a loud run the same force tells less: the limit has to be enough for effects that are mostly there."""
    rng = np.random.default_rng()
    columns = columns_of(rng, np.zeros(PLACES), joint=True, sign=0)
    for run, places in (("a", slice(0, 2)), ("b", slice(2, 4))):
        columns.bank.values[run][places] = 0.0
    seen = screen(columns, flat_noise({"a": 1.0, "b": 5.0}))
    ((_, limit),) = find_limits(columns, seen, 0.0)
    told = limit.strengths @ seen.projected.spread @ limit.strengths / limit.force**2
    shapes = rng.standard_normal((500, PLACES))
    forces = np.mean([np.mean((shapes @ columns.bank.values[run]) ** 2, axis=1) for run in "ab"], axis=0)
    share = np.mean(np.einsum("ij,jk,ik->i", shapes, seen.projected.spread, shapes) / forces < told)
    assert share < 0.12


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
    """What it seems to be scatters by its deviation."""
    limit = Limit(None, np.array([4.0]), 10.0, 5.0, 5.0, 0.125)
    assert limit.of_interest(1.0).size == limit.size
    raised = limit.of_interest(20.0)
    assert raised.size == pytest.approx(16.0 + 1.645 * 0.5, rel=1e-3)
    assert raised.force == pytest.approx(2.5 * raised.size)
    assert raised.left == pytest.approx(0.5 * raised.force)
    assert raised.scatter * raised.size == pytest.approx(0.5)
