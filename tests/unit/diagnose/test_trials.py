"""Structures refitted: a term that changes another one is found again where that has become another law."""

from dataclasses import replace

import numpy as np
import pytest
from unit.diagnose.rig import MOTIONS, NETWORK, Made, bench, causes, dataset, friction, plain, with_force

from dashpot.contract.cause import Suspect
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.look import look_at
from dashpot.diagnose.score import Added, Scores, Structure
from dashpot.diagnose.search import additions, search
from dashpot.diagnose.trials import Trials, terms_of
from dashpot.model.patch import add_branch
from dashpot_causes.setting_dependence import numbers_of

LIMITS = dict(zip(MOTIONS, (20.0, 60.0, 40.0, 60.0, 20.0, 40.0), strict=True))
TEMPERATURE = dict(zip(MOTIONS, (1.0, 0.2, 0.7, 0.5, 0.1, 0.9), strict=True))


def measured():
    """Dry friction with a limit that follows the current: 20 N and 20 N for each A; the temperature does nothing."""
    data, rng = dataset(), np.random.default_rng(1)
    forces = {
        name: plain(motion) + friction(motion, limit=LIMITS[name], travel=0.1e-3) + rng.normal(0.0, 2.0, 1000)
        for name, motion in MOTIONS.items()
    }
    told = with_force(data, forces).runs
    runs = [
        replace(
            run,
            settings={**run.settings, "current": LIMITS[run.name] / 20.0 - 1.0, "warmth": TEMPERATURE[run.name]},
        )
        for run in told
    ]
    return replace(data, runs=tuple(runs))


@pytest.fixture(scope="module")
def found():
    """The trials on these runs, and scores beside friction and the dependence of its limit."""
    made = bench(measured())
    folds = folds_of(made.refitter.runs, made.groups)
    trials, model = Trials(made.refitter, folds), made.model
    for word in ("friction", "setting_dependence"):
        scores = Scores(look_at(made.refitter, model, causes(word), folds))
        best = min((Structure(added=frozenset({one})) for one in additions(scores, Structure())), key=scores.score)
        model = made.refitter.refit(model, terms_of(scores, best), scores.look.noise, scores.moves(best))
    return trials, Scores(look_at(made.refitter, model, causes("friction", "setting_dependence"), folds))


def best_of(scores, gone, form, places=None):
    """The structure without a term and with the best place of a form."""
    number = next(k for k, one in enumerate(scores.look.candidates) if one.suspect.form == form)
    every = range(len(scores.look.candidates[number].suspect.grid)) if places is None else places
    return min((Structure(frozenset({gone}), frozenset({Added(number, (k,))})) for k in every), key=scores.score)


def _dependent(scores, structure):
    """The numbers that follow something by what joins."""
    each = ((scores.look.candidates[k].suspect.each_dependent, places) for k, places in structure.added)
    return {numbers[place] for numbers, places in each for place in places}


def test_the_dependence_of_a_law_is_found_again_in_the_law_that_takes_its_place(found):
    trials, scores = found
    former = scores.look.model
    assert [term.cause.word for term in former.terms] == ["friction", "setting_dependence"]
    form = next(form for form in ("dahl", "prandtl") if form != former.terms[0].suspect.form)
    (trial,) = trials.refitted(scores, [best_of(scores, 0, form)])
    assert [term.cause.word for term in trial.model.terms] == ["friction", "setting_dependence"]
    assert trial.model.terms[0].suspect.form == form and not trials.refused
    limits = [
        slot.value.over.numbers[0].number
        for slot in trial.model.fitted.slots()
        if slot.value.over and slot.path.endswith(".limit")
    ]
    assert limits == pytest.approx([20.0], rel=0.1)


def test_a_dependence_may_take_the_place_of_one_of_the_same_number(found):
    """Nothing follows the warmth: with it in place of the current the runs are predicted worse."""
    trials, scores = found
    numbers = [number.key for number in numbers_of(scores.look.model.fitted)]
    (trial,) = trials.refitted(scores, [best_of(scores, 1, "a number over warmth", [numbers.index("limit")])])
    assert [term.suspect.form for term in trial.model.terms][1] == "a number over warmth"
    assert trial.score > scores.score(Structure()) + 10.0


def test_a_dependence_of_a_law_that_goes_is_refused_without_a_word(found):
    """Nobody asked for it: the search tries what may join in the place of what."""
    trials, scores = found
    numbers = [number.key for number in numbers_of(scores.look.model.fitted)]
    structure = best_of(scores, 0, "a number over warmth", [numbers.index("limit")])
    assert trials.refitted(scores, [Structure(frozenset({0, 1}), structure.added)]) == [None]
    assert not trials.refused


def test_what_lacks_a_law_that_goes_is_not_tried(found):
    trials, scores = found
    numbers = [number.key for number in numbers_of(scores.look.model.fitted)]
    structure = best_of(scores, 1, "a number over warmth", [numbers.index("limit")])
    assert trials.can_be_tried(scores, structure)
    assert not trials.can_be_tried(scores, Structure(frozenset({0, 1}), structure.added))


def test_a_number_that_follows_the_current_follows_no_warmth_beside_it(found):
    """That cannot be written: it is neither proposed nor tried, and nobody hears of it."""
    trials, scores = found
    beside = [one for one in search(scores) if 1 not in one.dropped]
    assert beside and not any("friction.limit" in _dependent(scores, one) for one in beside)
    numbers = next(k for k, one in enumerate(scores.look.candidates) if one.suspect.form == "a number over warmth")
    limit = scores.look.candidates[numbers].suspect.dependent.index("friction.limit")
    assert trials.refitted(scores, [Structure(added=frozenset({Added(numbers, (limit,))}))]) == [None]
    assert not trials.can_be_tried(scores, Structure(added=frozenset({Added(numbers, (limit,))})))
    assert not trials.refused


def test_what_follows_something_in_the_diagnosed_network_stays_so():
    text = NETWORK.replace(
        "{start: 200 N*s/m}", "{start: 200 N*s/m, over: {setting: warmth, at: 0, slope: {start: 0}}}"
    )
    made = bench(measured(), text)
    look = look_at(made.refitter, made.model, causes("setting_dependence"), folds_of(made.refitter.runs, made.groups))
    scores = Scores(look)
    every = set().union(*(_dependent(scores, one) for one in search(scores)))
    assert "damping.damping" not in every and "stiffness.stiffness" in every


class Unwritable(Made):
    """A cause whose text no network can have."""

    word = "unwritable"

    def suspects(self, view, network):
        """A force in phase with the deflection, of an element that there is not."""
        yield Suspect(
            "form",
            (1.0,),
            lambda view, run: view.displacement(run)[None],
            lambda text, atoms: add_branch(text, "more: {element: nothing}"),
            sign=0,
        )


def test_what_a_cause_itself_cannot_write_is_told_with_the_reason():
    made = bench(measured())
    folds = folds_of(made.refitter.runs, made.groups)
    trials = Trials(made.refitter, folds)
    scores = Scores(look_at(made.refitter, made.model, [Unwritable], folds))
    structure = Structure(added=frozenset({Added(0, (0,))}))
    assert trials.can_be_tried(scores, structure)
    assert trials.refitted(scores, [structure]) == [None]
    (said,) = trials.refused
    assert said.startswith("'unwritable' could not be written into the network: ") and "'nothing'" in said


def test_what_is_gone_from_the_start_of_a_search_does_not_come_back(found):
    """Rivals of the dependence: the friction stays in all structures, and the dependence in none."""
    _, scores = found
    ranked = search(scores, stay=frozenset({0}), gone=frozenset({1}))
    assert ranked and all(one.dropped == {1} for one in ranked)
    assert any(one.dropped != {1} for one in search(scores, stay=frozenset({0})))


def test_a_form_may_not_need_another_cause_unless_the_former_one_does(found):
    """The dependence needs the friction, whose limit it changes; the friction needs nothing."""
    trials, scores = found
    numbers = [number.key for number in numbers_of(scores.look.model.fitted)]
    needing = best_of(scores, 1, "a number over warmth", [numbers.index("limit")])
    assert trials.is_as_independent(scores, needing)
    assert not trials.is_as_independent(scores, Structure(frozenset({0}), needing.added))
