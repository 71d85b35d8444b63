"""Python values as YAML read back as what they were."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.text.document import Document
from dashpot.text.written import flow

# texts that mean a number stay one, and so have no digits here
TEXTS = st.text("ab :{}[],#'\"\n-/*&!|>%@`é", max_size=8)
NAMES = st.text("ab_", min_size=1, max_size=3)
LEAVES = st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | TEXTS
VALUES = st.recursive(
    LEAVES, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(NAMES, inner, max_size=3), max_leaves=8
)


@given(VALUES)
def test_a_value_reads_back_as_it_was(value):
    assert Document.parse(flow({"key": value})).root.plain() == {"key": value}


def test_numbers_of_numpy_and_quantities_are_written_plainly():
    written = flow({"stiffness": "220 N/mm", "at": np.array([1e-3, 2.0]), "repeat": np.int64(3)})
    assert written == "{stiffness: 220 N/mm, at: [0.001, 2.0], repeat: 3}"


@pytest.mark.parametrize("value", [None, object()])
def test_what_a_file_cannot_say_is_refused(value):
    with pytest.raises(TypeError, match="expected a number, a text such as '220 N/mm'"):
        flow({"key": value})
