"""Networks with unknown nodes, written in a few lines, and what drives them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from textwrap import dedent, indent

import numpy as np
from verification.truth.motion import Cosines

from dashpot import load_registry
from dashpot.data.drive import Drive, drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.kernel.network import compile_network
from dashpot.kernel.system import CompiledSystem
from dashpot.model.reading import parse_network, read_network

DT = 1e-3


def written(nodes: str, branches: str, gravity: str = "0 m/s^2") -> str:
    """The text of a network."""
    lines = indent(dedent(branches).strip("\n"), "  ")
    joints = f"gravity: {gravity}\nnodes: {nodes}\n" if nodes else ""
    return f"format: dashpot-network/1\nname: system\n{joints}branches:\n{lines}\n"


@cache
def system(nodes: str, branches: str, gravity: str = "0 m/s^2") -> CompiledSystem:
    """The compiled network of a text, made once in a session."""
    found = compile_network(parse_network(written(nodes, branches, gravity), load_registry().elements))
    assert isinstance(found, CompiledSystem)
    return found


@cache
def shipped(name: str) -> CompiledSystem:
    """A shipped network, compiled once in a session."""
    found = compile_network(read_network(name, load_registry().elements))
    assert isinstance(found, CompiledSystem)
    return found


def times(seconds: float, dt: float = DT) -> np.ndarray:
    return dt * np.arange(round(seconds / dt) + 1)


def drive_of(motion: Cosines, at: np.ndarray) -> Drive:
    """The motion sampled with its true rates."""
    return drive_from_path(at[1] - at[0], motion.place(at), motion.speed(at), motion.bend(at))


def excitation(
    at: np.ndarray,
    motions: Mapping[str, Cosines],
    settings: Mapping[str, float] | None = None,
    loads: Mapping[str, np.ndarray] | None = None,
) -> Excitation:
    drives = {node: drive_of(motion, at) for node, motion in motions.items()}
    return Excitation(drives, loads or {}, settings or {}, at[1] - at[0], at.size)


def lanes(network: CompiledSystem, **numbers: np.ndarray | float) -> np.ndarray:
    """The values of the file with some numbers replaced, given by path with '__' for the dot; (lanes, slots)."""
    count = max((np.size(column) for column in numbers.values()), default=1)
    values = np.repeat(network.start[None], count, axis=0)
    for name, column in numbers.items():
        values[:, network.paths.index(name.replace("__", "."))] = column
    return values


def drawn(network: CompiledSystem, rng: np.random.Generator, spread: float = 0.4) -> np.ndarray:
    """One lane of random numbers near those of the file; tables that rise go on rising, through zero where they did."""
    values = network.start * np.exp(rng.uniform(-spread, spread, network.start.size))
    for path, curve in network.spec.curves().items():
        places = [number for number, slot in enumerate(network.paths) if slot.startswith(f"{path}[")]
        old = network.start[places]
        if curve.form == "table" and np.all(np.diff(old) > 0.0):
            new = np.concatenate([[0.0], np.cumsum(np.diff(old) * np.exp(rng.uniform(-spread, spread, old.size - 1)))])
            fixed = int(np.argmin(np.abs(old)))
            values[places] = new - new[fixed] + old[fixed]
    return values


def rms(error: np.ndarray) -> np.ndarray:
    return np.sqrt(np.mean(np.square(error), axis=-1))
