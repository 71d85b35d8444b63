"""The screen against plain least squares and against pure noise."""

from dataclasses import replace

import numpy as np
import pytest
from unit.assess.rig import Made

from dashpot.assess.noise import flat_noise, learn_noise
from dashpot.assess.projection import SparseRows
from dashpot.assess.screen import Candidate, Columns, rich_residual, screen
from dashpot.contract.cause import Suspect

SAMPLES = 4000
WHITE = flat_noise({"a": 1.0, "b": 1.0})


class Other(Made):
    """Another one."""

    word = "other"


def columns_of(rng, effect, joint=False, sign=1, most=1, level=False):
    """Two runs, three tangents, a bank of four columns for one cause and one for another; `effect` (4,) is hidden."""
    tangents = {run: rng.standard_normal((3, SAMPLES)) for run in "ab"}
    bank = {run: rng.standard_normal((5, SAMPLES)) + 0.5 * tangents[run][0] for run in "ab"}
    residual = {run: np.asarray(effect) @ bank[run][:4] + rng.standard_normal(SAMPLES) for run in "ab"}
    suspect = Suspect("form", (1.0, 2.0, 3.0, 4.0), None, None, joint=joint, sign=sign, most=most, level=level)
    single = Suspect("single", (0.0,), None, None, unknowns=0)
    candidates = (Candidate(Made, suspect, slice(0, 4)), Candidate(Other, single, slice(4, 5)))
    empty = {run: np.empty((0, SAMPLES)) for run in "ab"}
    rows = (SparseRows.of(tangents), SparseRows.of(empty), SparseRows.of(bank))
    return Columns(residual, *rows, np.empty(0), candidates)


def fall_of_chi_square(columns, rows):
    """By plain least squares: chi square of tangents alone less that of tangents and bank rows together."""

    def left(stacks):
        design = np.concatenate([s[:, 8:] for s in stacks], axis=1).T
        target = np.concatenate([columns.residual[run][8:] for run in "ab"])
        return np.sum((target - design @ np.linalg.lstsq(design, target, rcond=None)[0]) ** 2)

    tangents = [columns.tangents.values[run] for run in "ab"]
    both = [np.concatenate([columns.tangents.values[run], columns.bank.values[run][rows]]) for run in "ab"]
    return left(tangents) - left(both)


def test_the_gain_of_a_joint_suspect_is_that_of_least_squares():
    """Projection in the Gram matrix equals fitting everything at once."""
    columns = columns_of(np.random.default_rng(), [0.1, -0.2, 0.1, 0.3], joint=True, sign=0)
    found = next(f for f in screen(columns, WHITE).findings if f.candidate.cause is Made)
    assert found.gain == pytest.approx(fall_of_chi_square(columns, [0, 1, 2, 3]), rel=1e-6)


def test_joint_strengths_of_one_sign_are_those_of_least_squares_within_it():
    """A place whose true strength has the other sign is left out."""
    rng = np.random.default_rng()
    columns = columns_of(rng, [0.3, -0.2, 0.1, 0.3], joint=True, sign=1)
    found = next(f for f in screen(columns, WHITE).findings if f.candidate.cause is Made)
    assert found.strengths[1] == 0.0
    assert np.all(found.strengths >= 0.0)
    assert found.gain == pytest.approx(fall_of_chi_square(columns, [0, 2, 3]), rel=1e-6)


def test_single_places_are_found_with_their_strength():
    """A hidden place of the grid wins over the others and over the other cause."""
    found = screen(columns_of(np.random.default_rng(), [0.0, 0.0, 0.5, 0.0]), WHITE).best
    assert found.candidate.cause is Made
    assert found.atoms[0][1] == 3.0
    assert found.atoms[0][0] == pytest.approx(0.5, abs=0.1)


def test_several_places_are_added_as_long_as_they_pay():
    """Two hidden places are both found, and no third one."""
    found = screen(columns_of(np.random.default_rng(), [0.5, 0.0, 0.0, 0.4], most=3), WHITE).best
    assert sorted(place for _, place in found.atoms) == [1.0, 4.0]


def test_a_place_that_further_ones_make_needless_is_left_out():
    """A place near to the sum of two hidden ones comes first, but has no share once both are there."""
    rng = np.random.default_rng()
    columns = columns_of(rng, [0.0, 0.5, 0.5, 0.0], most=4)
    for run in "ab":
        rows = columns.bank.values[run]
        # less a little of the noise: beside both it could only be of the wrong sign
        rows[0] = rows[1] + rows[2] - 0.1 * (columns.residual[run] - 0.5 * (rows[1] + rows[2]))
    found = screen(columns, WHITE).best
    assert sorted(place for _, place in found.atoms) == [2.0, 3.0]
    assert len(found.chosen) == found.strengths.size == found.deviations.size == found.absorbed.shape[1] == 2


def alarms(draw, draws=30):
    """How many of so many draws name something. By chance it is 1 in 100: P(more than 4 of 30) = 2e-5."""
    return sum(screen(draw(), WHITE).best is not None for _ in range(draws))


def test_a_strength_of_the_wrong_sign_is_not_admitted():
    """A negative Maxwell is not a Maxwell: one-sided suspects stay silent."""
    hidden = [0.0, -0.5, 0.0, 0.0]
    assert alarms(lambda: columns_of(np.random.default_rng(), hidden)) <= 4
    assert alarms(lambda: columns_of(np.random.default_rng(), hidden, sign=0)) == 30


@pytest.mark.parametrize(("hidden", "seen"), [((0.3, 0.3, 0.3, 0.3), False), ((0.3, 0.5, 0.1, 0.3), True)])
def test_equal_strengths_are_no_sign_of_a_cause_that_says_that_they_differ(hidden, seen):
    columns = columns_of(np.random.default_rng(), hidden, joint=True, level=True)
    assert any(found.candidate.cause is Made for found in screen(columns, WHITE).findings) is seen
    assert alarms(lambda: columns_of(np.random.default_rng(), hidden, joint=True), draws=3) == 3


def test_pure_noise_stays_below_the_threshold():
    """Of 60 draws of noise none or one is significant: P(more than 5 | 1 %) = 4e-5."""
    assert alarms(lambda: columns_of(np.random.default_rng(), np.zeros(4), most=3), draws=60) <= 5


def test_what_the_tangents_can_absorb_is_not_claimed():
    """A hidden column that is a tangent of the model belongs to a refit, not to a cause."""

    def absorbable():
        columns = columns_of(np.random.default_rng(), np.zeros(4))
        for run in "ab":
            columns.residual[run][:] += 5.0 * columns.tangents.values[run][1]
        return columns

    assert alarms(absorbable) <= 4


def test_all_suspects_together_explain_what_least_squares_does_less_one_for_each_number():
    columns = columns_of(np.random.default_rng(), (0.1, 0.0, 0.05, 0.0))
    found = screen(columns, WHITE).together
    assert found == pytest.approx(fall_of_chi_square(columns, slice(0, 5)) - 5.0, rel=1e-6)


def test_suspects_that_the_tangents_absorb_explain_nothing_together():
    columns = columns_of(np.random.default_rng(), (0.1, 0.0, 0.0, 0.0))
    tangents = {run: columns.bank.values[run].copy() for run in "ab"}
    found = screen(replace(columns, tangents=SparseRows.of(tangents)), WHITE)
    assert found.findings == ()
    assert found.together == 0.0


def test_shuffled_runs_give_nothing():
    """The residual of one run with the columns of the other names no cause."""

    def swapped():
        columns = columns_of(np.random.default_rng(), [0.0, 0.5, 0.0, 0.0])
        return replace(columns, residual={"a": columns.residual["b"], "b": columns.residual["a"]})

    assert alarms(swapped) <= 4


def test_admitted_sensor_errors_cost_nothing_and_larger_ones_are_found():
    """A nuisance column takes the blame within its prior; a cause alike is named far beyond it."""

    def with_error(size):
        columns = columns_of(np.random.default_rng(), np.zeros(4))
        shape = {run: columns.bank.values[run][4:5] for run in "ab"}
        residual = {run: columns.residual[run] + size * shape[run][0] for run in "ab"}
        nuisance = SparseRows.of(shape)
        return Columns(residual, columns.tangents, nuisance, columns.bank, np.array([0.2]), columns.candidates)

    assert alarms(lambda: with_error(0.2)) <= 4
    assert screen(with_error(3.0), WHITE).best.candidate.cause is Other


def test_under_white_noise_few_samples_tell_the_columns_apart_as_well():
    """The strengths taken out err by their deviation from every 50th sample; were none taken out, it would be more."""
    columns = columns_of(np.random.default_rng(), [0.3, 0.3, 0.3, 0.3])
    thin = columns.thinned()
    samples = sum(values.size for values in thin.residual.values())
    assert samples < SAMPLES / 20
    left = rich_residual(columns, WHITE)
    noise = {run: columns.residual[run] - 0.3 * columns.bank.values[run][:4].sum(axis=0) for run in "ab"}
    for run in "ab":
        assert np.std(columns.residual[run] - noise[run]) > 3.0 * np.sqrt(8.0 / samples)
        assert np.std(left[run] - noise[run]) < 3.0 * np.sqrt(8.0 / samples)


def test_under_coloured_noise_every_sample_counts():
    columns = columns_of(np.random.default_rng(), [0.3, 0.3, 0.3, 0.3])
    noise = {run: columns.residual[run] - 0.3 * columns.bank.values[run][:4].sum(axis=0) for run in "ab"}
    learned = learn_noise({run: np.convolve(values, [1.0, 0.5]) for run, values in noise.items()}, {"a": 0.0, "b": 0.0})
    left = rich_residual(columns, learned)
    for row in range(5):
        products = [learned.whiten(run, left[run]) @ learned.whiten(run, columns.bank.values[run][row]) for run in "ab"]
        assert abs(sum(products)) < 1e-2


def test_a_known_gram_matrix_takes_the_place_of_the_same_one_computed_anew():
    """Other tangents and another residual against the bank of an earlier screen."""
    rng = np.random.default_rng()
    columns, other = columns_of(rng, [0.3, 0.0, 0.0, 0.2]), columns_of(rng, np.zeros(4))
    changed = replace(columns, residual=other.residual, tangents=other.tangents)
    known, anew = screen(changed, WHITE, known=screen(columns, WHITE).gram), screen(changed, WHITE)
    assert known.together == pytest.approx(anew.together)
    assert [found.merit for found in known.findings] == pytest.approx([found.merit for found in anew.findings])


def test_the_moves_of_a_finding_are_those_of_a_refit_with_its_strengths():
    """The tangents make room for what joins them, as plain least squares of the rest would."""
    columns = columns_of(np.random.default_rng(), [0.4, 0.0, 0.0, 0.3], joint=True, sign=0)
    found = next(f for f in screen(columns, WHITE).findings if f.candidate.cause is Made)
    added = np.concatenate([found.strengths @ columns.bank.values[run][:4, 8:] for run in "ab"])
    design = np.concatenate([columns.tangents.values[run][:, 8:] for run in "ab"], axis=1).T
    expected = -np.linalg.lstsq(design, added, rcond=None)[0]
    assert found.moves == pytest.approx(expected, rel=1e-3, abs=1e-3)
    assert found.scaled(0.3).moves == pytest.approx(0.3 * found.moves)


def test_tangents_that_cannot_be_told_apart_do_not_run_away():
    columns = columns_of(np.random.default_rng(), [0.4, 0.0, 0.0, 0.3], joint=True, sign=0)
    for rows in columns.tangents.values.values():
        rows[1] = rows[0] * (1.0 + 1e-9)
    found = next(f for f in screen(columns, WHITE).findings if f.candidate.cause is Made)
    assert np.max(np.abs(found.moves)) < 1.0
