"""What an optimizer promises: to ask for blocks of points in the unit cube and to be told what they are worth."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Generator
from dataclasses import dataclass
from importlib.util import find_spec
from typing import ClassVar, Literal, TypeAlias

import numpy as np

Needs: TypeAlias = Literal["losses", "residuals"]
Blocks: TypeAlias = Generator[np.ndarray, np.ndarray, "str | None"]


@dataclass(frozen=True, eq=False)
class Space:
    """The free parameters, each scaled to [0, 1]; the scale of each (linear, logarithmic) is hidden from the optimizer.

    names: one for each parameter; start: (n,), the point known before the search.

    Examples:
        >>> space = dp.Space(("rubber.stiffness", "damping.damping"), np.array([0.5, 0.2]))
        >>> space.size
        2
    """

    names: tuple[str, ...]
    start: np.ndarray

    def __post_init__(self) -> None:
        start = np.array(self.start, dtype=float)
        if not self.names or start.shape != (len(self.names),):
            raise ValueError(f"expected a start value for each of {len(self.names)} (>= 1) names, got {start.shape}")
        if not np.all((start >= 0.0) & (start <= 1.0)):
            raise ValueError(f"expected start values between 0 and 1, got {start}")
        start.flags.writeable = False
        object.__setattr__(self, "start", start)

    @property
    def size(self) -> int:
        """Number of free parameters."""
        return len(self.names)


class Optimizer(ABC):
    """A search for the point of smallest loss, in steps: `ask` for a block of points, `tell` what they are worth.

    Keyword arguments of the constructor, with types and defaults, are the options a user can set. `begin` forgets
    everything of an earlier search. The same space, seed and values give the same points, bit for bit.

    Examples:
        >>> method = Chance(points=4)
        >>> method.begin(space, seed=1)
        >>> block = method.ask()
        >>> method.tell(block, block.sum(axis=1))
        >>> method.ask() is None, method.conclusion
        (True, 'the best of 4 points was 2')
    """

    word: ClassVar[str]
    """The name of the method in files and on the command line."""

    needs: Needs = "losses"
    """What the block asked last is to be answered with; a method that needs both sets it before it asks."""

    conclusion: str = ""
    """Why there is nothing more to ask, in the method's own words."""

    allowance: int | None = None
    """How many parameter vectors will be evaluated at most, set by the driver before `begin`; None: no limit."""

    library: ClassVar[str] = ""
    """The module that has to be importable for the method to work; empty where dashpot requires it anyway."""

    @classmethod
    def missing(cls) -> str:
        """The name of the library that is not installed, or an empty text."""
        return "" if not cls.library or find_spec(cls.library) else cls.library

    @abstractmethod
    def begin(self, space: Space, seed: int) -> None:
        """Start a new search."""

    @abstractmethod
    def ask(self) -> np.ndarray | None:
        """The next block (lanes, n) inside the unit cube; the same again until told; None when the search is over."""

    @abstractmethod
    def tell(self, points: np.ndarray, values: np.ndarray) -> None:
        """Take in what the asked block is worth: losses (lanes,) or residuals (lanes, samples).

        A loss is the root mean square of the lane's residuals. A failed lane has the loss +inf, residuals all +inf;
        NaN is never told.
        """

    def close(self) -> None:  # noqa: B027  (most methods hold nothing)
        """Let go of what the search holds. The driver calls it however the search ends."""


class Search(Optimizer):
    """An optimizer written as one generator: `values = yield points`; what it returns is its conclusion.

    Examples:
        >>> class Chance(dp.Search):
        ...     '''Points drawn evenly.'''
        ...     word = "chance"
        ...     def __init__(self, points: int = 8):
        ...         self.points = points
        ...     def search(self, space, rng):
        ...         losses = yield rng.random((self.points, space.size))
        ...         return f"the best of {self.points} points was {losses.argmin()}"
    """

    _blocks: Blocks | None = None
    _asked: np.ndarray | None = None

    @abstractmethod
    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """Yield blocks of points (lanes, n), receive their losses or residuals."""

    def begin(self, space: Space, seed: int) -> None:
        """Start the generator."""
        self.close()
        self.conclusion = ""
        blocks = self.search(space, np.random.default_rng(seed))
        if not isinstance(blocks, Generator):
            raise TypeError(
                f"{type(self).__name__}.search: expected a generator, values = yield points, got {blocks!r}"
            )
        self._blocks = blocks
        self._advance(None)

    def ask(self) -> np.ndarray | None:
        """The block the generator waits at."""
        return self._asked

    def tell(self, points: np.ndarray, values: np.ndarray) -> None:
        """Send the values into the generator."""
        self._advance(values)

    def close(self) -> None:
        """End the generator."""
        if self._blocks is not None:
            self._blocks.close()
        self._blocks = self._asked = None

    def _advance(self, values: np.ndarray | None) -> None:
        if self._blocks is None:
            raise RuntimeError(f"{type(self).__name__}: expected begin() before tell(), got no search under way")
        try:
            self._asked = self._blocks.send(values)  # type: ignore[arg-type]
        except StopIteration as end:
            self._asked, self.conclusion = None, end.value or ""


def losses_of(values: np.ndarray) -> np.ndarray:
    """Losses (lanes,) of a block answered with losses (lanes,) or residuals (lanes, samples); what failed is +inf."""
    values = np.asarray(values, dtype=float)
    if values.ndim == 2:
        values = np.sqrt(np.einsum("ij,ij->i", values, values) / values.shape[1])
    return np.where(np.isfinite(values), values, np.inf)
