"""What a model gets wrong, in the engineer's words: which part of the stiffness, and where."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.order_tracking import follow, harmonics_of
from dashpot.data.phase import NotOscillatingError
from dashpot.data.run import Run
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]

BANDS = 4
SMALLEST_SHARE = 0.05
NOTABLE = 1.5  # a condition stands out when its part of the misfit is this much larger than the mean


@dataclass(frozen=True)
class Misfit:
    """One kind of error: ``what`` in words, its ``share`` of the squared misfit, ``where`` it is largest."""

    what: str
    share: float
    where: Mapping[str, str]


@dataclass(frozen=True, eq=False)
class _Parts:
    """Squared misfits of one run by kind (kinds, windows), signs of the two stiffness errors, conditions (windows,)."""

    energy: Mapping[str, Array]
    storage: float
    loss: float
    amplitude: Array
    preload: Array
    frequency: Array
    total: float


def describe_misfit(runs: Sequence[Run], residuals: Mapping[str, Array]) -> list[Misfit]:
    """The kinds of error by share, largest first; residuals (n,) are measured minus simulated, N, by run."""
    parts = [part for run in runs if (part := _split(run, residuals[run.name])) is not None]
    if not parts:
        return _by_run(runs, residuals)
    total = sum(part.total for part in parts)
    shares = {kind: sum(float(part.energy[kind].mean()) for part in parts) / total for kind in parts[0].energy}
    found = [
        Misfit(_words(kind, parts), share, _where(kind, parts))
        for kind, share in shares.items()
        if share >= SMALLEST_SHARE
    ]
    return sorted(found, key=lambda misfit: -misfit.share)


def _split(run: Run, residual: Array) -> _Parts | None:
    if run.kind not in ("sweep", "harmonic"):
        return None
    try:
        oscillation = follow(run.displacement, run.sample_time)
    except NotOscillatingError:
        return None
    orders = harmonics_of(residual, oscillation)
    half = 0.5 * (orders.sine**2 + orders.cosine**2)
    energy = {
        "storage": 0.5 * orders.sine[:, 0] ** 2,
        "loss": 0.5 * orders.cosine[:, 0] ** 2,
        "even": half[:, 1],
        "odd": half[:, 2] + half[:, 4],
        "mean": orders.offset**2,
    }
    return _Parts(
        energy,
        float(np.mean(orders.sine[:, 0])),
        float(np.mean(orders.cosine[:, 0])),
        orders.amplitude,
        orders.preload,
        orders.frequency,
        float(np.mean(residual**2)),
    )


def _words(kind: str, parts: Sequence[_Parts]) -> str:
    heaviest = max(parts, key=lambda part: float(part.energy[kind].mean()))
    if kind in ("storage", "loss"):
        error = heaviest.storage if kind == "storage" else heaviest.loss
        return f"{kind} stiffness of the model too {'small' if error > 0.0 else 'large'}{_condition(kind, parts)}"
    return {
        "even": "second harmonic not reproduced (one-sided effect)",
        "odd": "third and fifth harmonic not reproduced (symmetric nonlinear effect)",
        "mean": "mean force wrong",
    }[kind]


def _condition(kind: str, parts: Sequence[_Parts]) -> str:
    # errors of stiffness, not of force: a large amplitude makes every force error large
    levels: dict[float, list[float]] = {}
    for part in parts:
        level = round(float(np.median(part.amplitude)), 5)
        levels.setdefault(level, []).append(float(np.sqrt(part.energy[kind].mean())) / max(level, 1e-9))
    if len(levels) < 2:
        return ""
    low, high = np.mean(levels[min(levels)]), np.mean(levels[max(levels)])
    if low > NOTABLE * high:
        return " at small amplitude"
    return " at large amplitude" if high > NOTABLE * low else ""


def _where(kind: str, parts: Sequence[_Parts]) -> dict[str, str]:
    amplitude, energy = _gather(parts, "amplitude", kind)
    preload, _ = _gather(parts, "preload", kind)
    frequency, _ = _gather(parts, "frequency", kind)
    edges = np.linspace(frequency.min(), frequency.max(), BANDS + 1)
    means = [
        float(energy[(frequency >= a) & (frequency <= b)].mean())
        if ((frequency >= a) & (frequency <= b)).any()
        else 0.0
        for a, b in zip(edges, edges[1:], strict=False)
    ]
    k = int(np.argmax(means))
    return {
        "amplitude": pretty(_heaviest(amplitude, energy), "m", 2),
        "preload": pretty(_heaviest(preload, energy), "m", 2),
        "band": f"{edges[k]:.3g} to {edges[k + 1]:.3g} Hz",
    }


def _gather(parts: Sequence[_Parts], key: str, kind: str) -> tuple[Array, Array]:
    return (
        np.concatenate([getattr(part, key) for part in parts]),
        np.concatenate([part.energy[kind] for part in parts]),
    )


def _heaviest(condition: Array, energy: Array) -> float:
    levels = np.unique(np.round(condition, 4))
    return float(levels[np.argmax([energy[np.round(condition, 4) == level].mean() for level in levels])])


def _by_run(runs: Sequence[Run], residuals: Mapping[str, Array]) -> list[Misfit]:
    squares = {run.name: float(np.mean(residuals[run.name] ** 2)) for run in runs}
    total = sum(squares.values()) or 1.0
    worst = max(squares, key=lambda name: squares[name])
    return [
        Misfit(
            f"force wrong, most of all in run '{worst}'",
            1.0,
            {"run": worst, "share of this run": f"{squares[worst] / total:.0%}"},
        )
    ]
