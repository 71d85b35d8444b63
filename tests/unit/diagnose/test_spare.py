"""Branches of a network that may go."""

import pytest
from unit.diagnose.rig import NETWORK, REGISTRY, bench, causes, dataset, friction, plain, relaxation

from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.pursue import Pursuer
from dashpot.diagnose.term import given_branches
from dashpot.diagnose.trials import Trials
from dashpot.model.reading import parse_network

RICH = (
    NETWORK
    + """\
  slow: {element: maxwell, stiffness: {start: 20 N/mm}, relaxation_time: {start: 30 ms}}
  friction: {element: dahl, stiffness: {start: 100 N/mm}, limit: {start: 20 N}}
"""
)


def pursuit(law, text, *words):
    made = bench(dataset(law), text)
    trials = Trials(made.refitter, folds_of(made.refitter.runs, made.groups))
    return Pursuer(trials, causes(*words), 0.0015, 0).run(made.model)


def gone(law):
    return [one.branch for one in pursuit(law, RICH, "creep").best.model.gone]


def test_branches_that_nothing_needs_may_go():
    assert gone(plain) == ["slow", "friction"]


def test_a_branch_that_the_data_need_stays():
    assert gone(lambda motion: plain(motion) + friction(motion)) == ["slow"]


def test_a_branch_gives_way_to_a_cause_and_is_back_where_that_is_taken_out():
    """What the network has of itself is no gain of the cause."""
    slider = NETWORK + "  friction: {element: dahl, stiffness: {start: 100 N/mm}, limit: {start: 20 N}}\n"
    found = pursuit(lambda motion: plain(motion) + relaxation(motion), slider, "relaxation")
    assert found.best.model.names == (("relaxation", ""),)
    assert [one.branch for one in found.best.model.gone] == ["friction"]
    [without] = found.without
    assert not without.scored.model.gone and not without.scored.model.causes
    assert without.scored.model.fitted.root.members[-1].name == "friction"


BOUND = [
    ("friction: {element: dahl, stiffness: 1e5, limit: 20}", ()),  # nothing of it is free
    ("friction: {element: dahl, stiffness: {start: 1e5}, limit: 20}", ("friction",)),
    ("two: {parallel: {friction: {element: dahl, stiffness: {start: 1e5}, limit: 20}}}", ()),
    (
        "one: {element: dahl, stiffness: {start: 1e5}, limit: 20}\n"
        "  other: {element: dahl, stiffness: {expression: 2 * one.stiffness}, limit: {start: 30}}",
        ("other",),
    ),
    ("one: {element: dahl, stiffness: {start: 1e5}, limit: 20}\n  other: {same_as: one}", ()),
]


@pytest.mark.parametrize("branches, free", BOUND)
def test_what_is_fixed_grouped_or_referred_to_stays(branches, free):
    network = parse_network(f"{NETWORK}  {branches}\n", REGISTRY.elements)
    assert tuple(one.branch for one in given_branches(network)) == free


def test_of_a_network_of_sliders_alone_none_may_go():
    text = NETWORK.partition("  stiffness:")[0] + "  friction: {element: dahl, stiffness: {start: 1e5}, limit: 20}\n"
    assert given_branches(parse_network(text, REGISTRY.elements)) == ()
