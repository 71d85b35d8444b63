"""Graphs as text: what is read is made of the very nodes that were written."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.expr.node import constant, interned, lookup, symbol, table
from dashpot.expr.written import read_graphs, write_graphs

LEAVES = st.one_of(
    st.floats(allow_nan=False).map(constant), st.booleans().map(constant), st.text(max_size=8).map(symbol)
)
NODES = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.builds(interned, st.sampled_from(["add", "divide", "less"]), st.tuples(inner, inner), st.none()),
        st.builds(table, st.text(max_size=5), inner, st.integers(0, 2)),
        st.builds(lookup, st.text(max_size=5), inner, st.integers(0, 2)),
    ),
)
GRAPHS = st.recursive(
    NODES, lambda inner: st.one_of(st.lists(inner).map(tuple), st.dictionaries(st.text(max_size=5), inner))
)


@given(GRAPHS)
def test_what_is_read_is_what_was_written(graphs):
    assert same(read_graphs(write_graphs(graphs)), graphs)


@pytest.mark.parametrize("number", [-0.0, np.inf, -np.inf, 1e-320, 0.1, True, 1.0])
def test_numbers_keep_their_sign_and_kind(number):
    assert read_graphs(write_graphs((constant(number),)))[0] is constant(number)


def same(found, graphs) -> bool:
    """Whether the nodes are identical, at the same places of tuples and mappings in the same order."""
    if isinstance(graphs, dict):
        return list(found) == list(graphs) and all(same(found[name], graphs[name]) for name in graphs)
    if isinstance(graphs, tuple):
        return len(found) == len(graphs) and all(map(same, found, graphs))
    return found is graphs
