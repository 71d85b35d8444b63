"""The stages that make the program of a network, called in order.

A program depends on the laws of a network and on how its curves are written, on none of its numbers. Networks that are
built alike share one program, so that moving a number, as every fit does, traces nothing again.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from dashpot.expr.interpret import Recipe
from dashpot.expr.node import Node, constant, symbol, symbols_of
from dashpot.expr.written import write_graphs
from dashpot.kernel.compiler.equations import write_equations
from dashpot.kernel.compiler.kept import kept_graphs
from dashpot.kernel.compiler.mechanics import DONE, Meter, driven_symbol, force_row, row_of
from dashpot.kernel.compiler.multistep import KEPT_TANGENTS, PACE, TURNS
from dashpot.kernel.compiler.tiers import Regrouping, hoist, shared_nodes, sort_tiers
from dashpot.kernel.compiler.trace import refuse_missing_numbers, trace_along, trace_network
from dashpot.kernel.following import channel_symbols, dependences, without_channels
from dashpot.kernel.ir.layout import Layout, shelves_of
from dashpot.kernel.ir.online import Online
from dashpot.kernel.ir.program import Program
from dashpot.kernel.ir.system import SystemProgram
from dashpot.model.element import Element
from dashpot.model.network import Branch, NetworkSpec
from dashpot.model.topology import Topology, topology_of

KEPT = 512  # programs
RECIPES = 64  # of constants: a search goes through many networks, and a recipe is larger than its program

Passes = Mapping[str, Mapping[str, Node]]


@dataclass(frozen=True)
class _Build:
    """A network by its structure; ``parts`` are there to build it once."""

    structure: Hashable
    parts: Any = field(compare=False)


def program_of(spec: NetworkSpec) -> Program:
    """The program of a network with two ends. Raises InputError as tracing does."""
    return _program(_Build(tuple(_structure(branch) for branch in spec.leaves()), spec))


def system_of(
    spec: NetworkSpec, topology: Topology, meter: Meter | None = None, signals: Sequence[str] = ()
) -> SystemProgram:
    """The program of a network with unknown nodes; a ``meter`` goes along, and laws may refer to ``signals``."""
    build = _Build((_structure_of(topology), tuple(signals)), (spec, topology, tuple(signals)))
    return _metered(build, meter) if meter else _shared(build)


def online_of(spec: NetworkSpec) -> Online:
    """The program of a network that somebody else steps: nothing is measured there, numbers over channels stay.

    InputError for a curve that has no numbers yet.
    """
    refuse_missing_numbers(spec)
    spec = without_channels(spec)
    topology = topology_of(spec)
    system = None if topology.parallel else system_of(spec, topology)
    program = system.program if system else program_of(spec)
    tables = [curve for curve in spec.curves().values() if curve.form == "table"]
    return Online(
        program,
        system,
        topology.held("driven"),
        topology.held("loaded"),
        topology.unknown,
        {inner: joint for joint, inner in topology.mounts.items()},
        tuple(slot.path for slot in spec.slots()),
        spec.gravity,
        shelves_of(spec.curves()),
        tuple(at for curve in tables for at in (curve.at[0], *curve.at)),
    )


@lru_cache(RECIPES)
def recipe_of(program: Program) -> Recipe:
    """How the constants of a program come from the parameters of a lane."""
    return Recipe(program.constants)


@lru_cache(KEPT)
def _program(build: _Build) -> Program:
    spec = build.parts
    laws = tuple(_traced(branch) for branch in spec.leaves())
    return Program.from_graphs(*kept_graphs(laws, lambda: sort_tiers(trace_network(spec)).graphs()))


@lru_cache(KEPT)
def _shared(build: _Build) -> SystemProgram:
    spec, topology, signals = build.parts
    laws = tuple(_traced(edge.branch) for edge in topology.edges)
    shelves = tuple(shelves_of(spec.curves()).items())

    def make() -> dict[str, Any]:
        program, passes, known = _sorted_equations(topology, None, signals)
        return {"program": program.graphs(), "passes": passes, "known": {name: symbol(name) for name in known}}

    graphs, digest = kept_graphs((laws, _places_of(topology), signals, shelves), make)
    program = Program.from_graphs(graphs["program"], digest)
    return _system_program(build, program, graphs["passes"], frozenset(graphs["known"]))


def _metered(build: _Build, meter: Meter) -> SystemProgram:
    _, topology, signals = build.parts
    return _system_program(build, *_sorted_equations(topology, meter, signals))


def _system_program(build: _Build, program: Program, passes: Passes, known: frozenset[str]) -> SystemProgram:
    spec, topology, _ = build.parts
    shelves = shelves_of(spec.curves())
    return SystemProgram(
        program,
        {name: Layout(program, rows, shelves=shelves) for name, rows in passes.items()},
        [force_row(joint) for joint in topology.held("driven")],
        [row_of(joint, "position") for joint in topology.unknown],
        DONE,
        known,
        *((TURNS, KEPT_TANGENTS, PACE) if "turn" in passes else ()),
    )


def _sorted_equations(
    topology: Topology, meter: Meter | None, signals: Sequence[str]
) -> tuple[Program, Passes, frozenset[str]]:
    equations = write_equations(topology, meter)
    roots = [node for rows in equations.passes.values() for node in rows.values()]
    channels = channel_symbols(name for root in roots for name in symbols_of(root))
    known = equations.known | {driven_symbol(signal, "load") for signal in signals} | channels
    regroup = Regrouping(set(equations.rows), set(known), shared_nodes(roots))
    passes = {name: {row: regroup(node) for row, node in rows.items()} for name, rows in equations.passes.items()}
    columns, constants, _ = hoist([node for rows in passes.values() for node in rows.values()], (), regroup.tiers)
    zero = constant(0.0)
    program = Program(columns, constants, (), {}, zero, dict.fromkeys(equations.rows, zero), (), (), {})
    return program, passes, known


def _structure_of(topology: Topology) -> Hashable:
    return _places_of(topology), tuple(_structure(edge.branch) for edge in topology.edges)


def _places_of(topology: Topology) -> Hashable:
    joints = tuple(
        (joint.name, joint.hold, joint.numbers, tuple(joint.masses), joint.mounted)
        for joint in topology.joints.values()
    )
    return joints, tuple((edge.branch.name, edge.lower, edge.upper, edge.offset) for edge in topology.edges)


def _structure(branch: Branch) -> Hashable:
    curves = tuple((key, curve.form, len(curve.values)) for key, curve in branch.characteristics().items())
    law, followed = _law(branch.element), dependences(branch)
    return branch.name, branch.numbers, branch.element, law, tuple(branch.values), curves, followed


def _law(element: type[Element]) -> Hashable:
    # a law may change with the methods and constants of its class
    entries = [entry for base in element.__mro__ for entry in vars(base).items()]
    return tuple((key, value) for key, value in entries if callable(value) or isinstance(value, float | int | str))


def _traced(branch: Branch) -> str:
    """The law of a branch as a text; the graphs of every sight differ in the names of the motion alone."""
    return _law_text(_Build(_structure(branch), branch))


@lru_cache(KEPT)
def _law_text(build: _Build) -> str:
    traced = trace_along(build.parts, "path")
    return f"{traced.name}: {write_graphs((traced.force, dict(traced.states), traced.stops or ()))}"
