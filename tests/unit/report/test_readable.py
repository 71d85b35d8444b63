"""Shares, intervals in percent and lists as a sentence has them."""

from __future__ import annotations

from dashpot.report.readable import join, listed, percent, percent_interval


def test_shares_are_written_in_percent():
    assert percent(0.76) == "76 %"
    assert percent_interval([0.71, 0.80]) == "71 to 80"
    assert percent_interval([-0.03, 0.06]) == "-3 to 6"
    assert percent_interval([0.0004, 0.08]) == "0.04 to 8"
    assert percent(float("nan")) == "–"
    assert percent_interval(None) is None


def test_words_are_joined_as_in_a_sentence():
    assert [join(list("abc")[:count]) for count in (1, 2, 3)] == ["a", "a and b", "a, b and c"]


def test_a_list_is_numbered_where_an_entry_holds_an_or():
    assert listed(["a", "b", "c"]) == "a, b and c"
    assert listed(["a or b"]) == "a or b"
    assert listed(["a", "b or c", "d"]) == "(1) a, (2) b or c and (3) d"
