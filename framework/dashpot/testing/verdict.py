"""How a check speaks: which element, what was expected and found, what to do, and the seed that repeats it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from dashpot.model.element import Element


class ConformanceError(AssertionError):
    """An element does not keep a promise; the message says which, what to do, and the seed that repeats it.

    Examples:
        >>> class Leak(Bumper):
        ...     '''A law whose force depends on more than it declares.'''
        ...     word = "leak"
        ...     def step(self, x, z, p, dt):
        ...         return dp.Response(p.stiffness * x.new + p.length)
        >>> try:
        ...     dp.check_element(Leak, seed=1)
        ... except dp.ConformanceError as error:
        ...     print("units" in str(error))
        True
    """


@dataclass(frozen=True)
class Examination:
    """One check of one element. ``rng`` draws what it needs; the same ``seed`` draws the same again."""

    element: type[Element]
    check: str
    seed: int = field(default_factory=lambda: int(np.random.SeedSequence().generate_state(1)[0]))

    @classmethod
    def begin(cls, element: type[Element], check: str, seed: int | None) -> Examination:
        """The examination with a seed, or with a new one."""
        return cls(element, check) if seed is None else cls(element, check, seed)

    def rng(self) -> np.random.Generator:
        """A new generator of this examination's random numbers."""
        return np.random.default_rng(self.seed)

    def demand(self, holds: bool, found: str, advice: str) -> None:
        """Raise ConformanceError unless it holds."""
        if not holds:
            self.fail(found, advice)

    def fail(self, found: str, advice: str) -> None:
        """Raise ConformanceError."""
        name = f"'{self.element.word}' ({self.element.__module__}.{self.element.__qualname__})"
        raise ConformanceError(f"element {name}, {self.check}: {found}. {advice} [seed {self.seed}]")
