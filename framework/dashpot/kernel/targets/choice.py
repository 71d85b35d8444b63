"""The targets that run in this process, and which of them does."""

from __future__ import annotations

import os
from importlib import import_module
from pathlib import Path
from typing import Protocol, cast

import numpy as np

from dashpot.kernel.ir.program import Program
from dashpot.kernel.ir.system import SystemProgram
from dashpot.text.problem import InputError, Place, nearest

BACKEND, LLVM = "DASHPOT_BACKEND", "llvm"
TARGETS = (LLVM, "numba")


class Code(Protocol):
    """Compiled code, called with arrays, integers and None for no array; ``file`` is where it is kept."""

    @property
    def file(self) -> Path:
        """The file that it came from."""

    def __call__(self, *arguments: np.ndarray | int | None) -> None:
        """Run it."""


class Target(Protocol):
    """What compiles programs for groups of lanes; the arguments of the code are those of every target."""

    def network(self, program: Program, vectors: int, alone: bool) -> Code:
        """A network with two ends, for groups of ``vectors`` times ``LANES`` lanes; with ``alone`` all are the same."""

    def system(self, program: SystemProgram, alone: bool) -> Code:
        """A network with unknown nodes, for groups of ``LANES``; with ``alone`` all are the same."""


def backend() -> str:
    """The word of the target that runs: what ``DASHPOT_BACKEND`` says, else ``llvm``. InputError for an unknown one."""
    word = os.environ.get(BACKEND) or TARGETS[0]
    if word not in TARGETS:
        known = ", ".join(TARGETS)
        raise InputError.at(Place(BACKEND), f"expected one of {known}, got '{word}'", nearest(word, TARGETS))
    return word


def target() -> Target:
    """The target that runs."""
    return cast(Target, import_module(f"dashpot.kernel.targets.{backend()}"))
