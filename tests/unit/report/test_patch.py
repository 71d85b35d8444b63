"""A patch is shown in full, line by line."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from dashpot.report.patch import diff

texts = st.lists(st.text(st.characters(exclude_characters="\n"), max_size=5), min_size=1, max_size=12).map("\n".join)


@given(texts, texts)
def test_both_texts_can_be_read_off_the_marks(before, after):
    lines = diff(before, after).split("\n")
    assert [line[2:] for line in lines if line[:2] in ("  ", "- ")] == before.removesuffix("\n").split("\n")
    assert [line[2:] for line in lines if line[:2] in ("  ", "+ ")] == after.removesuffix("\n").split("\n")


@given(texts)
def test_an_unchanged_text_has_no_mark(text):
    assert all(line.startswith("  ") for line in diff(text, text).split("\n"))


def test_added_lines_stand_where_they_were_added():
    assert diff("a\nc\n", "a\nb\nc\n") == "  a\n+ b\n  c"
