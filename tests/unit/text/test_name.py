"""Names that become names of files."""

from __future__ import annotations

import pytest

from dashpot.text.name import is_name, shown


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
