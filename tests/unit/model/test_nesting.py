"""Groups and used networks lie in each other up to a depth that no recursion feels; beyond it that is said."""

from __future__ import annotations

import pytest
from unit.model.specimens import ELEMENTS

from dashpot.model.nesting import MAXIMUM_DEPTH
from dashpot.model.reading import parse_network, read_network
from dashpot.model.written_out import write_out_uses
from dashpot.text.problem import InputError

HEAD = "format: dashpot-network/1\nname: n\nbranches:\n"
ELASTIC = "{element: elastic, stiffness: {start: 10, bounds: [1, 100]}}"


def chain(folder, files, around="{}"):
    """Files that use each other, each time in the groups ``around``; the first of them."""
    for number in range(files):
        entry = f"{{use: n{number + 1}.yaml}}" if number + 1 < files else ELASTIC
        (folder / f"n{number}.yaml").write_text(f"{HEAD}  it: {around.replace('{}', entry)}\n")
    return folder / "n0.yaml"


def nested(groups, kind="series"):
    """A text with so many groups in each other."""
    return HEAD + "  it: " + f"{{{kind}: {{it: " * groups + ELASTIC + "}}" * groups + "\n"


@pytest.mark.parametrize("files", [MAXIMUM_DEPTH + 2, 2000])
def test_a_chain_of_files_that_is_too_long_is_told_where_it_becomes_so(tmp_path, files):
    with pytest.raises(InputError) as caught:
        read_network(chain(tmp_path, files), ELEMENTS)
    last = tmp_path / f"n{MAXIMUM_DEPTH}.yaml"
    assert str(caught.value) == (
        f"{last}:4:13: expected groups and used networks up to 24 deep in each other, got one that is 25 deep. "
        "build it flatter: leave out groups and networks that hold nothing but a single group or network"
    )


def test_the_longest_chain_is_read_and_can_be_written_out(tmp_path):
    spec = read_network(chain(tmp_path, MAXIMUM_DEPTH + 1), ELEMENTS)
    assert spec.leaves()[0].name == ".".join(["it"] * (MAXIMUM_DEPTH + 1))
    document, again = write_out_uses(spec)
    assert "use:" not in document.text and again.leaves()[0].name == spec.leaves()[0].name


@pytest.mark.parametrize("kind", ["series", "parallel"])
def test_groups_in_groups_are_told_in_the_same_way(kind):
    assert len(parse_network(nested(MAXIMUM_DEPTH, kind), ELEMENTS).leaves()) == 1
    with pytest.raises(InputError, match="up to 24 deep in each other, got one that is 25 deep"):
        parse_network(nested(MAXIMUM_DEPTH + 1, kind), ELEMENTS)
    with pytest.raises(InputError, match="nested more than 64 levels deep"):
        parse_network(nested(1000, kind), ELEMENTS)


def test_groups_and_files_count_together(tmp_path):
    two = "{series: {a: {parallel: {b: {}}}}}"
    assert read_network(chain(tmp_path, MAXIMUM_DEPTH // 3, two), ELEMENTS)
    with pytest.raises(InputError, match="got one that is 25 deep"):
        read_network(chain(tmp_path, MAXIMUM_DEPTH // 3 + 1, two), ELEMENTS)


def test_what_was_read_where_it_lay_less_deep_counts_where_it_lies_deeper(tmp_path):
    chain(tmp_path, MAXIMUM_DEPTH)
    (tmp_path / "twice.yaml").write_text(
        f"{HEAD}  first: {{use: n0.yaml}}\n  second: {{series: {{it: {{use: n0.yaml}}}}}}\n"
    )
    with pytest.raises(InputError, match=r"twice\.yaml:5:31: .* got one that is 25 deep"):
        read_network(tmp_path / "twice.yaml", ELEMENTS)
