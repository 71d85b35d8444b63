"""Causes and parts of causes that are let go at the end; what stands only beside another one does not fall with it."""

from __future__ import annotations

from dataclasses import replace

import pytest
from unit.diagnose.rig import Made, bench, dataset, friction, plain

from dashpot.contract.cause import Suspect, added_branch
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.look import look_at
from dashpot.diagnose.pursue import Pursuer
from dashpot.diagnose.score import Added, Scores, Structure
from dashpot.diagnose.term import Term, each_part_gone
from dashpot.diagnose.trials import Trials, terms_of

UNITS = {"stiffness": "N/m", "limit": "N"}
SOFT, STIFF = 0.4e-3, 0.05e-3  # m, yield travel


def slider(name, *travels, admits=lambda numbers: numbers["limit"] < 30.0):
    """The cause that sliders of less than 30 N are missing: one that carries more is no such slider."""

    def suspects(self, view, network):
        yield added_branch(
            "prandtl",
            name,
            travels,
            lambda limit, travel: {"stiffness": limit / travel, "limit": limit},
            UNITS,
            most=len(travels),
            admits=admits,
        )

    return type("Slider", (Made,), {"word": name, "suspects": suspects})


def test_a_cause_without_which_another_one_loses_its_name_is_worth_what_both_are():
    """Two sliders of 20 N: a single one would carry 40 N. One after the other both would go, and with them all."""
    made = bench(
        dataset(lambda motion: plain(motion) + sum(friction(motion, 20.0, travel) for travel in (SOFT, STIFF)))
    )
    folds, causes = folds_of(made.refitter.runs, made.groups), [slider("soft", SOFT), slider("stiff", STIFF)]
    trials = Trials(made.refitter, folds)
    scores = Scores(look_at(made.refitter, made.model, causes, folds))
    both = Structure(added=frozenset({Added(0, (0,)), Added(1, (0,))}))
    model = made.refitter.refit(made.model, terms_of(scores, both), scores.look.noise, scores.moves(both))
    assert {slot.path.partition(".")[0] for slot in model.fitted.slots()} >= {"soft", "stiff"}
    # a slider that takes up what the other one leaves misses 0.7 nats for each sample; both are of interest only
    look = look_at(made.refitter, model, causes, folds)
    present, without = Pursuer(trials, causes, relevance=1.0, seed=0).pruned(look)
    assert present.model.names == (("soft", ""), ("stiff", ""))
    single = [one.scored.exact_score - present.exact_score for one in without]
    assert all(0.0 < cost < float(look.samples.sum()) for cost in single)


def two_sliders():
    """A structure with both sliders of a cause, refitted to data of both."""

    def law(motion):
        return plain(motion) + sum(friction(motion, 20.0, travel) for travel in (SOFT, STIFF))

    return pruned(law, slider("sliders", SOFT, STIFF, admits=lambda numbers: True), Added(0, (0, 1)))


def pruned(law, cause, *added):
    """What is left of a structure with the ``added`` parts."""
    made = bench(dataset(law))
    folds = folds_of(made.refitter.runs, made.groups)
    scores = Scores(look_at(made.refitter, made.model, [cause], folds))
    structure = Structure(added=frozenset(added))
    model = made.refitter.refit(made.model, terms_of(scores, structure), scores.look.noise, scores.moves(structure))
    look = look_at(made.refitter, model, [cause], folds)
    return Pursuer(Trials(made.refitter, folds), [cause], relevance=0.0015, seed=0).pruned(look)[0].model


@pytest.mark.parametrize("limits, parts", [((20.0, 0.0), 1), ((0.0, 20.0), 1), ((20.0, 20.0), 2)])
def test_a_part_stays_that_the_data_need(limits, parts):
    """Begun with two sliders, where one or two act; what is left has the limit of those that act."""
    acting = [(limit, travel) for limit, travel in zip(limits, (SOFT, STIFF), strict=True) if limit]

    def law(motion):
        return plain(motion) + sum(friction(motion, limit, travel) for limit, travel in acting)

    any_limit = slider("sliders", SOFT, STIFF, admits=lambda numbers: True)
    model = pruned(law, any_limit, Added(0, (0, 1)))
    [term] = model.causes
    assert len(term.atoms) == parts
    found = [value for word, value in model.numbers_of(len(model.terms) - 1).items() if word.startswith("limit")]
    assert sorted(found) == pytest.approx(sorted(limit for limit, _ in acting), rel=0.2)


def test_a_part_stays_without_which_its_term_is_not_what_it_is_called():
    """A cause of two sliders: one of them does nothing here, but a single one is not this cause."""
    two = slider("pair", SOFT, STIFF, admits=lambda numbers: "limit_2" in numbers)
    model = pruned(lambda motion: plain(motion) + friction(motion, 20.0, SOFT), two, Added(0, (0, 1)))
    assert [len(term.atoms) for term in model.causes] == [2]


def test_a_part_stays_on_which_another_term_has_put_a_dependence():
    """The dependence names the branch: without it nothing could be written, or it would stand at another one."""
    model = two_sliders()
    assert [[len(term.atoms) for term in less.causes] for less in each_part_gone(model)] == [[1], [1]]
    [term] = model.causes
    path = next(path for path in model.owned[-1] if path.endswith(".limit"))
    suspect = Suspect("line", (0.0,), term.suspect.columns, term.suspect.extend, dependent=(path,))
    follows = Term(slider("follows", SOFT), suspect, ((1.0, 0.0),))
    assert not each_part_gone(replace(model, terms=(*model.terms, follows), owned=(*model.owned, ())))
