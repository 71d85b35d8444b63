"""Who does not belong to the others: told apart from who does, and in which way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of

from dashpot.campaign.named import NAMED, named_by_numbers
from dashpot.campaign.numbers import Numbers
from dashpot.campaign.unlike import BOTH, FORCE, TRAVEL, detectable, unlike

SIZES = np.array([0.04, 0.06, 0.05])
PATHS = ("rubber.stiffness", "rubber.damping", "friction.limit")
UNITS = ("N/m", "N*s/m", "N")


def population(seed: int, count: int = 40, units: tuple[str, ...] = UNITS) -> Numbers:
    """Sound specimens whose logarithms scatter by SIZES about a mean that depends on a property."""
    rng = np.random.default_rng(seed)
    design = np.column_stack([np.ones(count), np.linspace(-1.0, 1.0, count)])
    errors = np.array([np.diag(rng.uniform(0.002, 0.02, 3) ** 2) for _ in range(count)])
    at = design @ np.array([[12.0, 6.0, 3.0], [-0.1, 0.1, 0.0]]) + rng.normal(size=(count, 3)) * SIZES
    at += np.array([rng.multivariate_normal(np.zeros(3), each) for each in errors])
    return Numbers(tuple(f"s{k}" for k in range(count)), PATHS, units, np.ones(3, dtype=bool), at, errors, design)


def uncorrelated(count: int) -> Numbers:
    """Sound specimens whose deviations have a covariance without correlation, and no error to speak of."""
    numbers = population(7, count)
    rest = numbers.at - numbers.design @ np.linalg.lstsq(numbers.design, numbers.at, rcond=None)[0]
    rest[count // 2] = 0.0
    orthogonal = np.linalg.qr(np.column_stack([numbers.design, rest]))[0][:, 2:] * SIZES * np.sqrt(count)
    return replace(numbers, at=orthogonal + [12.0, 6.0, 3.0], errors=np.tile(1e-8 * np.eye(3), (count, 1, 1)))


def test_damaged_specimens_are_named_by_the_number_that_is_wrong():
    numbers = population(1)
    numbers.at[7, 0] += np.log(0.6)
    numbers.at[21, 2] += np.log(2.0)
    named = list(named_by_numbers("m", numbers, unlike(numbers)))
    assert [one.specimen for one in named] == ["s7", "s21"]
    assert named[0].evidence[0].startswith("rubber.stiffness is ") and named[1].evidence[0].startswith("friction.limit")
    assert all(one.kind == "damaged, or of another make" for one in named)


@pytest.mark.parametrize(("moved", "way"), [((1.0, 1.0, 1.0), FORCE), ((-1.0, -1.0, 0.0), TRAVEL)])
def test_a_wrong_gain_is_told_from_damage(moved, way):
    numbers = population(2)
    numbers.at[11] += np.log(1.5) * np.array(moved)
    found = unlike(numbers)
    assert found.outside[11] >= NAMED
    assert found.ways[int(np.argmax(found.probability[11]))] == way


def test_gains_that_no_number_tells_apart_are_one_way():
    numbers = population(3, units=("N/m", "N/m", "s"))
    assert BOTH in unlike(numbers).ways


def test_outliers_do_not_hide_each_other_nor_widen_the_population():
    numbers = population(4)
    numbers.at[[3, 8, 9, 30], 1] += 0.9
    found = unlike(numbers)
    assert list(np.flatnonzero(found.outside >= NAMED)) == [3, 8, 9, 30]
    assert np.sqrt(found.population.between[1, 1]) == pytest.approx(SIZES[1], rel=0.35)


def test_who_is_apart_for_another_reason_does_not_count():
    numbers = population(6, 30)
    rest = population(6, 30)
    kept = np.arange(30) != 4
    rest = replace(
        rest,
        specimens=tuple(name for name in rest.specimens if name != "s4"),
        **{key: getattr(rest, key)[kept] for key in ("at", "errors", "design")},
    )
    numbers.at[4] += 0.08
    found, alone = unlike(numbers, {"s4"}).population, unlike(rest).population
    assert found.means == pytest.approx(alone.means, rel=1e-5)
    assert found.between == pytest.approx(alone.between, rel=1e-3, abs=1e-8)


@pytest.mark.parametrize("count", [14, 40])
def test_a_deviation_that_can_be_detected_is_where_a_specimen_is_named(count):
    # errors alike and no correlation: the specimen in the middle of the design is moved in one number
    def outside(deviations: float) -> float:
        at = numbers.at.copy()
        at[middle, 1] = expected + deviations * size
        return float(unlike(replace(numbers, at=at)).outside[middle])

    numbers, middle = uncorrelated(count), count // 2
    found = unlike(numbers, {f"s{middle}"})
    least = detectable(found, NAMED)
    size = abs(found.shifts[middle, 1] / found.distances[middle, 1])
    expected = numbers.at[middle, 1] - found.shifts[middle, 1]
    assert outside(1.2 * least) > NAMED > outside(0.8 * least)


def test_fewer_specimens_detect_less():
    least = [detectable(unlike(uncorrelated(count)), NAMED) for count in (12, 16, 24, 40)]
    assert sorted(least, reverse=True) == least and least[-1] < 6.0


def test_few_specimens_are_not_doubted():
    numbers = population(5, 7)
    numbers.at[2] += 3.0
    found = unlike(numbers)
    assert not found.outside.any()
    # eight and one for each of mean and slope
    assert (found.tested, found.needed) == (False, 10) and unlike(population(5, 10)).tested


def test_sound_specimens_are_not_named():
    seed = seed_of("sound specimens")
    named = [int((unlike(population(seed + k)).outside >= NAMED).sum()) for k in range(15)]
    # 600 of them, of which one in a thousand at most may seem to be unlike
    assert sum(named) <= 2
