"""What is left out at a time."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.diagnose.folds import FEWEST, MOST, folds_of, whole_cycles

SINE = np.sin(2.0 * np.pi * np.arange(4000) / 200.0 - 0.1)


def run(name, path=SINE, first=0):
    return SimpleNamespace(name=name, first=first, drive=SimpleNamespace(displacement=path))


@pytest.mark.parametrize("pieces", [2, 5, 8])
def test_pieces_are_whole_cycles(pieces):
    edges = whole_cycles(SINE, pieces)
    inner = np.array(edges[1:-1])
    assert edges[0] == 0 and edges[-1] == SINE.size and len(edges) == pieces + 1
    assert ((SINE[inner - 1] <= SINE.mean()) & (SINE[inner] > SINE.mean())).all()
    assert set(np.diff(inner) % 200) <= {0}


def test_a_ramp_is_cut_evenly():
    assert whole_cycles(np.linspace(0.0, 1.0, 800), 4) == [0, 200, 400, 600, 800]


def test_enough_groups_are_left_out_whole_with_their_repeats():
    groups = {**{f"r{k}": f"r{k}" for k in range(FEWEST)}, "again": "r0"}
    folds = folds_of([run(name) for name in groups], groups)
    assert folds.names == tuple(f"r{k}" for k in range(FEWEST))
    assert folds.of_run("again", 1000) == [(0, slice(0, 1000))]
    assert folds.of_run("r3", 700) == [(3, slice(0, 700))]


def test_of_many_groups_several_are_left_out_together():
    """As evenly as may be, repeats with what they repeat."""
    count = 2 * MOST + 5
    groups = {**{f"r{k}": f"r{k}" for k in range(count)}, "again": f"r{count - 1}"}
    folds = folds_of([run(name) for name in groups], groups)
    sizes = np.bincount([folds.parts[f"r{k}"][1][0] for k in range(count)])
    assert sizes.size == len(folds.names) == MOST and set(sizes) == {2, 3}
    assert folds.parts["again"] == folds.parts[f"r{count - 1}"] and folds.groups == count


def test_of_few_groups_parts_of_whole_cycles_are_left_out():
    """A repeat is the same motion and is cut at the same places, into the same folds."""
    groups = {"a": "a", "b": "b", "a_again": "a"}
    folds = folds_of([run(name) for name in groups], groups)
    assert folds.names == ("a, part 1", "a, part 2", "a, part 3", "b, part 1", "b, part 2", "b, part 3")
    assert folds.parts["a"] == folds.parts["a_again"]
    assert [number for number, _ in folds.of_run("b", 4000)] == [3, 4, 5]


@given(st.integers(1, 9), st.integers(1, 2000), st.integers(0, 300))
def test_every_sample_is_left_out_once(groups, kept, first):
    names = {f"r{k}": f"r{k}" for k in range(groups)}
    folds = folds_of([run(name, first=first) for name in names], names)
    for name in names:
        left_out = np.zeros(kept, dtype=int)
        for _, part in folds.of_run(name, kept):
            left_out[part] += 1
        assert (left_out == 1).all()
    assert len(folds.names) >= min(FEWEST, groups)
