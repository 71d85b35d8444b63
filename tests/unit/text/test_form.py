"""A form collects all mistakes of a mapping, each with its place and the nearest known word."""

from __future__ import annotations

import pytest

from dashpot.text.document import Document
from dashpot.text.form import Form


def form_of(text: str) -> Form:
    return Form(Document.parse(text, "f.yaml").root, [], "the branch 'a'")


def told(form: Form) -> list[str]:
    return [str(problem) for problem in form.problems]


def test_values_come_out_as_what_was_asked_for():
    form = form_of("t: word\nn: 2.5\ni: 3\nf: true\nq: 220 N/mm\nl: [1 mm, 2]\nw: [a, b]\nc: log\nv: 12\n")
    assert (form.text("t"), form.number("n"), form.integer("i"), form.flag("f")) == ("word", 2.5, 3, True)
    assert form.quantity("q", "N/m") == 220e3
    assert form.quantities("l", "m") == [0.001, 2.0]
    assert form.texts("w") == ["a", "b"]
    assert form.choice("c", ["log", "linear"]) == "log"
    assert form.text("v") == "12"
    form.close()
    assert told(form) == []


def test_all_mistakes_are_told_at_once():
    form = form_of("stifness: 3 N/m\nlimit: 3 mm\nn: x\ni: 2.5\nf: on\nc: lg\nl: 3\nt: [1]\n")
    assert form.quantity("stiffness", "N/m") is None
    assert form.quantity("limit", "N") is None
    assert (form.number("n"), form.integer("i", 4), form.flag("f"), form.text("t")) == (None, 4, None, None)
    assert form.choice("c", ["log", "linear"], "log") == "log"
    assert form.quantities("l", "m") is None
    form.close()
    text = "\n".join(told(form))
    assert "f.yaml:1:1: the branch 'a' lacks 'stiffness'. add a line 'stiffness: ...'" in text
    assert "f.yaml:1:1: the branch 'a' has no key 'stifness'. did you mean 'stiffness'?" in text
    assert "f.yaml:2:8: the branch 'a', 'limit': expected a quantity in N, got 'mm', which measures length" in text
    assert "f.yaml:3:4: the branch 'a', 'n': expected a finite number, got the text 'x'" in text
    assert "f.yaml:4:4: the branch 'a', 'i': expected a whole number, got the number '2.5'" in text
    assert "f.yaml:5:4: the branch 'a', 'f': expected true or false, got the text 'on'" in text
    assert "f.yaml:6:4: the branch 'a', 'c': expected one of log, linear, got 'lg'; did you mean 'log'?" in text
    assert "f.yaml:7:4: the branch 'a', 'l': expected a list" in text
    assert "f.yaml:8:4: the branch 'a', 't': expected a text, got a list of 1" in text
    assert len(form.problems) == 9


def test_an_unknown_key_far_from_all_others_is_told_with_what_is_known():
    form = form_of("zzz: 1\n")
    form.text("name", "")
    form.close()
    assert told(form) == ["f.yaml:1:1: the branch 'a' has no key 'zzz'. known here: name"]


def test_optional_keys_give_their_default():
    form = form_of("a: 1\n")
    assert form.text("b", "default") == "default"
    assert form.number("c", None) is None
    assert told(form) == []


@pytest.mark.parametrize("value", ["", ".nan", ".inf", "true", "{a: 1}", "[1]"])
def test_a_number_is_finite_and_nothing_else(value):
    form = form_of(f"n: {value}\n")
    assert form.number("n") is None
    assert len(form.problems) == 1


@pytest.mark.parametrize("value", ["", "true", "{a: 1}", "1e400", "-1e31", "1 furlong"])
def test_a_quantity_that_is_none_is_told(value):
    form = form_of(f"q: {value}\n")
    assert form.quantity("q", "m") is None
    assert len(form.problems) == 1


def test_what_is_no_mapping_is_told_once():
    form = form_of("[1, 2]\n")
    assert form.text("name") is None
    form.close()
    assert told(form) == ["f.yaml:1:1: expected the branch 'a' as 'key: value' lines, got a list of 2. indent its keys"]


def test_nested_forms_note_into_the_same_list():
    form = form_of("one: {x: a}\nmany: [{x: 1}, {x: b}]\nnamed: {p: {x: c}, q: {x: 2}}\n")
    form.form("one").number("x")
    assert [inner.number("x") for inner in form.forms("many")] == [1.0, None]
    assert {name: inner.number("x") for name, inner in form.named("named").items()} == {"p": None, "q": 2.0}
    form.close()
    assert [problem.place.line for problem in form.problems] == [1, 2, 3]
    assert "'many' number 2" in told(form)[1] and "'p' of named" in told(form)[2]


def test_named_forms_need_a_mapping():
    form = form_of("named: [1]\n")
    assert form.named("named", {}) == {}
    assert "expected named entries" in told(form)[0]


def test_the_rest_are_the_keys_not_asked_for():
    form = form_of("a: 1\nb: 2\nc: 3\n")
    form.number("b")
    assert form.rest == ("a", "c")
    assert "a" in form and "z" not in form


def test_places_of_keys_and_values():
    form = form_of("a: 1\nbb: 2\n")
    assert (str(form.place_of("bb")), str(form.key_place("bb"))) == ("f.yaml:2:5", "f.yaml:2:1")
    assert str(form.place_of("zz")) == str(form.place) == "f.yaml:1:1"
