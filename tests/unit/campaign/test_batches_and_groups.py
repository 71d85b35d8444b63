"""Control charts, groups of specimens, numbers in common, causes over specimens."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.campaign.alike import groups_alike
from dashpot.campaign.causes import causes_found
from dashpot.campaign.charts import control_charts
from dashpot.campaign.declaration import Job
from dashpot.campaign.named import named_by_causes
from dashpot.campaign.numbers import Numbers
from dashpot.campaign.sharing import pooled


def numbers(at: np.ndarray) -> Numbers:
    count = len(at)
    return Numbers(
        tuple(map(str, range(count))),
        ("k",),
        ("N/m",),
        np.array([False]),
        at[:, None],
        np.full((count, 1, 1), 1e-6),
        np.ones((count, 1)),
    )


def test_limits_are_three_standard_errors_by_the_scatter_within_batches():
    # within each batch -1, 0, 1: a standard deviation of 1, of a mean of three 1/sqrt(3); the centre is that of all
    at = np.array([9.0, 10.0, 11.0, 11.0, 12.0, 13.0, 7.0, 8.0, 9.0])
    batches = ["a"] * 3 + ["b"] * 3 + ["c"] * 3
    [chart] = control_charts(numbers(at), np.zeros((1, 1)), batches, np.ones(9, dtype=bool))
    assert chart["center"] == pytest.approx(10.0)
    for batch, mean in zip(chart["batches"], (10.0, 12.0, 8.0), strict=True):
        assert (batch["mean"], batch["count"]) == (pytest.approx(mean), 3)
        assert batch["high"] - batch["low"] == pytest.approx(6.0 / np.sqrt(3.0))
    assert [batch["outside"] for batch in chart["batches"]] == [False, True, True]


def test_without_batches_there_is_no_chart():
    at = np.arange(4.0)
    assert control_charts(numbers(at), np.zeros((1, 1)), [None] * 4, np.ones(4, dtype=bool)) == []
    assert control_charts(numbers(at), np.zeros((1, 1)), list("abcd"), np.ones(4, dtype=bool)) == []


def test_two_suppliers_are_two_groups_and_one_is_one():
    rng = np.random.default_rng(3)
    one = rng.normal(size=(40, 2)) * 0.05
    two = one + np.where(np.arange(40)[:, None] % 2, [0.5, -0.3], 0.0)
    assert set(groups_alike(one, np.cov(one.T), 0)) == {1}
    groups = groups_alike(two, np.cov(two.T), 0)
    assert set(groups) == {1, 2} and len(set(groups[::2])) == len(set(groups[1::2])) == 1


@pytest.mark.parametrize("share", [2, 3])
def test_groups_are_found_beside_numbers_that_do_not_tell_them_apart(share):
    rng = np.random.default_rng(seed_of("groups beside others"))
    other = np.arange(40) % share == 0
    rows = rng.normal(size=(40, 4)) * 0.05 + np.where(other[:, None], [0.3, -0.3, 0.0, 0.0], 0.0)
    groups = groups_alike(rows - rows.mean(axis=0), np.cov(rows.T), 0)
    assert set(groups[other]) == {1} and set(groups[~other]) == {2}


def test_one_population_is_seldom_split():
    rng = np.random.default_rng(seed_of("one group"))
    split = sum(groups_alike(rows := rng.normal(size=(40, 3)), np.cov(rows.T), 0).max() > 1 for _ in range(40))
    assert split <= 4


def outcome(value: float, error: float) -> dict:
    number = {"value": value, "unit": "N", "log": False, "interval": [0.0, 0.0], "error": error}
    return {
        "models": [
            {
                "name": "m",
                "numbers": {"f.limit": number, "k.stiffness": {**number, "value": 5.0}},
                "correlation": [[1.0, 0.0], [0.0, 1.0]],
            }
        ]
    }


def test_numbers_in_common_are_weighted_means():
    outcomes = {
        Job(name, "", "fit", ("m",)): outcome(value, error)
        for name, value, error in (("a", 10.0, 1.0), ("b", 13.0, 2.0))
    }
    shared = pooled("m", ("f.*",), outcomes)
    assert shared is not None and list(shared.values) == ["f.limit"]
    assert shared.values["f.limit"] == pytest.approx((10.0 / 1.0 + 13.0 / 4.0) / 1.25)
    width = 1.959964 / np.sqrt(1.25)
    assert np.diff(shared.intervals["f.limit"])[0] == pytest.approx(2.0 * width)
    # Q = (10 - 10.6)^2 + (13 - 10.6)^2 / 4 = 1.8 with one degree of freedom
    assert shared.probability == pytest.approx(0.17971, rel=1e-4)
    assert pooled("m", ("x.*",), outcomes) is None


def cause(title: str, probability: float, accepted: bool = True) -> dict:
    return {
        "cause": title,
        "title": title,
        "place": None,
        "class": "specimen",
        "probability": probability,
        "accepted": accepted,
        "evidence": "a flat spot",
    }


def test_causes_are_told_by_specimen_and_absent_ones_are_zero():
    outcomes = {
        Job("a", "", "diagnose", ("m",)): {"causes": [cause("play", 0.9)]},
        Job("b", "", "diagnose", ("m",)): {"causes": []},
        Job("b", "", "fit", ("m",)): {},
    }
    [row] = causes_found(outcomes)
    assert row["probability"] == {"a": 0.9, "b": 0.0} and row["certain"] == {}


def test_who_has_an_effect_that_most_others_lack_is_named():
    # play is in one of four; creep in two of four is how they are made; friction was not accepted, gap is not sure
    found = {
        "a": [cause("play", 0.99), cause("creep", 1.0)],
        "b": [cause("creep", 1.0), cause("friction", 0.99, accepted=False)],
        "c": [cause("gap", 0.9)],
        "d": [],
    }
    outcomes = {Job(name, "", "diagnose", ("m",)): {"causes": causes} for name, causes in found.items()}
    [named] = named_by_causes(causes_found(outcomes))
    assert (named.specimen, named.kind, named.probability) == ("a", "damaged or mounted otherwise", 0.99)
    assert named.evidence == ("play, in 1 of 4 specimens: a flat spot",)
