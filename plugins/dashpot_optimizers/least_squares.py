"""Trust-region least squares from one start or several at once."""

from __future__ import annotations

import numpy as np

from dashpot.contract.bridged import Bridged, Evaluate
from dashpot.contract.optimizer import Blocks, Needs, Search, Space
from dashpot.contract.side_by_side import agreement, side_by_side
from dashpot_optimizers.latin_hypercube import scatter
from dashpot_optimizers.option import require
from dashpot_optimizers.surroundings import StartFailed, Surroundings

ENDINGS = {
    0: "the allowed iterations are used up",
    1: "the gradient vanishes",
    2: "the sum of squares no longer falls",
    3: "the point no longer moves",
    4: "the sum of squares no longer falls and the point no longer moves",
}


class LeastSquares(Search):
    """scipy's trust-region reflective method; a step and its finite-difference Jacobian are one block of lanes.

    starts: 1 begins at the start alone. With more, a block of `screen` random points for each start is looked at
    first, and the start and the best of them advance together. step: of the forward differences, in the unit cube;
    tolerance: relative change of the sum of squares, of the point, and relative gradient at which a descent ends;
    iterations: steps of a descent, rejected ones included.

    Branch, Coleman and Li, SIAM J. Sci. Comput. 21 (1999) 1.
    """

    word = "least_squares"
    needs: Needs = "residuals"

    def __init__(
        self, starts: int = 1, screen: int = 4, step: float = 1e-5, tolerance: float = 1e-8, iterations: int = 100
    ):
        require("starts", starts, 1)
        require("screen", screen, 1)
        require("step", step, 1e-9, 1e-2)
        require("tolerance", tolerance, 1e-14, 1e-1)
        require("iterations", iterations, 1)
        self.starts, self.screen = starts, screen
        self.step, self.tolerance, self.iterations = step, tolerance, iterations

    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """Screen, then descend from every start."""
        starts = space.start[None, :]
        if self.starts > 1:
            self.needs = "losses"
            points = scatter(rng, self.screen * self.starts, space.start)
            losses = yield points
            starts = points[choose(losses, self.starts)]
        descents = [Descent(self.step, self.tolerance, self.iterations) for _ in starts]
        spaces = [Space(space.names, start) for start in starts]
        best = yield from side_by_side(self, descents, spaces, [0] * len(descents))
        return summary(descents, best)


def choose(losses: np.ndarray, count: int) -> np.ndarray:
    """Numbers of the points to begin from: the start (0) unless it failed, and the best of the others."""
    order = np.argsort(losses, kind="stable")
    if np.isfinite(losses[0]):
        order = np.concatenate([[0], order[order != 0]])
    return order[np.isfinite(losses[order])][:count]


def summary(descents: list[Descent], best: list[float]) -> str:
    """How the best descent ended and how far the others agree with it."""
    if not descents:
        return "none of the points that were looked at could be evaluated"
    conclusion = descents[int(np.argmin(best))].conclusion
    return f"{agreement(best)}; {conclusion}" if len(best) > 1 else conclusion


class Descent(Bridged):
    """One descent. scipy sees the triangle of [residuals, Jacobian], whose squares are those of the whole."""

    word = "descent"
    needs = "residuals"

    def __init__(self, step: float, tolerance: float, iterations: int):
        self.step, self.tolerance, self.iterations = step, tolerance, iterations

    def minimize(self, evaluate: Evaluate, space: Space, seed: int) -> str:
        """Run scipy from the start of `space`."""
        from scipy.optimize import least_squares

        around = Surroundings(evaluate, self.step)
        try:
            solution = least_squares(
                around.residuals,
                space.start,
                jac=around.jacobian,
                bounds=(0.0, 1.0),
                method="trf",
                x_scale=1.0,
                ftol=self.tolerance,
                xtol=self.tolerance,
                gtol=self.tolerance,
                max_nfev=self.iterations,
            )
        except StartFailed:
            return "the start could not be evaluated"
        return ENDINGS[solution.status]
