"""A start that no luck is needed for: branches of many shapes, of which the data take what they need.

The force of a branch is proportional to those of its numbers that hold a force; what one more number decides is its
shape: a relaxation time, or the way after which friction slips. A dictionary of branches with shapes from the shortest
to the longest is linear in their strengths, so that these follow at once, none of them negative (variable projection:
Golub and Pereyra, SIAM J. Numer. Anal. 10 (1973) 413). Neighbours are merged until as many are left as the network has
branches.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import Sizes, natural_sizes
from dashpot.kernel.network import CompiledNetwork
from dashpot.kernel.parts import Part
from dashpot.text.quantity import dimensions

Array = NDArray[np.float64]

SHAPES = 16
SHORTEST, FARTHEST = 1e-3, 3.0  # ways, in parts of the shortest and the longest stroke
RIDGE = 1e-10


@dataclass(frozen=True, eq=False)
class Start:
    """A point (p,) in coordinates and how many parameter vectors it took."""

    point: Array
    evaluations: int


def dictionary_start(objective: Objective, coordinates: Coordinates) -> Start | None:
    """Where to begin.

    None for a network that is no sum of branches, whose runs give some of its numbers, whose load cell alters the
    force, none of whose searched numbers are proportional to a force, or with a branch whose force is not finite.
    """
    network = objective.network
    if not isinstance(network, CompiledNetwork) or any(slot.value.setting for slot in network.spec.slots()):
        return None
    if not network.observation(network.start).plain:
        return None
    searched = set(coordinates.which.tolist())
    sizes = natural_sizes(objective.runs)
    kinds = [
        kind
        for number, part in enumerate(objective.parts.members)
        for kind in _kinds(number, part, network.start, searched, sizes)
    ]
    strengths = _strengths(objective, kinds) if any(kind.forces for kind in kinds) else None
    if strengths is None:
        return None
    values = network.start.copy()
    for kind, strength in zip(kinds, strengths, strict=True):
        kind.take(values, strength)
    count = sum(len(kind.lanes) for kind in kinds if kind.forces)
    return Start(coordinates.allowed(coordinates.of_values(values))[0], count)


@dataclass(frozen=True, eq=False)
class _Kind:
    """Branches of one structure: ``member`` is its number, ``slots`` are those of each branch in the network, ``lanes``
    the dictionary's parameters of such a branch.

    ``forces`` are the parameters proportional to the force, none where they are known; ``shape`` is that on the grid.
    """

    member: int
    slots: Sequence[Sequence[int]]
    lanes: Array
    forces: tuple[int, ...]
    shape: int | None

    def take(self, values: Array, strength: Array) -> None:
        """Give the branches (slots,) the strengths (lanes,) that were found; they stay as they are if there is none."""
        if not self.forces or not strength.any():
            return
        rows = self.lanes.copy()
        rows[:, self.forces] *= strength[:, None]
        order = np.argsort([self._length(values[list(slots)]) for slots in self.slots])
        for row, branch in zip(self._merged(rows), order, strict=True):
            chosen = list(self.forces) if self.shape is None else sorted({*self.forces, self.shape})
            values[np.array(self.slots[branch])[chosen]] = row[chosen]

    def _merged(self, rows: Array) -> Array:
        # Ward's method along the grid; a branch too many is half of the strongest one
        first = self.forces[0]
        found = [row for row in rows if row[first] > 0.0]
        while len(found) > len(self.slots):
            at = int(np.argmin([self._apart(*pair) for pair in zip(found, found[1:], strict=False)]))
            found[at : at + 2] = [self._sum(found[at], found[at + 1])]
        while len(found) < len(self.slots):
            at = int(np.argmax([row[first] for row in found]))
            half = found[at].copy()
            half[list(self.forces)] /= 2.0
            found[at : at + 1] = [half, half.copy()]
        return np.array(found)

    def _length(self, row: Array) -> float:
        if self.shape is None:
            return 0.0
        return float(np.log(row[self.shape] / (row[self.forces[0]] if self.shape in self.forces else 1.0)))

    def _apart(self, one: Array, other: Array) -> float:
        first = self.forces[0]
        weight = one[first] * other[first] / (one[first] + other[first])
        return weight * (self._length(one) - self._length(other)) ** 2

    def _sum(self, one: Array, other: Array) -> Array:
        total, first = one.copy(), self.forces[0]
        total[list(self.forces)] += other[list(self.forces)]
        if self.shape is not None:
            share = one[first] / total[first]
            length = np.exp(share * self._length(one) + (1.0 - share) * self._length(other))
            total[self.shape] = length * (total[first] if self.shape in self.forces else 1.0)
        return total


def _kinds(member: int, part: Part, start: Array, searched: set[int], sizes: Sizes) -> Iterator[_Kind]:
    # branches of which other numbers are searched are of another kind
    # what a number does over a setting is left to the search
    powers = [(0.0, 0.0, 0.0) if slot.of else dimensions(slot.value.unit) for slot in part.network.spec.slots()]
    forces = tuple(number for number, power in enumerate(powers) if power[0] == 1.0)
    alike: dict[tuple[int, ...], list[Sequence[int]]] = {}
    for slots in part.slots:
        alike.setdefault(tuple(number for number, slot in enumerate(slots) if slot in searched), []).append(slots)
    for free, branches in alike.items():
        lanes = np.array([start[list(slots)] for slots in branches])
        if not forces or not set(forces) <= set(free) or np.any(lanes[:, forces] <= 0.0):
            yield _Kind(member, branches, lanes, (), None)
            continue
        shapes = [number for number in free if number != forces[0]]
        grid = _shapes(powers, forces, shapes, sizes)
        if grid is None:
            yield _Kind(member, branches, lanes[:1], forces, None)
        else:
            lanes = np.repeat(lanes[:1], SHAPES, axis=0)
            lanes[:, shapes[0]] = grid * (lanes[:, forces[0]] if shapes[0] in forces else 1.0)
            yield _Kind(member, branches, lanes, forces, shapes[0])


def _shapes(
    powers: Sequence[tuple[float, float, float]], forces: Sequence[int], shapes: Sequence[int], sizes: Sizes
) -> Array | None:
    # a force over a stiffness is a way
    if len(shapes) != 1:
        return None
    return _grid(np.subtract(powers[shapes[0]], powers[forces[0]] if shapes[0] in forces else 0.0), sizes)


def _grid(powers: Array, sizes: Sizes) -> Array | None:
    # times and ways that the runs can feel
    lengths = [size.length for size in sizes.runs]
    if tuple(powers) == (0.0, 0.0, 1.0):
        return np.geomspace(2.0 * sizes.shortest, sizes.longest, SHAPES)
    if tuple(powers) == (0.0, 1.0, 0.0) and lengths:
        return np.geomspace(SHORTEST * min(lengths), FARTHEST * max(lengths), SHAPES)
    return None


def _strengths(objective: Objective, kinds: Sequence[_Kind]) -> list[Array] | None:
    # from the normal equations, run after run; None where a force is not finite
    from scipy.linalg import cholesky, solve_triangular
    from scipy.optimize import nnls

    loose = np.concatenate([np.full(len(kind.lanes), bool(kind.forces)) for kind in kinds])
    normal, right = np.zeros((loose.size, loose.size)), np.zeros(loose.size)
    members = objective.parts.members
    for number, run in enumerate(objective.runs):
        each = [(members[kind.member].network, kind.lanes) for kind in kinds]
        forces = np.concatenate(
            [network.simulate(objective.rows_of(network, number), lanes) for network, lanes in each]
        )[:, run.first :] * objective.factor(number)
        target = run.force[run.first :] * objective.factor(number) - forces[~loose].sum(axis=0)
        normal += forces @ forces.T
        right += forces @ target
    if not (np.isfinite(normal).all() and np.isfinite(right).all()):
        return None
    scale = np.sqrt(np.diag(normal)[loose])
    scale[scale == 0.0] = 1.0  # a branch without influence
    matrix = normal[np.ix_(loose, loose)] / np.outer(scale, scale) + RIDGE * np.eye(scale.size)
    upper = cholesky(matrix)
    found = np.zeros(loose.size)
    found[loose] = nnls(upper, solve_triangular(upper, right[loose] / scale, trans="T"))[0] / scale
    return np.split(found, np.cumsum([len(kind.lanes) for kind in kinds])[:-1])
