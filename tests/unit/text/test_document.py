"""A YAML text is read safely, after YAML 1.2, and every node knows exactly where it stands."""

from __future__ import annotations

import json
import math

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from dashpot.text.compose import MAX_ALIASES, MAX_DEPTH, MAX_NODES
from dashpot.text.document import MAX_BYTES, Document, Mapping, Node, Scalar, Sequence
from dashpot.text.problem import InputError


def value_of(text: str) -> object:
    return Document.parse(f"key: {text}\n").root.plain()["key"]


def problems_of(text: str) -> str:
    with pytest.raises(InputError) as caught:
        Document.parse(text, "t.yaml")
    return str(caught.value)


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("12e3", 12e3),
        ("1e-3", 1e-3),
        ("-.5", -0.5),
        ("3.", 3.0),
        ("012", 12),
        ("0o17", 15),
        ("0x1F", 31),
        ("+7", 7),
        (".inf", math.inf),
        ("-.INF", -math.inf),
        ("true", True),
        ("FALSE", False),
        ("null", None),
        ("~", None),
        ("", None),
    ],
)
def test_numbers_and_truth_values_are_those_of_yaml_1_2(written, meant):
    value = value_of(written)
    assert value == meant and type(value) is type(meant)


@pytest.mark.parametrize("text", ["on", "no", "yes", "12:30", "1_000", "2024-01-02", "1,5", "0b1", "nan", "1e"])
def test_what_yaml_1_1_takes_for_a_value_stays_a_text(text):
    assert value_of(text) == text


def test_not_a_number_is_a_float():
    assert math.isnan(value_of(".nan"))


def test_quoted_numbers_are_texts():
    assert value_of("'12'") == "12"
    assert value_of('"true"') == "true"


TEXT = """\
# a tyre
name: test   # the name
branches:
  spring: {stiffness: 220 N/mm, list: [1, 2 ]}  # comment

  # about the damper
  damper:
    viscosity: 0.2 N*s/mm

notes: |
  two lines
  of text

# the end
empty:
"""


def text_of(document: Document, node: Node) -> str:
    return document.text[node.start : node.end]


def test_the_span_of_a_node_is_its_text_without_comments():
    document = Document.parse(TEXT)
    root = document.root.entries
    spring, damper = root["branches"].entries["spring"], root["branches"].entries["damper"]
    assert text_of(document, root["name"]) == "test"
    assert text_of(document, spring) == "{stiffness: 220 N/mm, list: [1, 2 ]}"
    assert text_of(document, spring.entries["list"]) == "[1, 2 ]"
    assert text_of(document, damper) == "viscosity: 0.2 N*s/mm"
    assert text_of(document, root["notes"]) == "|\n  two lines\n  of text"
    assert text_of(document, root["branches"]).endswith("0.2 N*s/mm")
    assert text_of(document, document.root.keys["branches"]) == "branches"


def test_the_place_counts_lines_and_columns_from_one():
    damper = Document.parse(TEXT, "tyre.yaml").root.entries["branches"].entries["damper"]
    assert str(damper.entries["viscosity"].place) == "tyre.yaml:8:16"


def test_an_empty_value_stands_right_behind_its_colon():
    document = Document.parse(TEXT)
    empty = document.root.entries["empty"]
    assert empty.start == empty.end == TEXT.index("empty:") + len("empty:")


@given(
    values=st.lists(st.text(st.characters(codec="utf-8", categories=["L", "N"]), min_size=1, max_size=8), min_size=1),
    comments=st.booleans(),
)
def test_replacing_a_scalar_by_its_span_changes_only_that_scalar(values, comments):
    tail = "   # ä remark" if comments else ""
    text = "".join(f"k{index}: '{value}'{tail}\r\n" for index, value in enumerate(values))
    document = Document.parse(text)
    last = document.root.entries[f"k{len(values) - 1}"]
    changed = Document.parse(text[: last.start] + "42" + text[last.end :]).root.plain()
    assert changed == {f"k{index}": value for index, value in enumerate(values[:-1])} | {f"k{len(values) - 1}": 42}


@settings(max_examples=300, deadline=None)
@given(st.text(st.sampled_from("abc:-[]{},'\"#&*!|>%@`?~ \n\t\r1.e\x00ä\ufeff"), max_size=60))
def test_any_text_is_a_document_or_an_input_error(text):
    try:
        document = Document.parse(text)
    except InputError as error:
        assert all(problem.place.line >= 1 and problem.hint for problem in error.problems)
        return
    for node in scalars_of(document.root):
        assert 0 <= node.start <= node.end <= len(text)
        assert text_of(document, node) == text_of(document, node).strip()


leaves = st.one_of(st.integers(), st.booleans(), st.text("ab c:#", max_size=8), st.floats(-1e9, 1e9))
names = st.text("abcdef", min_size=1, max_size=5)
trees = st.recursive(leaves, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3))


@settings(max_examples=100, deadline=None)
@given(tree=st.dictionaries(names, trees, min_size=1, max_size=4), flow=st.booleans())
def test_what_json_or_yaml_writes_is_read_back_and_every_scalar_spans_its_own_text(tree, flow):
    text = json.dumps(tree, indent=1) if flow else yaml.safe_dump(tree, allow_unicode=True)
    document = Document.parse(text)
    assert document.root.plain() == tree
    for node in scalars_of(document.root):
        again = Document.parse("key: " + text_of(document, node).replace("\n", "\n ")).root.plain()["key"]
        assert again == node.value


def scalars_of(node: Node) -> list[Scalar]:
    if isinstance(node, Scalar):
        return [node]
    inner = node.entries.values() if isinstance(node, Mapping) else node.items
    return [scalar for child in inner for scalar in scalars_of(child)]


def test_an_empty_text_is_an_empty_scalar():
    root = Document.parse("# nothing\n").root
    assert isinstance(root, Scalar) and root.value is None


def test_lists_and_mappings_become_nodes():
    root = Document.parse("- 1\n- {a: b}\n").root
    assert isinstance(root, Sequence) and isinstance(root.items[1], Mapping)
    assert root.plain() == [1, {"a": "b"}]


def test_all_duplicate_keys_are_told_at_once():
    text = problems_of("a: 1\nb: 2\na: 3\nb: 4\n")
    assert "t.yaml:3:1: 'a' stands twice, first in line 1" in text
    assert "t.yaml:4:1: 'b' stands twice, first in line 2" in text


def test_tags_are_refused():
    assert "t.yaml:1:4: the tag 'tag:yaml.org,2002:python/object:os.system'" in problems_of(
        "a: !!python/object:os.system {}\n"
    )
    assert "the tag '!x'" in problems_of("a: !x 1\n")


def test_a_second_document_is_refused():
    assert "t.yaml:2:1: a second document" in problems_of("a: 1\n---\nb: 2\n")


def test_a_key_must_be_a_name():
    assert "t.yaml:1:3: expected a name" in problems_of("? [a]\n: 1\n")
    assert "expected a name before ':', got nothing" in problems_of("? \n: 1\n")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a:\n\tb: 1\n", "t.yaml:2:1: this is not YAML"),
        ("a:\n\tb: 1\n", "indent with spaces"),
        ("a: b: c\n", "t.yaml:1:5: this is not YAML"),
        ("a: [1, 2\nb: 3\n", "t.yaml:2:2"),
        ("a: 'open\n", "close the quote"),
        ("a: \x07\n", "t.yaml:1:4: the character U+0007 is not allowed"),
        ("  a: 1\n b: 2\n", "same column"),
    ],
)
def test_a_broken_text_is_told_with_place_and_remedy(text, expected):
    assert expected in problems_of(text)


def test_a_few_aliases_are_followed_and_keep_their_own_span():
    document = Document.parse("a: &x {b: 1}\nc: *x\n")
    assert document.root.plain() == {"a": {"b": 1}, "c": {"b": 1}}
    assert text_of(document, document.root.entries["c"]) == "*x"


def test_many_aliases_are_refused():
    assert f"more than {MAX_ALIASES} aliases" in problems_of("a: &x 1\nb: [" + "*x, " * (MAX_ALIASES + 1) + "]\n")


def test_an_alias_of_nothing_is_refused():
    assert "t.yaml:1:4: '*x' refers to nothing above" in problems_of("a: *x\n")
    assert "'*x' refers to nothing above" in problems_of("a: &x [*x]\n")


def test_aliases_that_multiply_are_counted_in_full():
    lines = [f"a0: &a0 [{'1, ' * 2000}]"]
    lines += [f"a{level}: &a{level} [*a{level - 1}, *a{level - 1}]" for level in range(1, 8)]
    assert f"more than {MAX_NODES} values" in problems_of("\n".join(lines))


def test_deep_nesting_is_refused():
    assert f"more than {MAX_DEPTH} levels" in problems_of("[" * 5000)


def test_too_many_values_are_refused():
    assert f"more than {MAX_NODES} values" in problems_of("[" + "1," * (MAX_NODES + 1) + "]")


def test_a_large_file_is_refused_before_it_is_parsed(tmp_path):
    path = tmp_path / "large.yaml"
    path.write_bytes(b"#" * (MAX_BYTES + 1))
    with pytest.raises(InputError, match=f"larger than {MAX_BYTES} bytes"):
        Document.read(path)
    with pytest.raises(InputError, match=f"larger than {MAX_BYTES} bytes"):
        Document.parse("#" * (MAX_BYTES + 1))


def test_a_missing_file_and_a_folder_are_told(tmp_path):
    with pytest.raises(InputError, match="there is no such file"):
        Document.read(tmp_path / "none.yaml")
    with pytest.raises(InputError, match="cannot be read"):
        Document.read(tmp_path)


def test_a_text_that_is_not_utf8_is_told_with_its_place(tmp_path):
    path = tmp_path / "latin.yaml"
    path.write_bytes("a: 1\nb: \xe4\n".encode("cp1252"))
    with pytest.raises(InputError, match=r"latin\.yaml:2:4: expected UTF-8 text, got the byte 0xe4"):
        Document.read(path)


def test_a_byte_order_mark_does_no_harm(tmp_path):
    path = tmp_path / "bom.yaml"
    path.write_bytes(b"\xef\xbb\xbfa: 1\n")
    assert Document.read(path).root.plain() == {"a": 1}
