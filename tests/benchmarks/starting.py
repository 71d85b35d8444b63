"""What a fresh process needs: imports, a network compiled or taken from the cache; and instructions by valgrind."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from shutil import which
from statistics import median

HERE = Path(__file__).parent
COMPILED = {"tire_model_5": ("from workload import network", "network('tire_model_5').native(2)"),
            "axle_model_3": ("from axle import axle", "axle()")}  # fmt: skip
COUNTED = {"tire_model_5": "from workload import SWEEPS, Task, network; import dataclasses; "
           "t = Task.of(network(), (dataclasses.replace(SWEEPS[8], seconds={seconds}).drive(),), 64); t.score()",
           "axle_model_3": "from axle import AxleTask; t = AxleTask.of({seconds}, 64); t.score()"}  # fmt: skip
REGISTERS = ("zmm", "ymm", "xmm")
SHORT, LONG, DT, COUNTED_LANES = 0.2, 0.4, 1e-3, 64


def start_times(rounds: int) -> dict[str, float]:
    """Processor seconds in a fresh process: the import, then each network read and compiled, or read from the cache."""
    found = {"import dashpot": _seconds("", "import dashpot", "", rounds)}
    for name, code in COMPILED.items():
        with tempfile.TemporaryDirectory() as cache:
            found[f"{name} cold"] = _seconds(*code, cache, 1)
            found[f"{name} warm"] = _seconds(*code, cache, rounds)
    return found


def _seconds(before: str, code: str, cache: str, rounds: int) -> float:
    timed = f"{before}\nimport time; began = time.process_time()\n{code}\nprint(time.process_time() - began)"
    environment = {**os.environ, "DASHPOT_CACHE": cache} if cache else dict(os.environ)
    outputs = [_run([sys.executable, "-c", timed], environment) for _ in range(rounds)]
    return median(float(output.split()[-1]) for output in outputs)


def vectors() -> dict[str, dict[str, int]]:
    """How many instructions of the machine code of each network use which registers: of 512, 256 or 128 bits."""
    import axle
    import workload

    from dashpot.kernel.native import machine_text
    from dashpot.kernel.source import print_source
    from dashpot.kernel.system_source import print_system

    tire, system = workload.network(), axle.axle()
    unknown = system.topology.unknown
    texts = {"tire_model_5": print_source(tire.program, 2),
             "axle_model_3": print_system(system.layouts, system.outputs, unknown, 1)}  # fmt: skip
    found = {}
    for name, text in texts.items():
        lines = machine_text(text).splitlines()
        found[name] = {kind: sum(kind in line for line in lines) for kind in REGISTERS}
    return found


def instructions() -> dict[str, float]:
    """Instructions per lane and sample by network: the difference of a long and a short run; empty without valgrind.

    Valgrind knows no 512-bit vectors, so the count is that of narrower ones, of the same code.
    """
    if not which("valgrind"):
        return {}
    return {name: (_counted(code.format(seconds=LONG)) - _counted(code.format(seconds=SHORT)))
            * DT / ((LONG - SHORT) * COUNTED_LANES) for name, code in COUNTED.items()}  # fmt: skip


def _counted(code: str) -> int:
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", sys.executable, "-c", code]
    environment = {**os.environ, "DASHPOT_PROCESSOR": "haswell"}
    _run([sys.executable, "-c", code], environment)  # compiles without valgrind
    found = re.search(r"Collected\s*:\s*(\d+)", _run(command, environment))
    if found is None:
        raise RuntimeError("valgrind told no count of instructions")
    return int(found[1])


def _run(command: list[str], environment: dict[str, str]) -> str:
    done = subprocess.run(command, env=environment, cwd=HERE, capture_output=True, text=True, check=True)
    return done.stdout + done.stderr
