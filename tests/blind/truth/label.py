"""The truth about a case, given only in exchange for a verdict."""

from __future__ import annotations

import hashlib
import json
import secrets
from collections.abc import Mapping
from dataclasses import asdict, dataclass


class SealBroken(Exception):
    """The label was asked for without a verdict, or for the second time."""


@dataclass(frozen=True)
class Hidden:
    """One hidden effect: its cause word, its form, and how large it is.

    `strength` is the pooled root mean square of the effect over the dynamic runs, the mean of each run taken out,
    over that of the noise; `strength_left` the same over all runs after a least squares refit of the base's spring
    curve and of all its other numbers; `rms` the raw root mean square per run [N], means included.
    """

    kind: str
    form: str
    size: float
    unit: str
    parameters: Mapping[str, float]
    strength: float
    strength_left: float
    rms: Mapping[str, float]


@dataclass(frozen=True)
class Truth:
    """All about one case; no effect at all is a null case. `noise_rms` is the realised one per run [N],
    of an axle per `run@end`."""

    seed: int
    design: str
    base: Mapping[str, object]
    noise: Mapping[str, float]
    noise_rms: Mapping[str, float]
    effects: tuple[Hidden, ...]

    @property
    def kinds(self) -> tuple[str, ...]:
        """Cause words of what is hidden, sorted."""
        return tuple(sorted(effect.kind for effect in self.effects))


class SealedLabel:
    """Holds a truth; `commitment` (sha256 of nonce and truth) may be published before the verdict."""

    def __init__(self, truth: Truth) -> None:
        self.__truth = truth
        self.__nonce = secrets.token_hex(16)
        self.__verdict: object = None
        self.commitment = _digest(self.__nonce, truth)

    def __repr__(self) -> str:
        return f"SealedLabel({'sealed' if self.__verdict is None else 'opened'}, {self.commitment[:12]})"

    def open(self, verdict: object) -> Truth:
        """Record the verdict, then return the truth. Raises SealBroken without a verdict, or when opened before."""
        if not verdict:
            raise SealBroken("expected a verdict in exchange for the truth, got none; diagnose first")
        if self.__verdict is not None:
            raise SealBroken(f"expected one opening, got a second; the verdict on record is {self.__verdict!r}")
        self.__verdict = verdict
        return self.__truth

    @property
    def verdict(self) -> object:
        """The verdict on record, None while sealed."""
        return self.__verdict

    @property
    def nonce(self) -> str:
        """What proves the commitment; raises SealBroken while sealed."""
        if self.__verdict is None:
            raise SealBroken("expected a verdict before the nonce is shown, got none")
        return self.__nonce


def proves(nonce: str, truth: Truth, commitment: str) -> bool:
    """Whether the commitment was made to this truth."""
    return _digest(nonce, truth) == commitment


def _digest(nonce: str, truth: Truth) -> str:
    return hashlib.sha256((nonce + json.dumps(asdict(truth), sort_keys=True)).encode()).hexdigest()
