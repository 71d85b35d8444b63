"""Causes that are let go at the end: what stands only beside another one does not fall with it."""

from __future__ import annotations

from unit.diagnose.rig import Made, bench, dataset, friction, plain

from dashpot.contract.cause import added_branch
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.look import look_at
from dashpot.diagnose.pursue import Pursuer
from dashpot.diagnose.score import Added, Scores, Structure
from dashpot.diagnose.trials import Trials, terms_of

UNITS = {"stiffness": "N/m", "limit": "N"}
SOFT, STIFF = 0.4e-3, 0.05e-3  # m, yield travel


def slider(name, travel):
    """The cause that a slider of less than 30 N is missing: one that carries more is no such slider."""

    def suspects(self, view, network):
        yield added_branch(
            "prandtl",
            name,
            (travel,),
            lambda limit, travel: {"stiffness": limit / travel, "limit": limit},
            UNITS,
            admits=lambda numbers: numbers["limit"] < 30.0,
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
