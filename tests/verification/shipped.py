"""The shipped networks with random numbers, ready to be simulated."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from dashpot import load_registry
from dashpot.model.network import Characteristic, NetworkSpec, Value
from dashpot.model.reading import read_network
from dashpot.model.shipped import shipped_networks
from dashpot.model.topology import topology_of

INTEGRATED = {"spring", "damper", "maxwell", "dahl", "prandtl", "hydro"}


def _between_two_ends(name: str) -> bool:
    spec = read_network(name, load_registry().elements)
    return topology_of(spec).parallel and {branch.element.word for branch in spec.leaves()} <= INTEGRATED


NAMES = tuple(filter(_between_two_ends, shipped_networks()))
KNOTS = np.linspace(8e-3, 24e-3, 9)


@dataclass
class Dice:
    """Random numbers near those of the files: equal numbers of equal laws become equal again."""

    seed: int

    def __post_init__(self) -> None:
        self.rng = np.random.default_rng(self.seed)
        self.known: dict[tuple[str, str, float], float] = {}

    def number(self, word: str, key: str, start: float) -> float:
        """The number that takes the place of a start value."""
        return self.known.setdefault((word, key, start), start * float(np.exp(self.rng.uniform(-0.5, 0.5))))


def filled(name: str, dice: Dice) -> NetworkSpec:
    """A shipped network with random numbers, and a random rising table for the curve of its spring."""
    spec = read_network(name, load_registry().elements)
    words = {branch.name: branch.element.word for branch in spec.leaves()}
    tables = {
        path: curve
        for path, curve in spec.curves().items()
        if curve.form == "table" and words[path.rpartition(".")[0]] == "spring"
    }
    tables |= spec.data_curves()
    for path, curve in tables.items():
        spec = spec.with_curve(path, stiffness_table(curve, dice))
    numbers = {}
    for slot in spec.slots():
        name, _, key = slot.path.rpartition(".")
        if slot.path.partition("[")[0] not in tables:
            numbers[slot.path] = replace(slot.value, number=dice.number(words[name], key, slot.value.number))
    return spec.with_values(numbers)


def stiffness_table(curve: Characteristic, dice: Dice) -> Characteristic:
    """A table from 1.5 to 4 kN or so over 8 to 24 mm: motions beyond its ends meet its straight continuations."""
    slopes = [dice.number("table", str(at), 2e5) for at in KNOTS[1:]]
    force = 1.5e3 + np.concatenate([[0.0], np.cumsum(slopes * np.diff(KNOTS))])
    values = tuple(Value(float(value), "N", "identified", scale="linear") for value in force)
    return replace(curve, form="table", values=values, at=tuple(map(float, KNOTS)))
