"""Optimizers of libraries that take a function, turned into ask and tell."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from queue import SimpleQueue
from threading import Thread
from typing import Any, TypeAlias

import numpy as np

from dashpot.contract.optimizer import Optimizer, Space

Evaluate: TypeAlias = Callable[[np.ndarray], np.ndarray]


class Stopped(BaseException):
    """The search was closed while the library was still calling; no `except Exception` of a library holds it."""


class Bridged(Optimizer):
    """A library's minimizer, running in a thread of its own that waits at each call of its function.

    An exception in the library comes out of `ask`. `close` ends the thread.
    """

    _line: _Line | None = None
    _asked: Any = None

    @abstractmethod
    def minimize(self, evaluate: Evaluate, space: Space, seed: int) -> str | None:
        """Run the library. `evaluate` maps a block (lanes, n) to its losses or residuals; returns the conclusion."""

    def begin(self, space: Space, seed: int) -> None:
        """Start the library in its thread."""
        self.close()
        self.conclusion = ""
        self._line = _Line(lambda evaluate: self.minimize(evaluate, space, seed))
        self._asked = self._line.listen()

    def ask(self) -> np.ndarray | None:
        """The block the library waits for; raises what the library raised."""
        if isinstance(self._asked, BaseException):
            raise self._asked
        if isinstance(self._asked, np.ndarray):
            return self._asked
        self.conclusion = self._asked or ""
        return None

    def tell(self, points: np.ndarray, values: np.ndarray) -> None:
        """Hand the values to the library and wait for its next block."""
        if self._line is None:
            raise RuntimeError(f"{type(self).__name__}: expected begin() before tell(), got no search under way")
        self._asked = self._line.answer(values)

    def close(self) -> None:
        """End the thread."""
        if self._line is not None:
            self._line.hang_up()
        self._line = self._asked = None


class _Line:
    """The two ends of one conversation: a block, a conclusion or an exception comes out, values go in."""

    def __init__(self, work: Callable[[Evaluate], str | None]):
        self._said: SimpleQueue[Any] = SimpleQueue()
        self._answers: SimpleQueue[np.ndarray | None] = SimpleQueue()
        self._thread = Thread(target=self._run, args=(work,), daemon=True, name="optimizer")
        self._thread.start()

    def listen(self) -> Any:
        return self._said.get()

    def answer(self, values: np.ndarray) -> Any:
        self._answers.put(values)
        return self.listen()

    def hang_up(self, patience: float = 5.0) -> None:
        self._answers.put(None)
        self._thread.join(patience)

    def _run(self, work: Callable[[Evaluate], str | None]) -> None:
        try:
            self._said.put(work(self._evaluate))
        except Stopped:
            pass
        except BaseException as fault:
            self._said.put(fault)

    def _evaluate(self, points: np.ndarray) -> np.ndarray:
        self._said.put(np.array(points, dtype=float))
        values = self._answers.get()
        if values is None:
            self._answers.put(None)
            raise Stopped
        return values
