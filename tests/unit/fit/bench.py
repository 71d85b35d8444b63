"""A small network on synthetic runs whose force is known in closed form."""

from __future__ import annotations

from textwrap import dedent, indent

import numpy as np

from dashpot import load_registry
from dashpot.data.drive import drive_from_path
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.linear import linearise
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import parse_network

DT = 1e-3
TIME = DT * np.arange(1500)
STIFFNESS, DAMPING = 2e5, 300.0


def network(branches: str, more: str = "") -> NetworkSpec:
    """The network with these branches."""
    text = (
        "format: dashpot-network/1\nname: bench\nbranches:\n" + indent(dedent(branches).strip("\n"), "  ") + "\n" + more
    )
    return parse_network(text, load_registry().elements, "n.yaml")


def run(
    name: str, amplitude: float, frequency: float, law, kind: str = "harmonic", first: int = 100, middle: float = 0.0
) -> ScoredRun:
    """A sine whose force is ``law(x, v, a)``."""
    omega = 2.0 * np.pi * frequency
    x, v = middle + amplitude * np.sin(omega * TIME), amplitude * omega * np.cos(omega * TIME)
    a = -amplitude * omega**2 * np.sin(omega * TIME)
    return ScoredRun(name, kind, drive_from_path(DT, x, v, a), law(x, v, a), first)


def kelvin_voigt(x, v, a):
    """A spring and a damper in parallel."""
    return STIFFNESS * x + DAMPING * v


def runs(law=kelvin_voigt) -> list[ScoredRun]:
    """Two sines of other amplitude and frequency."""
    return [run("slow", 2e-3, 2.0, law), run("fast", 1e-3, 11.0, law, first=300)]


KELVIN_VOIGT = """
    rubber: {element: spring, stiffness: {start: 1e5}}
    oil: {element: damper, damping: {start: 1000}}
"""


def ready(branches: str, scored: list[ScoredRun], more: str = "", **options):
    """Network, objective and coordinates, with ranges from the runs."""
    spec = with_ranges(network(branches, more), natural_sizes(scored))
    return spec, Objective(compile_network(spec), scored, **options), search_coordinates(spec)


def rows_of(objective, values, which, shifts):
    """The residual (samples,) at values (slots,), and its changes (len(which), samples) when slots move."""
    moves = np.zeros((len(which), len(values)))
    moves[np.arange(len(which)), which] = shifts
    rows = np.hstack(list(objective.linearise(values, moves, lambda _, rows: rows.copy())))
    return rows[0], rows[1:]


def jacobian_of(objective, coordinates, point):
    """The residual (samples,) and its Jacobian (p, samples) after natural steps."""
    rows = np.hstack(list(linearise(objective, coordinates, point).each(lambda _, rows: rows.copy())))
    return rows[0], rows[1:]
