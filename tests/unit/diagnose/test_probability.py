"""How sure a cause is: by draws over folds, and beside what stays unexplained."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.diagnose.diagnosis import Diagnosis
from dashpot.diagnose.leftover import Leftover
from dashpot.diagnose.named import is_known, standing_of
from dashpot.diagnose.odds import RIG_ODDS
from dashpot.diagnose.pursuit import Pursuit, Scored, Without

FOLDS, SAMPLES = 8, 100.0
LOOK = SimpleNamespace(folds=SimpleNamespace(groups=FOLDS))  # every fold is a group of runs
SPECIMEN = SimpleNamespace(kind="specimen", evidence_of="phase")
WEIGHTS = np.random.default_rng(0).exponential(size=(2000, FOLDS))


def squares_of(nats):
    """The mean squares (folds,) of which so many nats are told in each fold, the same or those given."""
    return np.exp(2.0 * np.broadcast_to(np.asarray(nats, dtype=float), FOLDS) / SAMPLES)


def scored(nats, *names, price=0.0, cause=SPECIMEN, size=1.0):
    """A structure with so many nats in each fold; its terms have a number of a ``size`` each."""
    each = squares_of(nats)
    terms = tuple(SimpleNamespace(name=(name, ""), cause=cause) for name in names)
    names = tuple(term.name for term in terms)
    numbers = {"delay": size}
    counted = {"count": lambda number: 1, "numbers_of": lambda number: numbers}
    model = SimpleNamespace(names=names, terms=terms, causes=terms, **counted)
    return Scored(model, each, 0.0, each, np.full(FOLDS, SAMPLES), price)


def its_share(growth, unexplained):
    """The probability of a cause against an unknown law that has left a share ``unexplained``: its part of both."""
    return growth / (growth + unexplained)


def told(growth, unexplained, groups=FOLDS):
    """The probability of a structure against one as simple, whose square is larger by ``growth``.

    Bayes' rule with the BIC: so many groups, each of which is one normal deviate of unknown variance.
    """
    odds = (1.0 + growth / unexplained) ** (groups / 2.0)
    return odds / (1.0 + odds)


def pursuit(best, without, *others, look=LOOK):
    term = SimpleNamespace(name=("a", ""))
    missing = tuple(Without((term,), one) for one in without)
    return Pursuit(best, look, None, missing, (), others, WEIGHTS, best, missing, 1, True)


def test_a_cause_that_every_fold_needs_is_certain():
    assert pursuit(scored(0.0, "a"), [scored(20.0)]).probability(("a", "")) == 1.0


def test_a_rival_that_predicts_alike_takes_half_of_the_draws():
    """Better and worse by turns: each wins where its folds weigh more."""
    rival = scored(np.array([1.0, -1.0] * (FOLDS // 2)), "b")
    found = pursuit(scored(0.0, "a"), [scored(20.0)], rival)
    assert found.probability(("a", "")) == pytest.approx(0.5, abs=0.05)
    assert found.replacements(("a", "")) == (("b", ""),)


def test_a_structure_without_evidence_is_a_rival_too():
    fault = Scored(**{**vars(scored(-2.0, "delay")), "unproven": {(("delay", ""), "delay")}})
    found = pursuit(scored(0.0, "a"), [scored(20.0)], fault)
    assert found.probability(("a", "")) == 0.0 and found.replacements(("a", "")) == (("delay", ""),)


def test_a_correction_that_the_score_does_without_hides_nothing_of_another_law():
    """Beside it a law explains little, in the structure that scores better without it all that there is."""
    best, law = scored(0.0, "law", "correction"), ("law", "")
    term = SimpleNamespace(name=law)
    missing = tuple(Without((SimpleNamespace(name=(name, "")),), scored(1.0)) for name in ("law", "correction"))
    alone = (Without((term,), scored(30.0)),)
    hidden = Pursuit(best, LOOK, None, missing, (), (), WEIGHTS, best, missing, 1, True)
    seen = replace(hidden, likeliest=scored(0.0, "law"), without_one=alone)
    explained = np.expm1(2.0 * 30.0 / SAMPLES)
    assert hidden.probability(law, 0.1) == pytest.approx(its_share(np.expm1(2.0 / SAMPLES), 0.1))
    assert seen.probability(law, 0.1) == pytest.approx(its_share(explained, 0.1))


def of_groups(groups, nats, unexplained):
    """The probability of a cause without which so many groups of runs are predicted worse by so many nats each."""
    look = SimpleNamespace(folds=SimpleNamespace(groups=groups))
    return pursuit(scored(0.0, "a"), [scored(nats)], look=look).probability(("a", ""), unexplained)


@pytest.mark.parametrize("unexplained", [0.0, 0.1, 0.5, 0.9])
@pytest.mark.parametrize("groups", [2, 8, 30])
def test_a_cause_has_its_share_of_what_it_and_an_unknown_law_explain(unexplained, groups):
    """The square of the residual grows by e = exp(2 nats / samples) - 1 without it; more runs are the same specimen."""
    expected = its_share(np.expm1(2.0 * 10.0 / SAMPLES), unexplained)
    assert of_groups(groups, 10.0, unexplained) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("evidence_of", "size", "odds"),
    [("phase", -1e-3, RIG_ODDS), ("phase", 1e-3, 1.0), ("range", -1.0, 1.0), ("order", -1.0, 1.0)],
)
def test_an_unknown_passive_law_may_have_the_phase_of_an_early_channel_and_is_likelier(evidence_of, size, odds):
    """Bayes' rule: what both explain, weighted by what is known of them beforehand; without an unknown law, nothing."""
    rig = SimpleNamespace(kind="measurement", evidence_of=evidence_of)
    found = pursuit(scored(0.0, "a", cause=rig, size=size), [scored(10.0)])
    assert found.probability(("a", ""), 0.2) == pytest.approx(its_share(odds * np.expm1(20.0 / SAMPLES), 0.2))
    assert found.probability(("a", ""), 0.0) == 1.0


@pytest.mark.parametrize(("groups", "agree"), [(1, 0.5), (2, 0.75), (3, 0.875), (4, 0.9375), (5, 0.96875)])
def test_a_few_groups_of_runs_may_agree_by_chance(groups, agree):
    """Each falls on the side of a law that is none with one half, as a coin does; three are too few for a name."""
    assert of_groups(groups, 1000.0, unexplained=0.1) == pytest.approx(agree)
    assert of_groups(groups, 1000.0, unexplained=0.0) == 1.0


BEHIND = 3.0  # nats in each fold by which a rival predicts worse
BETWEEN = np.exp(2.0 * BEHIND / SAMPLES) - 1.0


def beside_a_rival(price=0.0, unproven=frozenset()):
    """A cause that explains a lot, and another one in its place that predicts a little worse in every fold."""
    rival = replace(scored(BEHIND, "b", price=price), unproven=unproven)
    return pursuit(scored(0.0, "a"), [scored(50.0)], rival)


@pytest.mark.parametrize("unexplained", [0.05, 0.3, 0.9])
def test_a_name_is_no_surer_than_what_tells_it_from_a_rival_beside_the_unexplained(unexplained):
    """A rival that is as simple: by how much it leaves more is all that counts."""
    found, alone = beside_a_rival(), np.expm1(2.0 * 50.0 / SAMPLES)
    expected = min(told(BETWEEN, unexplained), its_share(alone, unexplained))
    assert found.probability(("a", ""), unexplained) == pytest.approx(expected)
    assert found.presence(("a", ""), unexplained) == found.probability(("a", ""), unexplained)
    assert found.replacements(("a", ""), unexplained) == (("b", ""),) * bool(told(BETWEEN, unexplained) < 0.9)


def test_where_only_noise_is_left_the_draws_alone_tell_a_name_from_its_rival():
    found = beside_a_rival()
    assert found.probability(("a", ""), 0.0) == 1.0 and found.replacements(("a", ""), 0.0) == ()


def test_a_rival_that_is_told_apart_is_none():
    found = beside_a_rival()
    assert found.replacements(("a", ""), BETWEEN) == ()
    assert found.probability(("a", ""), BETWEEN) == pytest.approx(2.0**4 / (1.0 + 2.0**4))


def test_a_law_with_more_numbers_that_explains_no_more_is_no_rival():
    alone = np.expm1(2.0 * 50.0 / SAMPLES)
    assert beside_a_rival(price=1.0).probability(("a", ""), 0.3) == pytest.approx(its_share(alone, 0.3))


def test_a_fault_of_the_measurement_without_evidence_makes_no_law_unsure():
    fault = beside_a_rival(unproven=frozenset({(("b", ""), "b")}))
    assert fault.probability(("a", ""), 0.3) == pytest.approx(
        pursuit(scored(0.0, "a"), [scored(50.0)]).probability(("a", ""), 0.3)
    )


ALONE = np.exp(2.0 * 4.0 / SAMPLES) - 1.0


def beside_errors_of_forms(forms=4.0):
    """A structure that is worse by 10 nats in each fold, by fewer where the forms of the other laws may err."""
    return Scored(**{**vars(scored(forms)), "exact": squares_of(10.0)})


def test_a_cause_without_which_no_form_comes_near_is_as_certain_as_the_groups_can_tell():
    """The errors that forms would need to stand for it cost more nats than a float holds as a power."""
    found = pursuit(scored(0.0, "a"), [replace(scored(50.0), errors=1e6)])
    assert found.probability(("a", ""), unexplained=0.5) == 1.0 - 0.5**FOLDS


def test_a_cause_without_which_no_form_comes_near_may_have_a_rival():
    rival = scored(BEHIND, "b")
    found = pursuit(scored(0.0, "a"), [replace(scored(50.0), errors=1e6)], rival)
    assert found.probability(("a", ""), unexplained=0.5) == pytest.approx(told(BETWEEN, 0.5))


def test_what_another_form_could_explain_as_well_is_not_its_own():
    """Beside structure of unknown cause counts by how much the square grows where the other forms may err."""
    found = pursuit(scored(0.0, "a"), [beside_errors_of_forms()])
    assert found.probability(("a", ""), 0.1) == pytest.approx(its_share(ALONE, 0.1))
    assert found.probability(("a", "")) == 1.0


def test_a_cause_that_errors_of_forms_explain_whole_is_none():
    found = pursuit(scored(0.0, "a"), [beside_errors_of_forms(1e-9)])
    assert found.probability(("a", ""), 0.1) == pytest.approx(0.0, abs=1e-6)


def test_a_rival_has_to_predict_better_with_the_laws_as_they_are():
    """One that is likelier only where the errors of its form are allowed for is taken in no draw."""
    rival = Scored(**{**vars(scored(-5.0, "b")), "exact": squares_of(5.0)})
    found = pursuit(scored(0.0, "a"), [scored(20.0)], rival)
    assert found.probability(("a", "")) == 1.0 and found.replacements(("a", "")) == ()


def test_something_is_there_whatever_it_is_called():
    rival = scored(np.array([1.0, -1.0] * (FOLDS // 2)), "b")
    found = pursuit(scored(0.0, "a"), [scored(20.0)], rival)
    assert found.presence(("a", "")) == 1.0 > found.probability(("a", ""))
    nothing = pursuit(scored(0.0, "a"), [scored(np.array([1.0, -1.0] * (FOLDS // 2)))])
    assert nothing.presence(("a", "")) == nothing.probability(("a", ""))


@pytest.mark.parametrize(
    ("presence", "standing"),
    [(1.0, "accepted"), (0.9, "accepted"), (0.899, "probable"), (0.501, "probable"), (0.5, "resembles")],
)
def test_nine_of_ten_that_are_accepted_are_to_be_right(presence, standing):
    assert standing_of(presence) == standing


@pytest.mark.parametrize(
    ("standings", "rivals", "far", "verdict"),
    [
        ((), (), False, "nothing_missing"),
        (("resembles",), (), False, "ambiguous"),
        (("probable",), (), False, "ambiguous"),
        (("accepted", "probable"), (), False, "explained"),
        (("accepted",), ("b",), False, "ambiguous"),
        (("probable",), (), True, "unexplained"),
        (("accepted", "probable"), (), True, "partly_explained"),
    ],
)
@pytest.mark.parametrize("why", ["_far_above_attainable", "_beyond_noise", "fails_held_out"])
def test_only_what_is_accepted_explains(why, standings, rivals, far, verdict):
    terms = [SimpleNamespace(standing=standing, rivals=rivals) for standing in standings]
    found = SimpleNamespace(
        triage=SimpleNamespace(faults=()),
        leftover=Leftover(0.0, 0.0, ""),
        apart=(),
        **{name: far and name == why for name in ("_far_above_attainable", "_beyond_noise", "fails_held_out")},
        named=[term for term in terms if term.standing == "accepted"],
        terms=terms,
    )
    assert Diagnosis.verdict.func(found) == verdict


@pytest.mark.parametrize(("line", "verdict"), [(True, "unexplained"), (False, "nothing_missing")])
def test_at_the_noise_floor_only_a_line_is_no_noise(line, verdict):
    found = SimpleNamespace(
        triage=SimpleNamespace(faults=()),
        leftover=Leftover(20.0, 0.5, "", line=line),
        apart=(),
        _at_floor=True,
        _far_above_attainable=False,
        _beyond_noise=False,
        fails_held_out=False,
        named=[],
        terms=[],
    )
    assert Diagnosis.verdict.func(found) == verdict


@pytest.mark.parametrize(
    ("trained", "left_out", "admitted", "given"),
    [
        (3.9, 3.9, 0.0, True),
        (3.9, None, 0.0, True),
        (3.9, 4.1, 0.0, False),
        (4.1, 3.9, 0.0, False),
        (4.1, 5.9, 3.0, True),
        (4.1, 6.1, 3.0, False),
    ],
)
def test_detection_limits_hold_where_runs_left_out_are_predicted_to_the_noise(
    monkeypatch, trained, left_out, admitted, given
):
    """The noise floor is 2 N; both errors have to be within twice that, or what the data sheet admits."""
    asked = []
    monkeypatch.setattr("dashpot.diagnose.diagnosis.find_limits", lambda *told: asked.append(told) or [])
    known = {"_trained": trained, "left_out": left_out, "_floor": 2.0, "_admitted": admitted, "relevance": 0.0}
    made = type("Made", (Diagnosis,), {**known, "pursuit": SimpleNamespace(look=None)})
    assert object.__new__(made).limits() == [] and bool(asked) is given


@pytest.mark.parametrize(
    ("mine", "theirs", "predicting", "floor", "fails"),
    [
        (12.0, 6.0, 2.0, 2.5, True),
        (6.5, 6.0, 2.0, 2.5, False),
        (12.0, 6.0, 11.0, 2.5, False),
        (12.0, 6.0, 2.0, 11.0, False),
        (12.0, None, 2.0, 2.5, False),
        (None, None, 2.0, None, False),
    ],
)
def test_what_a_general_model_predicts_far_better_is_not_explained(mine, theirs, predicting, floor, fails):
    found = SimpleNamespace(
        after=SimpleNamespace(held_out=mine),
        explainable=SimpleNamespace(held_out=theirs),
        _floor=floor or 0.0,
        _predicting=predicting,
    )
    assert Diagnosis.fails_held_out.fget(found) is fails


def test_channel_errors_of_another_run_add_to_what_the_model_leaves():
    assert Diagnosis._predicting.fget(SimpleNamespace(_trained=3.0, _admitted=4.0)) == 5.0


@pytest.mark.parametrize(
    ("repeats", "general", "floor"), [(2.0, 5.0, 2.0), (2.0, 0.5, 0.5), (2.0, None, 2.0), (None, 5.0, 0.0)]
)
def test_repeats_that_differ_by_more_than_a_general_model_leaves_hold_more_than_noise(repeats, general, floor):
    found = SimpleNamespace(
        setting=SimpleNamespace(floor=SimpleNamespace(value=repeats)), explainable=SimpleNamespace(left_out=general)
    )
    assert Diagnosis._floor.fget(found) == floor


@pytest.mark.parametrize(
    ("interval", "known"),
    [((2.0, 199.0), True), ((2.0, 201.0), False), ((-199.0, -2.0), True), ((-1.0, 3.0), False), ((0.0, 3.0), False)],
)
def test_a_number_is_known_by_its_sign_and_to_two_decades(interval, known):
    assert is_known(interval) is known
