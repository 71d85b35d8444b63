"""Exported C, compiled by the system's compiler and called from here."""

from __future__ import annotations

import ctypes
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from dashpot.data.drive import Drive
from dashpot.kernel.export import Exported, exported
from dashpot.kernel.targets.c99.header import identifier, print_header
from dashpot.kernel.targets.c99.source import print_source
from dashpot.kernel.targets.c99.watch import state_size
from dashpot.model.network import NetworkSpec

STRICT = ("-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic")
DOUBLES = ctypes.POINTER(ctypes.c_double)
ALONG = """\
#include "{name}.h"

void along({name}_network *network, int samples, const double *inputs, double dt, double *outputs);
void along({name}_network *network, int samples, const double *inputs, double dt, double *outputs)
{{
    for (int k = 0; k < samples; ++k) {{
        {name}_advance(network, inputs + {guard}_INPUTS * k, dt, outputs + {guard}_OUTPUTS * k);
    }}
}}
"""


def write_sources(spec: NetworkSpec, folder: Path) -> Exported:
    """The header and the source of a network in a folder."""
    found, name = exported(spec), identifier(spec.name)
    (folder / f"{name}.h").write_text(print_header(found.online, spec.name, found.title, spec.identified))
    source = print_source(found.online, spec.name, found.values, found.units, spec.identified.range)
    (folder / f"{name}.c").write_text(source)
    return found


@dataclass(frozen=True)
class Library:
    """A network as a shared library."""

    found: Exported
    name: str
    functions: ctypes.CDLL

    @classmethod
    def build(cls, spec: NetworkSpec, folder: Path) -> Library:
        """Compile a network with all warnings as errors."""
        found, name = write_sources(spec, folder), identifier(spec.name)
        (folder / "along.c").write_text(ALONG.format(name=name, guard=name.upper()))
        command = ["cc", *STRICT, "-shared", "-fPIC", "-o", f"{name}.so", f"{name}.c", "along.c", "-lm"]
        subprocess.run(command, cwd=folder, check=True)
        return cls(found, name, ctypes.CDLL(str(folder / f"{name}.so")))

    def along(self, drives: list[Drive], values: np.ndarray) -> tuple[np.ndarray, int]:
        """The outputs (samples, outputs) along motions of the driven nodes, and the status."""
        online, drive = self.found.online, drives[0]
        size = state_size(online, self.found.spec.identified.range)
        memory = np.zeros(size + values.size + 1)
        self._call("init", memory, ctypes.c_double(max(np.ptp(each.displacement) for each in drives)))
        memory[size:-1] = values
        inputs = np.column_stack(
            [column for each in drives for column in (each.displacement, each.velocity, each.acceleration)]
        )
        outputs = np.empty((drive.samples, online.before - online.outputs))
        self.functions.along(
            memory.ctypes.data_as(DOUBLES),
            drive.samples,
            inputs.ctypes.data_as(DOUBLES),
            ctypes.c_double(drive.dt),
            outputs.ctypes.data_as(DOUBLES),
        )
        return outputs, self._call("status", memory)

    def _call(self, function: str, memory: np.ndarray, *more: object) -> int:
        return getattr(self.functions, f"{self.name}_{function}")(memory.ctypes.data_as(DOUBLES), *more)
