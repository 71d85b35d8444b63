"""Names that become names of files."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.text.name import LONGEST, is_name, joined_name, shown


@pytest.mark.parametrize("name", ["mount", "Stoßdämpfer 2", "a+b-c_1", "20 °C", "x" * 120, "橡胶", "v1.2"])
def test_names_of_people_are_names(name):
    assert is_name(name)


@pytest.mark.parametrize(
    "name",
    [
        "",
        "x" * 121,
        "a/b",
        "a\\b",
        "..",
        ".hidden",
        "a\nb",
        "a\x7fb",
        "a\0b",
        "con:",
        "what?",
        "all*",
        " a",
        "a ",
        "a\u202egnp.exe",
        "a\u200bb",
        "a\u2066b",
        "a\u2028b",
        "\ufeffa",
    ],
)
def test_what_cannot_be_a_file_or_deceives_the_reader_is_none(name):
    assert not is_name(name)


def test_what_cannot_be_seen_is_written_out():
    assert shown("a\u202eb\n") == "'a\\u202eb\\u000a'"
    assert shown("x" * 300) == f"'{'x' * 120}...' of 300 characters"


@given(st.text("abc_", min_size=1, max_size=LONGEST), st.lists(st.text("xyz_", min_size=1, max_size=30), min_size=1))
def test_a_joined_name_is_a_name_and_tells_how_many_words_it_has_no_room_for(name, words):
    found = joined_name(name, words)
    assert is_name(found)
    whole = "+".join([name, *words])
    if len(whole) <= LONGEST:
        assert found == whole
    else:
        start, _, more = found.rpartition("+")
        left = int(more.removesuffix("_more"))
        assert 1 <= left <= len(words) and whole.startswith(start)
        assert left == len(words) or start == "+".join([name, *words[: len(words) - left]])
