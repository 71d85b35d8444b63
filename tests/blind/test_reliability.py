"""Brier score and reliability diagram against numbers computed by hand."""

from types import SimpleNamespace
from xml.etree import ElementTree

import pytest
from reliability import as_text, brier, diagram, reliability
from score import Outcome, summary

TOLD = [(1.0, True), (0.9, True), (0.92, False), (0.6, True), (0.6, False), (0.3, False)]


def test_the_brier_score_is_the_mean_square_of_what_was_off():
    # 0 + 0.01 + 0.8464 + 0.16 + 0.36 + 0.09 = 1.4664
    assert brier(TOLD) == pytest.approx(1.4664 / 6)
    assert brier([(1.0, True), (0.0, False)]) == 0.0
    assert brier([(0.5, True), (0.5, False)]) == 0.25
    assert brier([]) is None


def test_a_bin_has_its_lower_edge_and_the_last_one_both():
    found = reliability(TOLD, edges=(0.0, 0.5, 0.9, 0.95, 1.0))
    assert [(one.low, one.high, one.right, one.count) for one in found] == [
        (0.0, 0.5, 0, 1),
        (0.5, 0.9, 1, 2),
        (0.9, 0.95, 1, 2),
        (0.95, 1.0, 1, 1),
    ]
    assert [one.told for one in found] == pytest.approx([0.3, 0.6, 0.91, 1.0])
    assert [one.share for one in found] == [0.0, 0.5, 0.5, 1.0]


def test_the_interval_of_a_share_is_that_of_clopper_and_pearson():
    """In closed form where all are right, 0.025^(1/n), and where none is."""
    (all_right,) = reliability([(1.0, True)] * 9)
    assert all_right.interval == pytest.approx((0.025 ** (1 / 9), 1.0))
    (none_right,) = reliability([(1.0, False)] * 4)
    assert none_right.interval == pytest.approx((0.0, 1.0 - 0.025 ** (1 / 4)))


@pytest.mark.parametrize("wrong", [-0.01, 1.2, float("nan")])
def test_what_is_no_probability_is_refused(wrong):
    with pytest.raises(ValueError, match="probability: expected 0 to 1, got"):
        reliability([(0.5, True), (wrong, True)])


def test_the_diagram_has_a_point_and_an_interval_for_every_bin():
    bins = reliability(TOLD)
    lines = [line.get("points") for line in ElementTree.fromstring(diagram(bins)).iter() if line.tag.endswith("line")]
    diagonal, *whiskers, shares = [[tuple(map(float, at.split(","))) for at in one.split()] for one in lines]
    assert len(whiskers) == len(shares) == len(bins) == 4
    (left, bottom), (right, top) = diagonal
    for one, (x, y), ends in zip(bins, shares, whiskers, strict=True):
        assert (x - left) / (right - left) == pytest.approx(one.told, abs=2e-3)
        assert (bottom - y) / (bottom - top) == pytest.approx(one.share, abs=2e-3)
        assert [(bottom - end) / (bottom - top) for _, end in ends] == pytest.approx(one.interval, abs=2e-3)
    assert len(as_text(bins).splitlines()) == 1 + len(bins)
    assert "6 names" in diagram(bins) and "0 names" in diagram([])


def case(hidden, verdict, *causes, scenario="sines", run="first"):
    """A case with hidden kinds of twice the noise in a ``run``, and what was said of it; `last` is held out."""
    effects = [SimpleNamespace(kind=kind, form="", strength=2.0, strength_left=2.0, rms={run: 2.0}) for kind in hidden]
    truth = SimpleNamespace(effects=effects, noise_rms={})
    said = [
        {
            "cause": word,
            "probability": probability,
            "indistinguishable_from": [],
            "gain": None,
            "accepted": True,
            "expected_gain": None,
        }
        for word, probability in causes
    ]
    rmse = {"after": {"held_out": None}}
    told = {"verdict": verdict, "causes": said, "rmse": rmse, "held_out": ["last"]}
    return Outcome(1, "spring", truth, told, 1.0, scenario=scenario)


def test_where_no_law_fits_unexplained_is_right_and_names_are_not():
    silent = case(["no_law"], "unexplained")
    stacked = case(["no_law"], "partly_explained", ("friction", 0.95), ("relaxation", 0.9))
    sure = case(["no_law"], "explained", ("friction", 0.95))
    assert silent.right and silent.exact and not silent.confidently_wrong
    assert not stacked.right and not stacked.exact and not stacked.confidently_wrong
    assert not sure.right and sure.confidently_wrong
    assert not case(["no_law"], "nothing_missing").right


def test_a_fault_that_only_a_held_out_run_has_is_not_to_be_named():
    assert case(["gain"], "nothing_missing", run="last").right
    assert not case(["gain"], "explained", ("gain", 1.0), run="last").right
    assert not case(["gain"], "nothing_missing").right


def test_the_summary_counts_names_by_design_and_scores_their_probabilities():
    found = summary(
        [
            case(["friction"], "explained", ("friction", 1.0), ("hum", 0.9)),
            case(["friction"], "explained", ("friction", 0.8)),
            case([], "nothing_missing", scenario="random"),
        ]
    )
    assert found["brier"] == pytest.approx((0.0 + 0.81 + 0.04) / 3)
    assert found["sure_right"] == [1, 2]
    sines, random = found["by_design"]["sines"], found["by_design"]["random"]
    assert (sines["right"], sines["exact"], sines["names"], sines["surplus"]) == ([2, 2], [1, 2], 3, 1)
    assert (random["right"], random["names"], random["brier"]) == ([1, 1], 0, None)
