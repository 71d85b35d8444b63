"""Networks as functions that numba compiles.

code     - statements of Python as numba compiles it
module   - modules, kept by what they are made of
sealed   - their machine code on disk, known again by its digest
borrowed - arrays without counted references, and on the stack
packed   - long functions of four arguments in a vector
block    - blocks of lanes along whole records, as the kernel runs them
stepping - step and simulate, to be called from anybody's compiled code
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from dashpot.kernel.ir.layout import LANES
from dashpot.kernel.ir.program import Program
from dashpot.kernel.ir.system import SystemProgram

KEPT = 512
NOTHING = np.empty(0)


@dataclass(frozen=True, eq=False)
class Lanes:
    """A compiled ``run`` for groups of ``width`` lanes."""

    run: Callable[..., None]
    width: int
    file: Path

    def __call__(self, *arguments: np.ndarray | int | None) -> None:
        """Call it; None is no array."""
        self.run(*map(_flat, arguments), self.width)


def network(program: Program, vectors: int, alone: bool) -> Lanes:
    """The code of a network with two ends."""
    return _lanes(_text(program), vectors * LANES)


def system(program: SystemProgram, alone: bool) -> Lanes:
    """The code of a network with unknown nodes."""
    return _lanes(_system_text(program), LANES)


def _lanes(text: str, width: int) -> Lanes:
    from dashpot.kernel.targets.numba.module import load_module

    module = load_module(text)
    assert module.__file__ is not None
    return Lanes(module.run, width, Path(module.__file__))


def _flat(argument: np.ndarray | int | None) -> Any:
    if argument is None:
        return NOTHING
    return argument.reshape(-1) if isinstance(argument, np.ndarray) else argument


@lru_cache(KEPT)
def _text(program: Program) -> str:
    from dashpot.kernel.targets.numba.block import print_network

    return print_network(program)


@lru_cache(KEPT)
def _system_text(program: SystemProgram) -> str:
    from dashpot.kernel.targets.numba.block import print_system

    return print_system(program)
