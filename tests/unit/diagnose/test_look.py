"""A look against plain least squares: Gram matrices of all columns beside which the base is refitted."""

from dataclasses import replace

import numpy as np
import pytest
from unit.diagnose.rig import MOTIONS, NOISE, REGISTRY, Made, bench, causes, dataset, friction, plain

from dashpot.contract.cause import Suspect
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.front import Front, beside, in_front, occam
from dashpot.diagnose.location import gather_candidates, locations_of
from dashpot.diagnose.look import look_at, look_settled
from dashpot.diagnose.refit import Kept
from dashpot.diagnose.score import Scores, nats
from dashpot.diagnose.table_rows import moved
from dashpot.diagnose.view import view_of
from dashpot.diagnose.whitening import Noise
from dashpot.fit.coordinates import search_coordinates


class Closed(Made):
    """Columns that need no element: the square of the velocity, and its sign times two deflections."""

    def suspects(self, view, network):
        """Two forms with one and two places."""
        yield Suspect("square", (1.0,), lambda view, run: view.velocity(run)[None] ** 2, None)
        yield Suspect("side", (1e-3, 2e-3), side, None)


def side(view, run):
    return np.sign(view.velocity(run)) * np.maximum(view.displacement(run) - np.array([[1e-3], [2e-3]]), 0.0)


@pytest.fixture(scope="module")
def made():
    return bench(dataset(lambda motion: plain(motion) + friction(motion), held_out=("a3_p8",)))


@pytest.fixture(scope="module")
def look(made):
    return look_at(made.refitter, made.model, [Closed], folds_of(made.refitter.runs, made.groups))


def weighed(look, run, signal):
    """Averages over blocks in units of the residual of the records, value by value."""
    step = look.noise.steps[run.name]
    kept = signal.size // step
    return look.noise.filters[run.name][0] * signal[: kept * step].reshape(kept, step).sum(axis=1) / np.sqrt(step)


@pytest.fixture(scope="module")
def columns(made, look):
    """Base tangents (2, n) and residual with the candidates' columns (4, n) by run, from the motions alone.

    Both weigh as many values as are independent.
    """
    numbers = {slot.path: slot.value.number for slot in made.model.fitted.slots()}
    found = {}
    for run in made.refitter.runs:
        x, v = run.drive.displacement[run.first :], run.drive.velocity[run.first :]
        residual = run.force[run.first :] - numbers["stiffness.stiffness"] * x - numbers["damping.damping"] * v
        bank = [v**2, *(np.sign(v) * np.maximum(x - at, 0.0) for at in (1e-3, 2e-3))]
        weight = np.sqrt(look.noise.independent[run.name])
        found[run.name] = (
            weight * np.array([weighed(look, run, each) for each in (x, v)]),
            weight * np.array([weighed(look, run, each) for each in (residual, *bank)]),
        )
    return found


def test_gram_matrices_are_those_of_the_residual_and_of_what_a_refit_of_the_base_leaves_of_columns(look, columns):
    """A step that would make the residual smaller is the fit's to make."""
    base = np.concatenate([tangents for tangents, _ in columns.values()], axis=1)
    all_columns = np.concatenate([rows for _, rows in columns.values()], axis=1)
    strengths = np.linalg.lstsq(base.T, all_columns.T, rcond=None)[0]
    strengths[:, 0] = 0.0
    scale = np.sqrt(look.front.squares)
    left = {run: rows - strengths.T @ tangents for run, (tangents, rows) in columns.items()}
    seen = set()
    for run, rows in left.items():
        for number, part in look.folds.of_run(run, rows.shape[1]):
            expected = rows[:, part] @ rows[:, part].T / np.outer(scale, scale)
            assert look.front.beside().groups(np.diag(1.0 / scale))[number] == pytest.approx(expected, abs=2e-6)
            assert look.samples[number] == pytest.approx(look.noise.independent[run] * (part.stop - part.start))
            seen.add(number)
    assert seen == set(range(len(look.folds.names)))


def test_a_model_is_refitted_under_the_noise_that_it_leaves(made):
    """At the optimum the residual is orthogonal to the tangents of the base, each run by its independent samples."""
    settled = look_settled(made.refitter, made.model, [Closed], folds_of(made.refitter.runs, made.groups))
    residual, tangents = made.refitter.linearise(settled.model, settled.noise)
    weights = {run: np.sqrt(settled.noise.independent[run]) for run in residual}
    slopes = sum(weights[run] ** 2 * tangents[run] @ residual[run] for run in residual)
    sizes = sum(weights[run] ** 2 * np.sum(tangents[run] ** 2, axis=1) for run in residual)
    whole = sum(weights[run] ** 2 * residual[run] @ residual[run] for run in residual)
    assert np.abs(slopes / np.sqrt(sizes * whole)).max() < 0.02


def test_a_step_that_the_fit_has_not_made_does_not_count(made):
    """Beside its optimum a model predicts worse, though its tangents would take it back there."""
    folds = folds_of(made.refitter.runs, made.groups)
    settled = look_settled(made.refitter, made.model, [], folds)
    moved = settled.model.moved(np.array([0.1, -0.2]))
    beside = replace(settled.model, fitted=moved, point=search_coordinates(moved).start)
    other = look_at(made.refitter, beside, [], folds, settled.noise)
    assert nats(Scores(other).exact(), other.samples) > nats(Scores(settled).exact(), settled.samples) + 1.0


def test_all_records_have_one_noise(made, look):
    """An independent sample of a run that is followed to the noise weighs no more than one of any other run."""
    assert len({tuple(found) for found in look.noise.filters.values()}) == 1
    residual, _ = made.refitter.linearise(made.model, look.noise)
    squares = [np.mean(rest**2) for rest in residual.values()]
    samples = [look.noise.independent[run] * rest.size for run, rest in residual.items()]
    assert max(squares) > 1.5 * min(squares)
    assert np.average(squares, weights=samples) == pytest.approx(1.0, rel=0.02)


def test_held_out_runs_take_no_part(made, look):
    assert "a3_p8" in MOTIONS and "a3_p8" not in look.folds.parts
    assert "a3_p8" not in look.noise.steps


def test_the_columns_of_candidates_stand_one_behind_the_other(look):
    known = [(one.suspect.form, one.columns) for one in look.candidates]
    assert known == [("square", slice(0, 1)), ("side", slice(1, 3))]
    assert (look.layout.tangents, look.layout.terms, look.layout.bank, look.layout.size) == (0, 0, 3, 4)


def test_sizes_are_those_of_the_columns_in_newton(look, made):
    """Averages over blocks keep the sum of squares of a slow signal: its size times the root of the block."""
    runs = made.refitter.runs
    step = look.noise.steps[runs[0].name]
    squares = [np.mean(run.drive.velocity[run.first :] ** 4) for run in runs]
    assert look.sizes[1] == pytest.approx(np.sqrt(step * np.mean(squares)), rel=0.02)


def test_columns_do_not_make_the_noise_of_the_records_smaller():
    """Half a thousand of them take up a part of 1250 values of noise."""
    null = bench(dataset(held_out=("a3_p8",)))
    look = look_at(null.refitter, null.model, causes(*REGISTRY.causes), folds_of(null.refitter.runs, null.groups))
    assert look.layout.bank > 300
    assert look.rich == pytest.approx(NOISE, rel=0.06)


def test_a_cause_that_cannot_be_tried_is_told(made):
    class Missing(Made):
        word = "missing"

        def suspects(self, view, network):
            yield Suspect("none", (1.0,), lambda view, run: view.respond(run, "no_such_element", [{}]), None)

    look = look_at(made.refitter, made.model, [Missing, Closed], folds_of(made.refitter.runs, made.groups))
    ((word, reason),) = look.unavailable
    assert word == "missing" and "no_such_element" in reason
    assert len(look.candidates) == 2


@pytest.fixture
def block():
    """Six groups of columns: two that are free, three with a precision, four behind them."""
    rng = np.random.default_rng(0)
    return [rng.standard_normal((9, 40)) for _ in range(6)], np.array([0.0, 0.0, 3.0, 7.0, 1.0])


def test_projection_is_the_schur_complement(block):
    rows, _ = block
    grams = np.array([each @ each.T for each in rows])
    total = grams.sum(axis=0)
    moves = in_front(total, np.zeros(5))
    expected = total[5:, 5:] - total[5:, :5] @ np.linalg.solve(total[:5, :5], total[:5, 5:])
    assert beside(total, moves) == pytest.approx(expected)
    assert sum(beside(gram, moves) for gram in grams) == pytest.approx(expected)
    whole = np.concatenate(rows, axis=1)
    assert moves == pytest.approx(np.linalg.lstsq(whole[:5].T, whole[5:].T, rcond=None)[0])


def test_errors_of_forms_are_marginalised(block):
    """Squares left and prior together are those under the covariance of the forms; the rest is its determinant."""
    rows, precision = block
    whole = np.concatenate(rows, axis=1)
    free, forms, target = whole[:2], whole[2:5], whole[5:]
    total = whole @ whole.T
    moves = in_front(total, precision)
    prior = moves.T @ (precision[:, None] * moves)
    outside = np.eye(whole.shape[1]) - free.T @ np.linalg.solve(free @ free.T, free)
    target, forms = target @ outside, forms @ outside
    covariance = np.eye(whole.shape[1]) + forms.T @ (forms / precision[2:, None])
    assert beside(total, moves) + prior == pytest.approx(target @ np.linalg.solve(covariance, target.T))
    assert occam(forms @ forms.T, precision[2:]) == pytest.approx(0.5 * np.linalg.slogdet(covariance)[1])
    assert occam(forms[:0] @ forms[:0].T, precision[:0]) == 0.0


@pytest.mark.parametrize(("gone", "kept"), [((), [0, 1, 2]), ((0,), [1]), ((1,), [0, 2]), ((0, 1), [])])
def test_errors_of_a_form_go_with_its_term(block, gone, kept):
    rows, precision = block
    whole = np.concatenate(rows, axis=1)
    forms, target, known = whole[2:5][kept], whole[5:], precision[2:][kept]
    grams = np.array([each[2:] @ each[2:].T for each in rows])
    front = Front(grams, grams.sum(axis=0), np.zeros((0, 7)), precision[2:], np.array([0, 1, 0]), 0)
    found = front.beside(frozenset(gone))
    covariance = np.eye(whole.shape[1]) + forms.T @ (forms / known[:, None])
    mixed = np.arange(8.0).reshape(4, 2) % 3.0 - 1.0
    strengths = np.linalg.solve(forms @ forms.T + np.diag(known), forms @ target.T)
    left = target - strengths.T @ forms
    assert front.beside(frozenset(gone)).groups(np.eye(4)).sum(axis=0) == pytest.approx(left @ left.T)
    assert front.beside(frozenset(gone)).groups(mixed).sum(axis=0) == pytest.approx(mixed.T @ left @ left.T @ mixed)
    every = np.arange(4)
    gram = found.gram.block(every, every) * np.outer(front.scale, front.scale)
    assert gram == pytest.approx(target @ np.linalg.solve(covariance, target.T))
    some = np.array([1.0, -2.0, 0.0, 3.0])
    assert found.unlikely(some) == pytest.approx(0.5 * known @ (strengths @ some) ** 2 + found.occam)
    assert found.occam == pytest.approx(0.5 * np.linalg.slogdet(covariance)[1])


def test_a_look_at_a_few_samples_at_a_time_sees_the_same(made, look, monkeypatch):
    """Large data: the same matrices and the same noise, however many samples are in memory."""
    monkeypatch.setattr("dashpot.diagnose.look.BLOCK", 100)
    again = look_at(made.refitter, made.model, [Closed], folds_of(made.refitter.runs, made.groups))
    assert again.front.total == pytest.approx(look.front.total, rel=1e-9, abs=1e-9 * look.front.total.max())
    assert again.sizes == pytest.approx(look.sizes)
    assert again.rich == pytest.approx(look.rich)
    for run, coefficients in look.measured_noise.filters.items():
        assert again.measured_noise.filters[run] == pytest.approx(coefficients, rel=1e-6)


def test_columns_that_are_kept_in_memory_are_those_that_are_computed(made):
    """Forms of one cause may differ in what their name and grid do not tell, as in a relaxation time."""
    runs = made.refitter.runs[:1]
    once = replace(made.refitter, runs=runs, reduced=Kept())
    view = view_of(made.model.fitted, moved(runs), once.elements)
    found, _ = gather_candidates(list(REGISTRY.causes.values()), locations_of(view, made.model.fitted, None))
    noise = Noise({runs[0].name: 1})
    for candidate in found:
        once.columns(candidate, view, runs[0], noise)
    again = [once.columns(candidate, view, runs[0], noise) for candidate in found]
    for candidate, kept in zip(found, again, strict=True):
        anew = np.atleast_2d(candidate.suspect.columns(view, runs[0].name))[:, runs[0].first :]
        assert kept == pytest.approx(anew, rel=1e-5, abs=1e-5 * np.abs(anew).max()), candidate.suspect.form
    assert sum(candidate.twin > 0 for candidate in found) > 2


def test_forms_that_could_be_tried_are_not_examined_again(made):
    """Their columns are simulated once to see that they can be; one that cannot is told at every look."""
    view, asked = view_of(made.model.fitted, moved(made.refitter.runs), made.refitter.elements), []

    class Counted(Closed):
        def suspects(self, view, network):
            yield Suspect("counted", (1.0,), lambda view, run: asked.append(run) or view.velocity(run)[None], None)

    class Lacking(Closed):
        word = "lacking"

        def suspects(self, view, network):
            yield Suspect("lacking", (1.0,), lambda view, run: view.respond(run, "no_such_element", [{}]), None)

    able = set()
    for _ in range(2):
        found, unavailable = gather_candidates(
            [Counted, Lacking], locations_of(view, made.model.fitted, None), (), able
        )
        assert [one.suspect.form for one in found] == ["counted"]
        assert [word for word, _ in unavailable] == ["lacking"]
    assert asked == [view.runs[0]]
