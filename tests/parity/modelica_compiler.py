"""Exported Modelica, compiled and simulated by Rumoca, a compiler that shares nothing with dashpot.

``python tests/parity/modelica_compiler.py`` renews the stored forces of all shipped networks with two ends.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from seeds import seed_of
from verification.shipped import NAMES, Dice, filled

from dashpot import load_registry
from dashpot.data.drive import Drive, drive_from_path
from dashpot.kernel.targets.c99.header import identifier
from dashpot.model.network import NetworkSpec

HERE = Path(__file__).parent
BENCH, STORED = HERE / "bench.mo", HERE / "modelica_forces.json"
STEP, SAMPLES, EVERY = 1e-3, 400, 20
PRELOAD, AMPLITUDE, RATE = 15e-3, 4e-3, 60.0  # as in bench.mo


def network(name: str) -> NetworkSpec:
    """A shipped network with numbers drawn around those of its file."""
    return filled(name, Dice(seed_of(f"modelica {name}")))


def motion() -> Drive:
    """The motion of the bench, sampled; accelerations follow from the cubics, as an exported model takes them."""
    phase = RATE * STEP * np.arange(SAMPLES)
    x, v = PRELOAD + AMPLITUDE * np.sin(phase), AMPLITUDE * RATE * np.cos(phase)
    bend = (6.0 * (x[:-1] - x[1:]) / STEP + 2.0 * v[:-1] + 4.0 * v[1:]) / STEP
    return drive_from_path(STEP, x, v, np.concatenate([[0.0], bend]))


def compiled_force(spec: NetworkSpec) -> np.ndarray:
    """The force (samples,) in N on the bench, as Rumoca computes it. ImportError where it is not installed."""
    import rumoca

    [text] = load_registry().exports["modelica"]().files(spec).values()
    bench = BENCH.read_text(encoding="utf-8").replace("NETWORK", identifier(spec.name))
    found = rumoca.Session().loads(bench + text.decode(), model="Bench").simulate(STEP * SAMPLES, dt=STEP)
    # the last row of a moment is that after its event
    last = {round(time / STEP): force for time, force in zip(found.time, found["specimen.force[1]"], strict=True)}
    return np.array([last[sample] for sample in range(SAMPLES)])


def main() -> None:
    """Store every twentieth sample."""
    import rumoca

    forces = {name: compiled_force(network(name))[::EVERY].tolist() for name in NAMES}
    content = {"compiler": f"Rumoca {rumoca.version()}", "every": EVERY, "forces": forces}
    STORED.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
