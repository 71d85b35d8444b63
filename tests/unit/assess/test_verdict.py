"""What is said in the end: a cause that was needed twice explains the data, but hardly is what is hidden."""

from types import SimpleNamespace

import pytest

from dashpot.assess.leftover import Leftover
from dashpot.assess.verdict import give_verdict, stands_in

NOTHING_LEFT = Leftover(0.0, 0.0, "")
MUCH_LEFT = Leftover(50.0, 0.5, "follows the velocity")


def entry(word, gain=1000.0, kind="specimen", rivals=()):
    candidate = SimpleNamespace(name=(word, ""), cause=SimpleNamespace(word=word, kind=kind))
    return SimpleNamespace(
        finding=SimpleNamespace(candidate=candidate), trial=SimpleNamespace(gain=gain), rivals=rivals
    )


def verdict(*accepted, leftover=NOTHING_LEFT, faults=(), cut_short=False):
    pursuit = SimpleNamespace(accepted=accepted, explained=1.0, cut_short=cut_short)
    return give_verdict(faults, pursuit, leftover)


@pytest.mark.parametrize(
    ("second", "said"),
    [
        (entry("asymmetric_damping", 500.0), "partly_explained"),
        (entry("asymmetric_damping", 5.0), "explained"),
        (entry("friction", 500.0), "explained"),
    ],
)
def test_a_cause_in_the_specimen_that_is_needed_twice_stands_in_for_another_one(second, said):
    assert verdict(entry("asymmetric_damping"), second) == said
    assert bool(stands_in([entry("asymmetric_damping"), second])) is (said == "partly_explained")


def test_a_fault_that_is_found_in_further_runs_does_not():
    assert verdict(entry("gain", kind="measurement"), entry("gain", 500.0, "measurement")) == "explained"


def test_what_weighs_more_is_said_first():
    assert verdict(entry("drift"), faults=("clipping",)) == "bad_data"
    assert verdict(entry("drift", rivals=("offset",)), leftover=MUCH_LEFT) == "ambiguous"
    assert verdict(entry("drift"), leftover=MUCH_LEFT) == "partly_explained"
    assert verdict(leftover=MUCH_LEFT) == "unexplained"
    assert verdict() == "nothing_missing"
    assert verdict(entry("drift"), cut_short=True) == "partly_explained"
