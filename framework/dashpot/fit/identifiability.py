"""What data can tell about numbers, from their Fisher information, in words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.noise_spectrum import NoiseSpectrum
from dashpot.fit.coordinates import Coordinates
from dashpot.fit.decided import decide, doubt_of
from dashpot.fit.linear import linearise
from dashpot.fit.noise_of_runs import variance_of
from dashpot.fit.objective import Objective
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]

WEAK, LOST = 0.1, 1.0  # standard deviation in natural steps: of 10 %, of a factor of e
NOTHING = 3.0  # standard deviation from which nothing is known but what other numbers leave over
FELT = 1e-9
SMALLEST = 1e-13  # of the largest eigenvalue of J J': what is smaller is not told from nothing
SHARE = 0.35  # of the largest part of a direction, from which a part is named
WEAKER = 0.05  # the same for two branches that do the same: in logarithms the stronger one changes less
NAMED, SHOWN = 4, 6


@dataclass(frozen=True)
class Direction:
    """Numbers that can make up for one another: ``parts`` are (path, share), the largest first; all squares add to 1.

    ``deviation`` is the standard deviation along the direction, in natural steps: 0.1 is about 10 %.
    """

    deviation: float
    parts: tuple[tuple[str, float], ...]

    @property
    def lost(self) -> bool:
        """Whether the data do not tell anything about the direction."""
        return not self.deviation < LOST

    @property
    def named(self) -> list[str]:
        """The parameters that have a part in it worth naming."""
        return self.above(SHARE)

    def above(self, least: float) -> list[str]:
        """The parameters whose part is at least this share of the largest one."""
        return [path for path, share in self.parts if abs(share) >= least * abs(self.parts[0][1])]

    @property
    def words(self) -> str:
        """The direction in a sentence."""
        largest = abs(self.parts[0][1])
        named = self.parts[: len(self.named)]
        known = f"known to {_percent(self.deviation * largest)}" if self.deviation < NOTHING else "otherwise unknown"
        if len(named) == 1:
            how = f"weakly determined, {known}" if not self.lost else "not determined"
            return f"{number_in_words(named[0][0])} is {how}"
        shown = named[:NAMED]
        sign = np.sign(shown[0][1])
        moves = ", ".join(f"{10.0 * sign * share / largest:+.2g} %" for _, share in shown)
        more = f" (and {len(named) - NAMED} more)" if len(named) > NAMED else ""
        names = " and ".join(number_in_words(path) for path, _ in shown)
        return f"{names}{more} trade off: {moves} together hardly change the force; {known}"


@dataclass(frozen=True)
class Identifiability:
    """``condition`` of the Fisher information in natural steps; ``deviations`` (path -> standard deviation, natural
    steps); ``loose`` directions, the worst first; ``idle`` numbers, which the data do not feel; ``unsolved`` numbers,
    around which the network is not solved."""

    condition: float
    deviations: dict[str, float]
    loose: tuple[Direction, ...]
    idle: tuple[str, ...]
    unsolved: tuple[str, ...] = ()

    @property
    def undetermined(self) -> list[str]:
        """The parameters of which the data do not even tell the order of magnitude."""
        lost = [path for path, deviation in self.deviations.items() if not deviation < LOST]
        return [*self.unsolved, *self.idle, *lost]

    @property
    def sentences(self) -> list[str]:
        """Everything that is not well known, in words."""
        idle = [
            f"{number_in_words(path)} could not be moved: the network is not solved around its value"
            for path in self.unsolved
        ]
        idle += [f"{number_in_words(path)} has no influence on these data" for path in self.idle]
        more = len(self.loose) - SHOWN
        rest = [f"{more} more combinations are weakly determined"] if more > 0 else []
        return idle + [direction.words for direction in self.loose[:SHOWN]] + rest

    @property
    def firm(self) -> list[str]:
        """The parameters that are known to better than 10 % each."""
        return [path for path, deviation in self.deviations.items() if deviation < WEAK]


def identifiability(
    objective: Objective, coordinates: Coordinates, point: Array, noise: Mapping[str, NoiseSpectrum]
) -> Identifiability:
    """How well a fit of this objective determines the parameters at a point (p,), with this ``noise`` by run.

    The information is the inverse of the covariance of the weighted least-squares estimate, W J N J' W with W the
    inverse of J J' and N the covariance of the noise, whose colour counts; for white noise that is Fisher's.
    ``objective`` may weigh runs but not whiten them.
    """
    linear = linearise(objective, coordinates, point)
    unsolved, size = linear.unsolved, np.sqrt(np.diag(linear.normal))
    idle = ~unsolved & (size < FELT * max(size.max(initial=0.0), 1e-300))
    felt = np.flatnonzero(~idle & ~unsolved)
    paths = [coordinates.paths[k] for k in felt]
    idle_paths, unsolved_paths = (tuple(np.array(coordinates.paths)[which].tolist()) for which in (idle, unsolved))
    if not felt.size:
        return Identifiability(1.0, {}, (), idle_paths, unsolved_paths)
    scaled, doubt = (
        products[np.ix_(felt, felt)] / np.outer(size[felt], size[felt])
        for products in (linear.normal, doubt_of(linear, coordinates, point))
    )
    lengths, axes = np.linalg.eigh(scaled)
    decided, others = decide(lengths, axes, doubt, SMALLEST)
    short, axes[:, ~decided] = ~decided, others
    root = axes / np.sqrt(np.where(short, SMALLEST * lengths[-1], lengths)) / size[felt, None]

    def score(number: int, rows: Array) -> Array:
        own = noise[objective.runs[number].name]
        return objective.factor(number) ** 2 * variance_of(root.T @ rows[1:][felt], own)

    scores = sum(linear.each(score), np.zeros(axes.shape))
    # what is not told from nothing is known no better than the worst of what is
    scores[short], scores[:, short] = 0.0, 0.0
    scores[short, short] = np.diag(scores).max()
    covariance = root @ scores @ root.T
    values, vectors = np.linalg.eigh(0.5 * (covariance + covariance.T))
    values, vectors = np.maximum(values[::-1], 1e-15 * values[-1]), vectors[:, ::-1]
    loose = [_direction(paths, vector, value) for value, vector in zip(values, vectors.T, strict=True)]
    return Identifiability(
        float(values[0] / values[-1]),
        dict(zip(paths, np.sqrt(np.diag(covariance)).tolist(), strict=True)),
        tuple(direction for direction in loose if direction.deviation > WEAK),
        idle_paths,
        unsolved_paths,
    )


def may_go(spec: NetworkSpec, known: Identifiability, spare: Sequence[str] = ()) -> list[str]:
    """What a network could do without on these data, in sentences.

    Idle branches, two that do the same, as one would, and those that are ``spare``, which may go together.
    """
    searched: dict[str, list[str]] = {}
    for slot in spec.slots():
        if slot.value.searched:
            searched.setdefault(_branch_of(slot.path), []).append(slot.path)
    laws = {branch.name: branch.element.word for branch in spec.leaves()}
    idle = [name for name, paths in searched.items() if name in laws and set(paths) <= set(known.idle)]
    lost = dict.fromkeys(tuple(sorted(set(map(_branch_of, each.above(WEAKER))))) for each in known.loose if each.lost)
    alike = [pair for pair in lost if len({laws.get(name, name) for name in pair}) == 1]
    twins = [pair for pair in alike if len(pair) == 2 and not set(pair) <= set(spare)]
    told = {*idle, *(name for pair in twins for name in pair)}
    rest = [name for name in spare if name not in told]
    them = "it" if len(rest) == 1 else "them"
    without = f"without {them}, all else refitted, these data are explained as well"
    return [
        *(f"{name} has no influence on these data and may go" for name in idle),
        *(f"{' and '.join(pair)} do the same to these data: one in their place would do" for pair in twins),
        *([f"{' and '.join(rest)} may go: {without}"] if rest else []),
    ]


def _branch_of(path: str) -> str:
    return path.partition("[")[0].rpartition(".")[0]


def number_in_words(path: str) -> str:
    """`maxwell_1.relaxation_time` as `relaxation time of maxwell_1`."""
    branch, _, key = path.rpartition(".")
    return f"{key.replace('_', ' ')} of {branch}" if branch else path


def _direction(paths: list[str], vector: Array, value: float) -> Direction:
    order = np.argsort(-np.abs(vector), kind="stable")
    return Direction(float(np.sqrt(value)), tuple((paths[k], float(vector[k])) for k in order))


def _percent(deviation: float) -> str:
    return f"+-{100.0 * deviation:.2g} %" if deviation < 0.5 else f"a factor of {np.exp(min(deviation, 40.0)):.2g}"
