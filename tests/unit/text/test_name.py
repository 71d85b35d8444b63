"""Names that become names of files."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.text.name import LONGEST, MOST_BYTES, is_name, joined_name, shortened, shown


@pytest.mark.parametrize("name", ["mount", "Stoßdämpfer 2", "a+b-c_1", "20 °C", "x" * 120, "€" * 66, "橡胶", "v1.2"])
def test_names_of_people_are_names(name):
    assert is_name(name)


@pytest.mark.parametrize(
    "name",
    [
        "",
        "x" * 121,
        "€" * 67,
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


def test_a_text_of_several_names_is_short_enough_for_a_file_and_still_its_own():
    assert shortened("mount-fit-spring") == "mount-fit-spring"
    long = ["€" * 66 + "-fit-" + "橡" * 66 + end for end in ("", "-shared")]
    found = [shortened(text) for text in long]
    assert len({*found}) == 2 and all(name.startswith("€" * 60) for name in found)
    assert all(len(name.encode()) <= MOST_BYTES for name in found)


@given(st.text("abc_€", min_size=1, max_size=LONGEST), st.lists(st.text("xyz_", min_size=1, max_size=30), min_size=1))
def test_a_joined_name_is_a_name_and_tells_how_many_words_it_has_no_room_for(name, words):
    found = joined_name(name[: MOST_BYTES // 3], words)
    assert is_name(found)
    whole = "+".join([name[: MOST_BYTES // 3], *words])
    if len(whole) <= LONGEST and len(whole.encode()) <= MOST_BYTES:
        assert found == whole
    else:
        start, _, more = found.rpartition("+")
        left = int(more.removesuffix("_more"))
        assert 1 <= left <= len(words) and whole.startswith(start)
        assert left == len(words) or start == "+".join([name, *words[: len(words) - left]])
