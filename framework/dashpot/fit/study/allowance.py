"""What a part that was identified by itself brings along: the error of its force, which the whole cannot tell."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.api import Setting
from dashpot.fit.coordinates import Coordinates
from dashpot.fit.known import KnownNumber
from dashpot.fit.result import Errors
from dashpot.model.network import NetworkSpec
from dashpot.text.quantity import force_dimension

Array = NDArray[np.float64]

LEAST_SHARE = 1e-3


@dataclass(frozen=True, eq=False)
class Allowance:
    """The relative standard error ``share`` of the force of a ``branch``, identified as a ``model``.

    ``step`` (slots,) moves the parameters of the whole by one standard error of that force.
    """

    branch: str
    model: str
    share: float
    step: Array


@dataclass(frozen=True)
class Owed:
    """What one standard error of a part, ``share`` of its force, does to the ``numbers`` (SI, by path) of the whole."""

    branch: str
    model: str
    share: float
    numbers: Mapping[str, float]


@dataclass(frozen=True)
class OwedToKnown:
    """What one standard error of a known number, of ``interval`` (SI), does to the ``numbers`` (SI, by path)."""

    path: str
    unit: str
    interval: tuple[float, float]
    numbers: Mapping[str, float]

    @classmethod
    def of(cls, known: KnownNumber, numbers: Mapping[str, float]) -> OwedToKnown:
        """What the parameters owe to one that is known."""
        assert known.value.interval is not None
        return cls(known.path, known.value.unit, known.value.interval, numbers)


def allowance(spec: NetworkSpec, branch: str, model: str, share: float) -> Allowance:
    """The allowance for the force of a branch of a network, at the parameters of its file."""
    start, slots = np.array([slot.value.number for slot in spec.slots()]), force_slots(spec, branch)
    step = np.zeros_like(start)
    step[slots] = share * start[slots]
    return Allowance(branch, model, share, step)


def force_slots(spec: NetworkSpec, branch: str) -> list[int]:
    """The parameters of a branch that are proportional to its force: moved alike, they move the force alike."""
    return [
        number
        for number, slot in enumerate(spec.slots())
        if slot.path.startswith(f"{branch}.") and force_dimension(slot.value.unit) == 1
    ]


def force_error(*judged: tuple[Errors, Setting]) -> float:
    """The share by which the force of a part may be wrong: the largest misfit above noise, over how much forces vary.

    Judged are the part where it was identified and the whole, whose misfit may as well be one of the part: it is moved
    otherwise there. It is never below what load cells disagree by from one rig to another.
    """
    return max(LEAST_SHARE, *(_misfit_share(errors, setting) for errors, setting in judged))


def _misfit_share(errors: Errors, setting: Setting) -> float:
    misfit = max(errors.train**2 - (setting.floor.value or 0.0) ** 2, 0.0)
    return float(np.sqrt(misfit) / setting.swing) if setting.swing > 0.0 else 0.0


def effect(coordinates: Coordinates, moved: Array) -> dict[str, float]:
    """A movement (p,) in natural steps of the coordinates, from their start, in SI by path; it ends at the bounds."""
    start = coordinates.start
    end = np.clip(start + moved * coordinates.unit, coordinates.low, coordinates.high)
    before, after = coordinates.numbers(start), coordinates.numbers(end)
    return {path: there - here for path, here, there in zip(coordinates.paths, before, after, strict=True)}
