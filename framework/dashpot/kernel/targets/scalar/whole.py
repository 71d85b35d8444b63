"""All functions of a network that somebody else steps."""

from __future__ import annotations

from dashpot.kernel.ir.online import Online
from dashpot.kernel.targets.scalar.code import Code
from dashpot.kernel.targets.scalar.coupled import write_coupled
from dashpot.kernel.targets.scalar.online import write_parallel


def write_network(code: Code, online: Online) -> None:
    """Write ``advance`` and all that it calls."""
    if online.system:
        write_coupled(code, online)
    else:
        write_parallel(code, online)
