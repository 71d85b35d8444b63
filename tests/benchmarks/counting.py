"""Instructions of compiled networks: how many valgrind counts, and which registers the machine code uses.

A count does not depend on what else the machine does, so that it shows a regression where a time does not. Valgrind
knows no 512-bit vectors: what it counts is compiled for AVX2, from the same text.
"""

from __future__ import annotations

import os
import pickle
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path
from shutil import which
from typing import Any

import numpy as np
from axle import AXLE, AxleTask, axle
from workload import NETWORK, SWEEPS, Task, network

from dashpot.kernel.targets.choice import backend
from dashpot.kernel.targets.llvm.native import machine_text
from dashpot.kernel.targets.llvm.source import print_source
from dashpot.kernel.targets.llvm.system_source import print_system

REGISTERS = ("zmm", "ymm", "xmm")
PROCESSOR, SECONDS = "haswell", 0.5
# calls that are counted: so many that what Python does around them, which differs from start to start, hardly counts
CALLS = {NETWORK: 1500, f"{NETWORK}, 1 lane": 4000, AXLE: 500}
RUN = """
import pickle, sys
from dashpot.kernel.targets.llvm.native import load_native
with open(sys.argv[1], "rb") as file:
    text, arguments = pickle.load(file)
code = load_native(text, len(arguments))
for _ in range(int(sys.argv[2])):
    code(*arguments)
"""


@dataclass
class Recorder:
    """Stands in for compiled code and keeps what it is called with."""

    calls: list[tuple[Any, ...]] = field(default_factory=list)

    def __call__(self, *arguments: Any) -> None:
        self.calls.append(tuple(np.copy(each) if isinstance(each, np.ndarray) else each for each in arguments))


@dataclass(frozen=True)
class Counted:
    """Compiled code: its text, what it is called with, and how many lanes times samples that is."""

    text: str
    arguments: tuple[Any, ...]
    units: int


def texts() -> dict[str, str]:
    """What each network is compiled from."""
    system = axle()
    return {
        NETWORK: print_source(network().program, 2),
        f"{NETWORK}, 1 lane": print_source(network().program, 1, True),
        AXLE: print_system(system.system, 1),
    }


def vectors() -> dict[str, dict[str, int]]:
    """How many instructions of the machine code of each network use which registers: of 512, 256 or 128 bits."""
    found = {}
    for name, text in texts().items():
        lines = machine_text(text).splitlines()
        found[name] = {kind: sum(kind in line for line in lines) for kind in REGISTERS}
    return found


def instructions() -> dict[str, float]:
    """Instructions per lane and sample by network; empty without valgrind."""
    if not which("valgrind"):
        return {}
    return {name: _counted(work, CALLS[name]) for name, work in works().items()}


def works() -> dict[str, Counted]:
    """Each network on a short sweep."""
    drives = (replace(SWEEPS[8], seconds=SECONDS).drive(),)
    found = {}
    for name, count in ((NETWORK, 16), (f"{NETWORK}, 1 lane", 1)):
        recorder, task = Recorder(), Task.of(replace(network()), drives, count)
        task.network._natives[backend(), *((2, False) if count > 1 else (1, True))] = recorder
        task.score()
        found[name] = Counted(texts()[name], recorder.calls[0], task.units)
    recorder, whole = Recorder(), AxleTask.of(SECONDS, 8)
    system = replace(axle(), native=lambda alone: recorder)
    zeros = np.zeros((2, whole.runs[0].excitation.samples))
    system.score(whole.runs, [zeros], [zeros + 1.0], whole.values)
    return {**found, AXLE: Counted(texts()[AXLE], recorder.calls[0], whole.units)}


def _counted(work: Counted, calls: int) -> float:
    with tempfile.TemporaryDirectory() as folder:
        given = Path(folder) / "work"
        given.write_bytes(pickle.dumps((work.text, work.arguments)))
        few, many = (_collected(given, count) for count in (1, 1 + calls))
    return (many - few) / (calls * work.units)


def _collected(given: Path, count: int) -> int:
    command = [sys.executable, "-c", RUN, str(given), str(count)]
    environment = {**os.environ, "DASHPOT_PROCESSOR": PROCESSOR, "PYTHONHASHSEED": "0"}
    subprocess.run(command, env=environment, check=True)  # compiles without valgrind
    counting = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command]
    told = subprocess.run(counting, env=environment, capture_output=True, text=True, check=True).stderr
    found = re.search(r"Collected\s*:\s*(\d+)", told)
    if found is None:
        raise RuntimeError(f"valgrind told no count of instructions: {told[-500:]}")
    return int(found[1])
