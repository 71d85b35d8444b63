"""One step is two half steps, where an element claims to be exact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dashpot.kernel.compiler.trace import Sight, trace_branch
from dashpot.kernel.eager import EagerBranch
from dashpot.model.element import Element, Motion
from dashpot.testing.specimen import Sizes, Specimen, draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination

TOLERANCE = 1e-10
STEPS = 50
ADVICE = "Solve the law exactly over the step, or set `exact = False`."


@dataclass(frozen=True)
class _Piece:
    """A cubic path over a step of ``dt``: positions and velocities at its ends."""

    dt: float
    old: float
    new: float
    velocity_old: float
    velocity_new: float

    def halves(self) -> tuple[_Piece, _Piece]:
        """The same path in two pieces."""
        bow = (self.new - self.old) / self.dt - 0.5 * (self.velocity_old + self.velocity_new)
        middle = 0.5 * (self.old + self.new) + self.dt * (self.velocity_old - self.velocity_new) / 8.0
        velocity = 0.5 * (self.velocity_old + self.velocity_new) + 1.5 * bow
        half = 0.5 * self.dt
        return (
            _Piece(half, self.old, middle, self.velocity_old, velocity),
            _Piece(half, middle, self.new, velocity, self.velocity_new),
        )

    def seen(self, sight: Sight) -> Motion:
        """The motion as a law of this sight may see it."""
        if sight == "monotone":
            return Motion(self.old, self.new, np.nan, np.nan, np.nan)
        bow = (self.new - self.old) / self.dt - 0.5 * (self.velocity_old + self.velocity_new)
        acceleration = (self.velocity_new - self.velocity_old - 6.0 * bow) / self.dt
        return Motion(self.old, self.new, self.velocity_old, self.velocity_new, acceleration)


def check_halving(element: type[Element], seed: int | None = None) -> None:
    """Force and states after a step agree with those after two half steps on the same path to 1e-10."""
    examination = Examination.begin(element, "halving", seed)
    if not element.exact:
        return
    rng = examination.rng()
    sizes = draw_sizes(rng)
    for specimen in draw_specimens(element, rng, sizes):
        with np.errstate(all="ignore"):
            _walk(examination, specimen, rng, sizes)


def _walk(examination: Examination, specimen: Specimen, rng: np.random.Generator, sizes: Sizes) -> None:
    sight, law = trace_branch(specimen.branch).sight, EagerBranch(specimen.branch, specimen.numbers)
    states = law.rest(specimen.values.shape[0])
    place, scale = 0.0, np.zeros(specimen.values.shape[0])
    for _ in range(STEPS):
        piece = _draw_piece(rng, place, sizes)
        first, second = piece.halves()
        whole = law.respond(piece.seen(sight), states, piece.dt)
        half = law.respond(first.seen(sight), states, first.dt)
        both = law.respond(second.seen(sight), half.states, second.dt)
        scale = np.maximum(scale, np.abs(whole.force))
        error = np.max(np.abs(whole.force - both.force) / np.maximum(scale, np.finfo(float).tiny))
        examination.demand(
            bool(error <= TOLERANCE),
            f"with {specimen.form}, one step and two half steps give forces "
            f"that differ by {error:.1e} of the largest one",
            ADVICE,
        )
        states, place = dict(whole.states), piece.new


def _draw_piece(rng: np.random.Generator, place: float, sizes: Sizes) -> _Piece:
    # with end velocities of 0.3 to 2 times the mean one the cubic does not turn
    new = sizes.length * rng.uniform(-1.0, 1.0)
    dt = sizes.time * 10.0 ** rng.uniform(-2.0, 0.5)
    mean = (new - place) / dt
    return _Piece(dt, place, new, mean * rng.uniform(0.3, 2.0), mean * rng.uniform(0.3, 2.0))
