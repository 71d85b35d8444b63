"""Result files say what was meant, bit by bit, and the same thing always in the same bytes."""

from __future__ import annotations

import enum
import json
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.report.json_text import NotFiniteError, json_text

finite = st.floats(allow_nan=False, allow_infinity=False)
scalars = st.none() | st.booleans() | st.integers() | finite | st.text()
contents = st.recursive(scalars, lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner), max_leaves=30)


@given(contents)
def test_what_is_written_reads_back_alike(content):
    assert json.loads(json_text(content)) == content


@given(finite)
def test_a_float_survives_to_the_last_bit(value):
    back = json.loads(json_text({"value": value}))["value"]
    assert np.float64(back).tobytes() == np.float64(value).tobytes()


@given(contents)
def test_the_text_ends_with_one_newline(content):
    assert json_text(content).endswith("\n")
    assert not json_text(content).endswith("\n\n")


def test_keys_keep_their_order():
    assert list(json.loads(json_text({"rank": 1, "cause": 2, "also": 3}))) == ["rank", "cause", "also"]


def test_sets_are_sorted():
    words = {f"run {index:02d}" for index in range(50)}
    assert json.loads(json_text({"runs": words}))["runs"] == sorted(words)


def test_numpy_is_written_as_numbers():
    content = {"array": np.arange(3.0), "scalar": np.float32(0.5), "count": np.int64(7), "flag": np.bool_(True)}
    assert json.loads(json_text(content)) == {"array": [0.0, 1.0, 2.0], "scalar": 0.5, "count": 7, "flag": True}


def test_dataclasses_and_enumerations_are_written_as_what_they_mean():
    class Verdict(enum.Enum):
        EXPLAINED = "explained"

    @dataclass(frozen=True)
    class Floor:
        value: float
        verdict: Verdict

    assert json.loads(json_text(Floor(14.5, Verdict.EXPLAINED))) == {"value": 14.5, "verdict": "explained"}


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, np.float64("nan")])
def test_a_number_that_is_not_finite_is_an_error_that_names_its_place(value):
    with pytest.raises(NotFiniteError, match=r"models\[1\]\.rmse\.train: expected a finite number, got"):
        json_text({"models": [{}, {"rmse": {"train": value}}]})


def test_a_number_in_an_array_is_named_by_its_position():
    with pytest.raises(NotFiniteError, match=r"best\[2\]"):
        json_text({"best": np.array([1.0, 2.0, np.nan])})


def test_where_a_number_may_be_missing_it_becomes_null():
    text = json_text({"gain": {"low": np.nan}, "rank": 1}, optional={"gain"})
    assert json.loads(text) == {"gain": {"low": None}, "rank": 1}


def test_what_json_cannot_say_is_refused_with_its_place():
    with pytest.raises(TypeError, match=r"runs\[0\]: expected numbers, texts, lists or mappings, got complex"):
        json_text({"runs": [1j]})
    with pytest.raises(TypeError, match="the result: expected texts as keys, got int 3"):
        json_text({3: "three"})


def test_short_lists_stand_on_one_line():
    assert '"gain_interval": [0.71, 0.8]' in json_text({"causes": [{"gain_interval": [0.71, 0.80]}]})
