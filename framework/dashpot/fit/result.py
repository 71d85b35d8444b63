"""What an identification found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import dashpot
from dashpot.data.dataset import Dataset
from dashpot.data.noise import NoiseFloor
from dashpot.fit.holdout import Split
from dashpot.fit.identifiability import Identifiability, may_go, number_in_words
from dashpot.fit.moving_channels import moving_channels
from dashpot.fit.prior import PriorTold, describe_priors
from dashpot.model.identified import Range
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import fill_numbers
from dashpot.model.slopes import RUN, per_run
from dashpot.text.digits import quantity, with_interval
from dashpot.text.quantity import pretty

if TYPE_CHECKING:
    from dashpot.fit.posterior import Posterior


@dataclass(frozen=True, eq=False)
class Errors:
    """Root mean square errors in N: of the training runs, the held-out ones (None without), all, and each run."""

    train: float
    held_out: float | None
    all: float
    per_run: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class FitResult:
    """A network with fitted parameters and how good it is.

    ``declared`` is the network as its file has it; ``fitted`` has numbers, intervals and tables. ``spread`` holds the
    losses that different starts ended at, best first: near one another they are evidence of convergence. ``known`` says
    the identifiability; ``seen`` is the range of the motions of the training runs. ``correlation`` (p, p)
    is that of the errors of the free parameters, in the order of their slots and in logarithms where they are searched
    so; ``errors_of_numbers`` (p,) are their standard errors in SI. ``samples`` is how many were fitted; ``priors``
    what became of the priors; ``posterior`` has the draws of a sampler where one was asked for; ``spare`` names the
    branches that may go together.
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
    errors_of_numbers: NDArray[np.float64] | None = field(default=None, repr=False)
    samples: int = 0
    priors: tuple[PriorTold, ...] = ()
    posterior: Posterior | None = field(default=None, repr=False)
    spare: tuple[str, ...] = ()

    @property
    def free(self) -> tuple[str, ...]:
        """The paths of the p numbers that were searched."""
        return tuple(slot.path for slot in self.fitted.slots() if slot.value.searched)

    @property
    def covariance(self) -> NDArray[np.float64]:
        """The covariance (p, p) of the parameters ``free``, in products of their SI units.

        Standard errors as in the intervals, without Student's factor for few blocks, times ``correlation``; to first
        order where a number is searched by logarithm. Infinite on the diagonal, and 0 beside it, for a number that the
        data do not determine. ValueError for a fit without intervals.
        """
        if self.errors_of_numbers is None or self.correlation is None:
            raise ValueError("expected a fit with intervals, got one without")
        known = np.where(np.isfinite(self.errors_of_numbers), self.errors_of_numbers, 0.0)
        found = np.outer(known, known) * self.correlation
        np.fill_diagonal(found, self.errors_of_numbers**2)
        return found

    @property
    def aic(self) -> float:
        """Akaike's criterion n ln(RMSE^2) + 2 p, of the n samples and the RMSE in N of the training runs.

        Smaller is better, between models of the same training runs. Samples count as independent: where residuals are
        coloured, more numbers look better than they are, and the error of held-out runs decides.
        """
        return self._likelihood + 2.0 * len(self.free)

    @property
    def bic(self) -> float:
        """Schwarz's criterion n ln(RMSE^2) + p ln(n); see ``aic``."""
        return self._likelihood + float(np.log(self.samples)) * len(self.free)

    @property
    def _likelihood(self) -> float:
        return 2.0 * self.samples * float(np.log(self.errors.train))

    @property
    def undetermined(self) -> list[str]:
        """The parameters of which neither the data nor a prior tell even the order of magnitude."""
        found = self.known.undetermined if self.known else []
        if not self.priors or self.errors_of_numbers is None:
            return found
        lost = {path for path, error in zip(self.free, self.errors_of_numbers, strict=True) if not np.isfinite(error)}
        return [path for path in found if path in lost]

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
            "identifiability": self.identifiability,
            **({"priors": describe_priors(self.priors)} if self.priors else {}),
            **({"posterior": self.posterior.as_dict()} if self.posterior else {}),
        }

    @property
    def identifiability(self) -> dict[str, Any] | None:
        """What the data tell of the parameters as it stands in result files; None where it was not looked at."""
        if self.known is None:
            return None
        told = identifiability_of(self.fitted, self.known, self.spare) | {"undetermined": self.undetermined}
        if self.priors:
            told["weak"] = [f"without the priors {sentence}" for sentence in told["weak"]]
        told["weak"] = [*told["weak"], *moving_channels(self.fitted, self.dataset.select(self.split.train).runs)]
        return told

    def summary(self) -> str:
        """The result for the terminal."""
        train = quantity(self.errors.train, "N")
        lines = [f"{self.declared.name}: RMSE {train} on training runs{_held_out(self.errors)}"]
        if self.noise_floor.value:
            lines.append(f"noise floor {quantity(self.noise_floor.value, 'N')}, from {self.noise_floor.source}")
        unknown, curves = {*self.idle, *self.undetermined}, self.fitted.curves()
        slopes = per_run({slot.path: slot.value for slot in self.fitted.slots()})
        for slot in self.fitted.slots():
            if (slot.value.searched or slot.value.expression) and slot.path.partition("[")[0] not in curves:
                value, interval = slot.value, None if slot.path in unknown else slot.value.interval
                follows = f"  = {value.expression}" if value.expression else ""
                size = with_interval(value.number, interval, value.unit, RUN if slot.path in slopes else "")
                lines.append(f"  {slot.path} = {size}{follows}")
        lines += [f"  {path} is at the end of its range: widen its bounds or drop it" for path in self.at_bound]
        told = self.identifiability or {"weak": (), "may_go": ()}
        lines += [f"  {sentence}" for sentence in (*told["weak"], *told["may_go"])]
        lines += [f"  {each.sentence}" for each in self.priors]
        lines += [f"  {self.posterior.sentence}"] if self.posterior else []
        return "\n".join([*lines, self.ending + but_undetermined(told.get("undetermined", ()))])


def floor_of(floor: NoiseFloor) -> dict[str, Any]:
    """A noise floor as it stands in result files."""
    return {"value": floor.value, "from": floor.source}


def identifiability_of(spec: NetworkSpec, known: Identifiability, spare: Sequence[str] = ()) -> dict[str, Any]:
    """What data tell of the parameters of a network, and of its ``spare`` branches, as it stands in result files."""
    return {
        "condition": known.condition,
        "deviations": known.deviations,
        "undetermined": known.undetermined,
        "weak": known.sentences,
        "may_go": may_go(spec, known, spare),
    }


def but_undetermined(paths: Sequence[str]) -> str:
    """What has to be said beside "converged" where these numbers are not determined."""
    if not paths:
        return ""
    return f", but these data do not determine {', '.join(map(number_in_words, paths))}"


def parameters_of(spec: NetworkSpec) -> dict[str, Any]:
    """Every number of a network as it stands in result files."""
    slopes = per_run({slot.path: slot.value for slot in spec.slots()})
    return {
        slot.path: {
            "value": slot.value.number,
            "unit": slot.value.unit,
            "role": slot.value.role,
            "interval": list(slot.value.interval) if slot.value.interval else None,
            **({"per": RUN} if slot.path in slopes else {}),
            **({"expression": slot.value.expression} if slot.value.expression else {}),
        }
        for slot in spec.slots()
    }


def with_intervals(spec: NetworkSpec, intervals: Mapping[str, tuple[float, float]]) -> NetworkSpec:
    """The network with intervals noted at its values."""
    slots = {slot.path: slot.value for slot in spec.slots()}
    return spec.with_values({path: replace(slots[path], interval=pair) for path, pair in intervals.items()})


def _held_out(errors: Errors) -> str:
    return "" if errors.held_out is None else f", {quantity(errors.held_out, 'N')} on held-out runs"
