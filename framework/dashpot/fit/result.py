"""What an identification found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import dashpot
from dashpot.data.dataset import Dataset
from dashpot.data.noise import NoiseFloor
from dashpot.fit.holdout import Split
from dashpot.fit.identifiability import Identifiability, may_go, number_in_words
from dashpot.model.identified import Range
from dashpot.model.network import NetworkSpec, Value
from dashpot.model.patch import fill_numbers
from dashpot.text.quantity import pretty


@dataclass(frozen=True, eq=False)
class Errors:
    """Root mean square errors in N: of the training runs, the held-out ones (None without), all, and each run."""

    train: float
    held_out: float | None
    all: float
    per_run: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class FitResult:
    """A network with fitted numbers and how good it is.

    ``declared`` is the network as its file has it; ``fitted`` has numbers, intervals and tables. ``spread`` holds the
    losses that different starts ended at, best first: near one another they are evidence of convergence. ``known`` says
    the identifiability; ``seen`` is the range of the motions of the training runs. ``correlation`` (p, p)
    is that of the errors of the searched numbers, in the order of their slots and in logarithms where they are searched
    so.
    """

    declared: NetworkSpec
    fitted: NetworkSpec
    errors: Errors
    noise_floor: NoiseFloor
    split: Split
    dataset: Dataset
    optimizer: str
    seed: int
    ending: str
    evaluations: int
    at_bound: tuple[str, ...] = ()
    idle: tuple[str, ...] = ()
    spread: tuple[float, ...] = ()
    history: tuple[tuple[int, float], ...] = field(default=(), repr=False)
    seen: Range = field(default_factory=dict, repr=False)
    correlation: NDArray[np.float64] | None = field(default=None, repr=False)
    known: Identifiability | None = field(default=None, repr=False)

    @property
    def identified_text(self) -> str:
        """The network's text with its numbers filled in."""
        record = {
            "data": self.dataset.digest[:16],
            "optimizer": self.optimizer,
            "seed": str(self.seed),
            "version": dashpot.__version__,
            "rmse": pretty(self.errors.train, "N", 4),
        }
        return fill_numbers(self.declared, self.fitted, record, self.seen)

    def as_dict(self) -> dict[str, Any]:
        """The result in plain values, SI."""
        return {
            "format": "dashpot-fit/1",
            "model": self.declared.name,
            "dataset": {"name": self.dataset.name, "digest": self.dataset.digest},
            "parameters": parameters_of(self.fitted),
            "rmse": {"train": self.errors.train, "held_out": self.errors.held_out, "all": self.errors.all},
            "per_run": dict(self.errors.per_run),
            "noise_floor": floor_of(self.noise_floor),
            "held_out": list(self.split.held_out),
            "optimizer": self.optimizer,
            "seed": self.seed,
            "evaluations": self.evaluations,
            "ending": self.ending,
            "at_bound": list(self.at_bound),
            "without_influence": list(self.idle),
            "spread": list(self.spread),
            "identifiability": identifiability_of(self.fitted, self.known) if self.known else None,
        }

    def summary(self) -> str:
        """The result for the terminal."""
        lines = [f"{self.declared.name}: RMSE {self.errors.train:.4g} N on training runs" + _held_out(self.errors)]
        if self.noise_floor.value:
            lines.append(f"noise floor {self.noise_floor.value:.4g} N, from {self.noise_floor.source}")
        for slot in self.fitted.slots():
            if slot.value.searched and "[" not in slot.path:
                lines.append(f"  {slot.path} = {pretty(slot.value.number, slot.value.unit)}{_interval(slot.value)}")
        lines += [f"  {path} is at the end of its range: widen its bounds or drop it" for path in self.at_bound]
        told = identifiability_of(self.fitted, self.known) if self.known else {"weak": (), "may_go": ()}
        lines += [f"  {sentence}" for sentence in (*told["weak"], *told["may_go"])]
        return "\n".join([*lines, self.ending + but_undetermined(told.get("undetermined", ()))])


def floor_of(floor: NoiseFloor) -> dict[str, Any]:
    """A noise floor as it stands in result files."""
    return {"value": floor.value, "from": floor.source}


def identifiability_of(spec: NetworkSpec, known: Identifiability) -> dict[str, Any]:
    """What data tell of the parameters of a network as it stands in result files."""
    return {
        "condition": known.condition,
        "deviations": known.deviations,
        "undetermined": known.undetermined,
        "weak": known.sentences,
        "may_go": may_go(spec, known),
    }


def but_undetermined(paths: Sequence[str]) -> str:
    """What has to be said beside "converged" where these numbers are not determined."""
    if not paths:
        return ""
    return f", but these data do not determine {', '.join(map(number_in_words, paths))}"


def parameters_of(spec: NetworkSpec) -> dict[str, Any]:
    """Every number of a network as it stands in result files."""
    return {
        slot.path: {
            "value": slot.value.number,
            "unit": slot.value.unit,
            "role": slot.value.role,
            "interval": list(slot.value.interval) if slot.value.interval else None,
        }
        for slot in spec.slots()
    }


def with_intervals(spec: NetworkSpec, intervals: Mapping[str, tuple[float, float]]) -> NetworkSpec:
    """The network with intervals noted at its values."""
    slots = {slot.path: slot.value for slot in spec.slots()}
    return spec.with_values({path: replace(slots[path], interval=pair) for path, pair in intervals.items()})


def _held_out(errors: Errors) -> str:
    return "" if errors.held_out is None else f", {errors.held_out:.4g} N on held-out runs"


def _interval(value: Value) -> str:
    if not value.interval:
        return ""
    low, high = (pretty(side, value.unit, 3) for side in value.interval)
    return f"  [{low}, {high}]"
