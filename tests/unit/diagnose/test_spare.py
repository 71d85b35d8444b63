"""Branches of a network that may go."""

from unit.diagnose.rig import NETWORK, bench, dataset, friction, plain

from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.look import look_at
from dashpot.diagnose.spare import spare_branches

RICH = (
    NETWORK
    + """\
  slow: {element: maxwell, stiffness: {start: 20 N/mm}, relaxation_time: {start: 30 ms}}
  friction: {element: dahl, stiffness: {start: 100 N/mm}, limit: {start: 20 N}}
"""
)


def spare(law):
    made = bench(dataset(law), RICH)
    look = look_at(made.refitter, made.model, (), folds_of(made.refitter.runs, made.groups))
    return spare_branches(made.refitter, look, made.model)


def test_branches_that_nothing_needs_may_go():
    assert spare(plain) == ["slow", "friction"]


def test_a_branch_that_the_data_need_stays():
    assert spare(lambda motion: plain(motion) + friction(motion)) == ["slow"]
