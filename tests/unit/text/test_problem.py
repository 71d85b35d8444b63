"""A problem says what, where and what to do; an input error says all of them in the order of the text."""

from __future__ import annotations

import pytest

from dashpot.text.problem import InputError, Place, Problem, nearest, of_family, problem_lines


def test_a_place_reads_as_file_line_column():
    assert str(Place("spec.yaml", 3, 7)) == "spec.yaml:3:7"
    assert str(Place("spec.yaml")) == "spec.yaml"
    assert str(Place(None, 3, 7)) == "<text>:3:7"


def test_a_problem_reads_as_place_message_and_hint():
    problem = Problem(Place("a.yaml", 1, 2), "expected a number, got 'x'", "write 3.5")
    assert str(problem) == "a.yaml:1:2: expected a number, got 'x'. write 3.5"
    assert str(Problem(Place(), "nothing to read")) == "nothing to read"
    assert str(Problem(Place("a.csv"), "gaps", severity="warning")) == "a.csv: warning: gaps"


def test_a_problem_shows_no_terminal_what_it_would_obey():
    # ESC ] 0 ; ... BEL renames the window, U+202E turns what follows; a line end would begin another message
    name = "\x1b]0;owned\x07\u202eb\n"
    told = str(Problem(Place(name), f"unknown unit '{name}'", f"known: '{name}'"))
    assert all(sign.isprintable() for sign in told)
    assert told.count(r"\u001b]0;owned\u0007\u202eb\u000a") == 3
    assert str(Problem(Place(), "Maße in µm, \u65e5\u672c")) == "Maße in µm, \u65e5\u672c"


def test_an_input_error_has_a_line_for_each_problem_in_the_order_of_the_text():
    late, early = Problem(Place("a", 10, 1), "late"), Problem(Place("a", 2, 1), "early")
    error = InputError([late, early])
    assert error.problems == (early, late)
    assert str(error) == "a:2:1: early\na:10:1: late"


def test_an_input_error_can_be_made_of_one_problem():
    error = InputError.at(Place("a", 1, 1), "wrong", "mend it")
    assert str(error) == "a:1:1: wrong. mend it"


def test_the_nearest_word_is_found_whatever_its_case():
    assert nearest("sprng", ["spring", "dahl"]) == "did you mean 'spring'?"
    assert nearest("hz", ["Hz", "m"]) == "did you mean 'Hz'?"
    assert nearest("capacitor", ["spring", "dahl"]) == ""


@pytest.mark.parametrize(
    "word, found",
    [
        ("axle", "did you mean 'axle_1' or 'axle_2'?"),
        ("Axle-2", "did you mean 'axle_2'?"),
        ("tire2", "did you mean 'tire_2'?"),
        ("tire", "did you mean 'tire_2' or 'big_tire_2'?"),
        ("sprng", "did you mean 'spring'?"),
        ("capacitor", ""),
    ],
)
def test_words_of_one_family_are_offered_together(word, found):
    assert of_family(word, ["axle_1", "axle_2", "tire_2", "big_tire_2", "spring"]) == found


def test_runs_with_the_same_fault_are_counted_and_other_mistakes_all_stand():
    empty = "is set aside: it is empty"
    runs = [Problem(Place("d.yaml", n), f"run 'r{n}' (r{n}.csv) {empty}", "remove it") for n in range(9)]
    others = [Problem(Place("d.yaml", 20 + n), f"'k{n}': expected a number", "write one") for n in range(9)]
    told = list(problem_lines([*runs, *others]))
    assert told[:3] == [str(each) for each in runs[:3]]
    assert told[3] == "... and 6 more runs, of which the same is true"
    assert told[4:] == [str(each) for each in others]
    assert list(problem_lines(runs[:4])) == [str(each) for each in runs[:4]]
    assert str(InputError(runs)).count("\n") == 3 and len(InputError(runs).problems) == 9
