"""The engine on blind cases drawn at test time; the large set is ``python tests/blind/run.py``.

Bounds are binomial: an engine that is right in 95 % of the cases fails here less than once in 2 000 runs.
"""

from run import Bench
from score import NOTHING, Outcome

KINDS = ("friction", "relaxation", "moving_mass", "preload_dependent_damping")
RIGHT_AT_LEAST = 2  # of 4: P(fewer | 0.95) = 5e-4
STRENGTH = 2.0
FAULTS_OF_SINGLE_RUNS = {"offset", "gain", "drift"}


def test_hidden_effects_are_named_first(seed):
    """Of four effects in forms that are not our elements' most are named first, with a gain on runs never seen."""
    outcomes = [Bench().run(seed + k, "kelvin_voigt", kind, STRENGTH) for k, kind in enumerate(KINDS)]
    told(outcomes)
    right = [outcome for outcome in outcomes if outcome.right]
    assert len(right) >= RIGHT_AT_LEAST
    assert all(cause["gain"] > 0.0 for outcome in right for cause in outcome.verdict["causes"])


def test_viscous_damping_is_found_where_the_base_has_none(seed):
    """A spring without damper on a damped specimen: at least one of three is named right (P(none | 0.95) = 1e-4)."""
    assert any(told_right(Bench().run(seed + k, "spring", "viscous_damping", STRENGTH)) for k in range(3))


def test_nothing_is_named_where_nothing_is_hidden(seed):
    """Three null cases: two may not raise a false alarm (P(two | 1 %) = 3e-4), and silence is called by its name."""
    outcomes = [Bench().run(seed + k, base, "null") for k, base in enumerate(("kelvin_voigt", "ftire", "damper"))]
    told(outcomes)
    assert sum(bool(outcome.named) for outcome in outcomes) <= 1
    assert sum(outcome.verdict["verdict"] == NOTHING for outcome in outcomes) >= 2


def test_a_diagnosis_goes_through_on_a_single_run(seed):
    """With one sweep there is nothing to hold out: no gain is invented, save that of a fault on pieces of its run."""
    outcome = Bench("one_sweep").run(seed, "kelvin_voigt", "friction", STRENGTH)
    told([outcome])
    assert outcome.verdict["held_out"] == []
    measured = {cause["cause"] for cause in outcome.verdict["causes"] if cause["gain"] is not None}
    assert outcome.verdict["causes"]
    assert measured <= FAULTS_OF_SINGLE_RUNS


def told(outcomes: list[Outcome]) -> None:
    """Print the cases for the record of a failed run."""
    for outcome in outcomes:
        print(outcome.line())


def told_right(outcome: Outcome) -> bool:
    """Print a case; whether what was hidden is named."""
    told([outcome])
    return outcome.right
