"""Networks as LLVM assembly.

assembly  - how instructions on vectors of lanes are written
functions - the long functions, such as the exponential
library   - functions of the C library, lane by lane
packing   - one lane alone: several numbers share a vector
passes    - a pass over a group of lanes, node by node
source    - all passes of a network with two ends as one self-contained text
system_source - the same for a network with unknown nodes
native    - the text is compiled once per machine, and kept by what it is made of
"""

from __future__ import annotations

from dashpot.kernel.ir.program import Program
from dashpot.kernel.ir.system import SystemProgram
from dashpot.kernel.targets.llvm import source, system_source
from dashpot.kernel.targets.llvm.native import Native, load_known

VECTORS = 1  # of lanes in a group of a network with unknown nodes


def network(program: Program, vectors: int, alone: bool) -> Native:
    """The code of a network with two ends; see ``source``."""
    mark = _mark(program, vectors, alone)
    return load_known(mark, len(source.ARGUMENTS), lambda: source.print_source(program, vectors, alone))


def system(program: SystemProgram, alone: bool) -> Native:
    """The code of a network with unknown nodes; see ``system_source``."""
    mark = _mark(program.program, VECTORS, alone)
    return load_known(mark, len(system_source.ARGUMENTS), lambda: system_source.print_system(program, VECTORS, alone))


def _mark(program: Program, vectors: int, alone: bool) -> str:
    return program.digest and f"{program.digest}, {vectors} vectors, {alone}"
