"""An element alone in a network, with random numbers of the size that matters for a random motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.model.element import Curve, Element, Parameter
from dashpot.model.network import Branch, Characteristic, Form, Group, NetworkSpec, Value
from dashpot.text.quantity import dimensions

Array = NDArray[np.float64]

NAME = "specimen"
SPREAD = 1.0  # decades around the natural size
KNOTS = np.array([-2.5, -1.2, -0.5, 0.0, 0.4, 1.1, 2.0])
BEND = 0.05
FORMS: tuple[Form, ...] = ("constant", "polynomial", "table")


@dataclass(frozen=True)
class Sizes:
    """A force (N), a length (m) and a time (s): together the natural size of every quantity."""

    force: float
    length: float
    time: float

    def of(self, unit: str) -> float:
        """The natural size of a quantity in a unit."""
        force, length, time = dimensions(unit)
        return self.force**force * self.length**length * self.time**time


@dataclass(frozen=True, eq=False)
class Specimen:
    """An element alone; ``values`` (lanes, slots) in SI, in the order of ``spec.slots()``; ``form`` in words."""

    form: str
    spec: NetworkSpec
    values: Array

    @property
    def branch(self) -> Branch:
        """The only branch."""
        return self.spec.leaves()[0]

    @property
    def numbers(self) -> dict[str, Array]:
        """The values (lanes,) of every slot by path."""
        return {slot.path: column for slot, column in zip(self.spec.slots(), self.values.T, strict=True)}


def draw_sizes(rng: np.random.Generator) -> Sizes:
    """Forces of 10 N to 10 kN, lengths of 0.1 to 10 mm, times that belong to 1 to 25 Hz."""
    force, length = 10.0 ** rng.uniform(1.0, 4.0), 10.0 ** rng.uniform(-4.0, -2.0)
    return Sizes(float(force), float(length), float(1.0 / (2.0 * np.pi * rng.uniform(1.0, 25.0))))


def draw_specimens(element: type[Element], rng: np.random.Generator, sizes: Sizes, lanes: int = 8) -> list[Specimen]:
    """The element in every form a file may give it: each form of its curves, and with its defaults left out."""
    declared = element.declares
    defaults = {key for key, parameter in declared.parameters.items() if parameter.default is not None}
    found = [_draw(element, rng, sizes, lanes, form, set()) for form in (FORMS if declared.curves else FORMS[:1])]
    if defaults:
        found.append(_draw(element, rng, sizes, lanes, FORMS[0], defaults))
    return found


def specimen_of(element: type[Element], columns: Mapping[str, Array], curves: Mapping[str, Characteristic]) -> Specimen:
    """The specimen with values (lanes,) by path without the name of the branch, e.g. ``stiffness[2]``."""
    values = {
        key: Value(float(columns[key][0]), law.unit, scale=law.scale)
        for key, law in element.declares.parameters.items()
        if key in columns
    }
    branch = Branch(NAME, element, values, curves, family=NAME)
    spec = NetworkSpec(element.word, Group("", "parallel", (branch,)))
    lanes = [columns[slot.path.removeprefix(f"{NAME}.")] for slot in spec.slots()]
    size = len(next(iter(columns.values()), [0.0]))
    return Specimen("", spec, np.array(lanes).reshape(-1, size).T)


def _draw(
    element: type[Element], rng: np.random.Generator, sizes: Sizes, lanes: int, form: Form, left_out: set[str]
) -> Specimen:
    columns: dict[str, Array] = {}
    curves: dict[str, Characteristic] = {}
    for key, parameter in element.declares.parameters.items():
        if key not in left_out:
            columns[key] = draw_parameter(parameter, rng, sizes, lanes)
    for key, curve in element.declares.curves.items():
        curves[key], numbers = _draw_curve(curve, rng, sizes, lanes, form)
        columns |= {key + suffix: column for suffix, column in numbers}
    words = [f"{key} as {form}" for key in curves] + [f"without {key}" for key in sorted(left_out)]
    return replace(specimen_of(element, columns, curves), form=", ".join(words) or "all parameters given")


def draw_parameter(parameter: Parameter, rng: np.random.Generator, sizes: Sizes, lanes: int) -> Array:
    """Values (lanes,) inside the bounds of a parameter, around its natural size."""
    low, high = parameter.bounds
    if dimensions(parameter.unit) == (0.0, 0.0, 0.0):
        return _draw_number(parameter, rng, lanes)
    size = sizes.of(parameter.unit)
    if parameter.scale == "linear":
        return np.clip(size * rng.uniform(-1.0 if low < 0.0 else 0.0, 1.0, lanes), low, high)
    return np.clip(size * 10.0 ** rng.uniform(-SPREAD, SPREAD, lanes), low, high)


def _draw_number(parameter: Parameter, rng: np.random.Generator, lanes: int) -> Array:
    low, high = np.clip(parameter.bounds, -1e3, 1e3)
    if parameter.scale == "log":
        return np.exp(rng.uniform(np.log(max(low, 1e-3)), np.log(high), lanes))
    # laws often change their form at whole and half numbers
    neat = [value for value in (low, 0.0, 0.5, 1.0, 1.5, 2.0) if low <= value <= high]
    return np.where(rng.random(lanes) < 0.5, rng.choice(neat, lanes), rng.uniform(low, high, lanes))


def _draw_curve(
    curve: Curve,
    rng: np.random.Generator,
    sizes: Sizes,
    lanes: int,
    form: Form,
) -> tuple[Characteristic, list[tuple[str, Array]]]:
    over = sizes.of(curve.over[1])
    slope = Parameter(curve.slope_unit, curve.about, curve.bounds)
    steepness = draw_parameter(slope, rng, sizes, lanes)
    at = tuple(float(x) for x in KNOTS * over) if form == "table" else ()
    if form == "constant":
        columns = [("", steepness)]
    elif form == "polynomial":
        bends = [BEND * steepness * rng.uniform(-1.0, 1.0, lanes) / over, BEND * steepness / over**2]
        columns = [(f"[{k}]", column) for k, column in enumerate([steepness, *bends])]
    else:
        columns = [(f"[{k}]", column) for k, column in enumerate(_rising(steepness, np.array(at), rng))]
    numbers = enumerate(column for _, column in columns)
    values = tuple(Value(float(column[0]), _unit(curve, form, k), scale="linear") for k, column in numbers)
    return Characteristic(curve, form, values, at), columns


def _rising(steepness: Array, at: Array, rng: np.random.Generator) -> Iterator[Array]:
    # through zero at zero, as an unloaded specimen has no force
    rise = steepness * np.diff(at)[:, None] * 10.0 ** rng.uniform(-0.5, 0.5, (at.size - 1, steepness.size))
    heights = np.concatenate([np.zeros((1, steepness.size)), np.cumsum(rise, axis=0)])
    yield from heights - heights[np.flatnonzero(at == 0.0)[0]]


def _unit(curve: Curve, form: Form, number: int) -> str:
    if form == "table":
        return curve.value[1]
    return curve.coefficient_unit(number + 1)


def scaled(specimen: Specimen, sizes: Sizes) -> Specimen:
    """The specimen with every number multiplied by the size of its unit: the same one in other units."""
    slots = specimen.spec.slots()
    factors = np.array([sizes.of(slot.value.unit) for slot in slots])
    spec = specimen.spec
    for path, curve in spec.curves().items():
        at = tuple(x * sizes.of(curve.curve.over[1]) for x in curve.at)
        spec = spec.with_curve(path, replace(curve, at=at))
    return replace(specimen, spec=spec, values=specimen.values * factors)
