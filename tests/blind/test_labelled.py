"""Rates of cases of other makers, against numbers counted by hand."""

import pytest
from labelled import Judged, summary
from real.trial import Spent

SPENT = Spent(2.0, 300.0, None)


def cause(word, probability, accepted):
    return {"cause": word, "probability": probability, "accepted": accepted}


def case(verdict, *causes, hidden=(), accept=()):
    pairs = [(name, strength) for name, strength in hidden]
    found = {"verdict": verdict, "causes": list(causes)}
    return Judged("one", [name for name, _ in pairs], [strength for _, strength in pairs], accept, found, SPENT)


FRICTION = (("lugre", 2.0),), (("friction", "velocity_dependent_friction"),)
BOTH = (("lugre", 2.0), ("delay", 0.5)), (("friction",), ("delay",))


def test_any_word_that_counts_as_right_is_a_hit():
    found = case("explained", cause("velocity_dependent_friction", 0.95, True), hidden=FRICTION[0], accept=FRICTION[1])
    assert found.exact and found.hits == [True] and found.surplus == [] and not found.confidently_wrong


def test_a_name_that_is_not_hidden_is_surplus():
    causes = cause("friction", 1.0, True), cause("creep", 0.92, True), cause("gain", 0.4, False)
    found = case("explained", *causes, hidden=BOTH[0], accept=BOTH[1])
    assert found.hits == [True, False] and found.surplus == ["creep"] and not found.exact
    assert found.told == [(1.0, True), (0.92, False), (0.4, False)]


@pytest.mark.parametrize(
    ("verdict", "accept", "exact"),
    [
        ("nothing_missing", [["NOTHING"]], True),
        ("unexplained", [["clearance", "UNEXPLAINED"]], True),
        ("unexplained", [["NOTHING"]], False),
        ("nothing_missing", [], True),
    ],
)
def test_a_verdict_may_be_what_is_right(verdict, accept, exact):
    hidden = [("something", 1.0)] * len(accept)
    assert case(verdict, hidden=hidden, accept=accept).exact == exact


def test_all_wrong_and_said_to_be_explained_is_confidently_wrong():
    wrong = case("explained", cause("creep", 1.0, True), hidden=FRICTION[0], accept=FRICTION[1])
    unsure = case("partly_explained", cause("creep", 1.0, True), hidden=FRICTION[0], accept=FRICTION[1])
    assert wrong.confidently_wrong and not unsure.confidently_wrong


def test_the_rates_are_counted_over_all_cases():
    right = case("explained", cause("friction", 0.95, True), hidden=FRICTION[0], accept=FRICTION[1])
    half = case("explained", cause("friction", 1.0, True), cause("creep", 1.0, True), hidden=BOTH[0], accept=BOTH[1])
    failed = Judged("two", ["delay"], [3.0], [["delay"]], None, Spent(9.0, 700.0, "exit 1"))
    lines = list(summary([right, half, failed]))
    assert lines[0] == "exact: 1 of 3"
    assert lines[1] == "effects of 1 x noise and more named: 2 of 3"
    assert lines[2] == "surplus names: 1 of 3"
    assert lines[4] == "told with 0.9 and more and right: 2 of 3"
    assert lines[5] == f"Brier score: {(0.05**2 + 0.0 + 1.0) / 3:.3f}"
    assert lines[6] == "s: median 2, most 9; MB at most: 700" and lines[7] == "failed: 1"
    assert failed.line().startswith("    two: delay 3! -> failed: exit 1")
