"""Branches of a network that may go."""

from unit.diagnose.rig import NETWORK, bench, causes, dataset, friction, plain

from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.pursue import Pursuer
from dashpot.diagnose.trials import Trials

RICH = (
    NETWORK
    + """\
  slow: {element: maxwell, stiffness: {start: 20 N/mm}, relaxation_time: {start: 30 ms}}
  friction: {element: dahl, stiffness: {start: 100 N/mm}, limit: {start: 20 N}}
"""
)


def gone(law):
    made = bench(dataset(law), RICH)
    trials = Trials(made.refitter, folds_of(made.refitter.runs, made.groups))
    found = Pursuer(trials, causes("bumper"), 0.0015, 0).run(made.model)
    return [one.branch for one in found.best.model.gone]


def test_branches_that_nothing_needs_may_go():
    assert gone(plain) == ["slow", "friction"]


def test_a_branch_that_the_data_need_stays():
    assert gone(lambda motion: plain(motion) + friction(motion)) == ["slow"]
