"""Facts of the methods that come from libraries, and of starting any method several times."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.contract.optimizer import Space
from dashpot.fit.search import SearchResult, run_search
from dashpot_optimizers.cmaes import CovarianceMatrixAdaptation
from dashpot_optimizers.differential_evolution import DifferentialEvolution
from dashpot_optimizers.multistart import Multistart

SPACE = Space(("a", "b", "c"), np.array([0.5, 0.2, 0.9]))


class Counted:
    """A loss that remembers the number of lanes of every block."""

    def __init__(self, worth):
        self.worth, self.lanes = worth, []

    def __call__(self, points: np.ndarray) -> np.ndarray:
        self.lanes.append(len(points))
        return self.worth(points)


def bowl(points: np.ndarray) -> np.ndarray:
    return 1.0 + np.sum((points - 0.4) ** 2, axis=1)


def run(optimizer, worth, **limits) -> SearchResult:
    return run_search(optimizer, worth, worth, SPACE, 1, **limits)


def test_a_generation_of_differential_evolution_is_one_block() -> None:
    worth = Counted(bowl)
    run(DifferentialEvolution(population=20, generations=6, tolerance=0.0), worth)
    assert worth.lanes == [20] * 6


def test_differential_evolution_ends_when_the_population_agrees() -> None:
    coarse, fine = (run(DifferentialEvolution(tolerance=tolerance), bowl) for tolerance in (1e-2, 1e-6))
    assert coarse.evaluations < fine.evaluations < 96 * 300


def test_cmaes_doubles_the_population_with_every_restart() -> None:
    worth = Counted(bowl)
    result = run(CovarianceMatrixAdaptation(population=8, restarts=2), worth)
    assert sorted(set(worth.lanes[1:])) == [8, 16, 32]
    assert worth.lanes[1:] == sorted(worth.lanes[1:])
    assert result.remark == "3 runs done"


def test_cmaes_adapts_a_diagonal_alone_when_told_so() -> None:
    full, diagonal = (run(CovarianceMatrixAdaptation(separable=choice), bowl) for choice in (False, True))
    assert not np.array_equal(full.best, diagonal.best)
    assert np.allclose(diagonal.best, 0.4, atol=2e-3)


def test_multistart_asks_for_all_starts_in_one_block() -> None:
    worth = Counted(bowl)
    result = run(Multistart(of="pso", starts=3), worth, budget=3000)
    assert worth.lanes[0] == 3 * 96
    assert result.loss == pytest.approx(1.0, abs=1e-4)


def test_multistart_gives_every_start_its_own_chance() -> None:
    first: list[np.ndarray] = []
    run(Multistart(of="pso", starts=2), lambda points: [first.append(points), bowl(points)][1], budget=2 * 96)
    one, other = np.split(first[0], 2)
    assert not np.isin(one[1:], other[1:]).any()


def test_multistart_names_the_nearest_optimizer_when_it_knows_none_of_that_word() -> None:
    with pytest.raises(ValueError, match="No such optimizer 'psso', did you mean 'pso'"):
        run(Multistart(of="psso"), bowl)


@pytest.mark.parametrize(
    ("made", "option", "value"),
    [
        (DifferentialEvolution, "population", 4),
        (DifferentialEvolution, "crossover", 1.5),
        (CovarianceMatrixAdaptation, "population", 3),
        (CovarianceMatrixAdaptation, "sigma", 0.0),
        (Multistart, "starts", 0),
    ],
)
def test_options_out_of_range_are_refused(made: type, option: str, value: float) -> None:
    with pytest.raises(ValueError, match=rf"^{option}: expected .* got {value}"):
        made(**{option: value})
