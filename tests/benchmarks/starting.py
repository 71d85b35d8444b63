"""What a fresh process needs: imports, a network compiled or taken from the cache."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

HERE = Path(__file__).parent
COMPILED = {
    "tire_model_5": ("from workload import network", "network('tire_model_5').native(2)"),
    "axle_model_3": ("from axle import axle", "axle()"),
}


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


def _run(command: list[str], environment: dict[str, str]) -> str:
    done = subprocess.run(command, env=environment, cwd=HERE, capture_output=True, text=True, check=True)
    return done.stdout + done.stderr
