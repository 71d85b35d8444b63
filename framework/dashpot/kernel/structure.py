"""What the program of a network depends on: its laws and how its curves are written, none of its numbers.

Networks that are built alike share one program, so that moving a number, as every fit does, traces nothing again.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from dashpot.expr.interpret import Recipe
from dashpot.kernel.source import print_source
from dashpot.kernel.tiers import Program, sort_tiers
from dashpot.kernel.trace import trace_network
from dashpot.model.element import Element
from dashpot.model.network import Branch, NetworkSpec
from dashpot.model.topology import Topology

KEPT = 512


@dataclass(frozen=True)
class Build:
    """A network by its structure; ``parts`` are there to build it once."""

    structure: Hashable
    parts: Any = field(compare=False)


def structure_of(topology: Topology) -> Hashable:
    """What the equations of a network with nodes depend on."""
    joints = tuple(
        (joint.name, joint.hold, joint.numbers, tuple(joint.masses), joint.mounted)
        for joint in topology.joints.values()
    )
    edges = tuple((_structure(edge.branch), edge.lower, edge.upper, edge.offset) for edge in topology.edges)
    return joints, edges


def program_of(spec: NetworkSpec) -> Program:
    """The program of a network with two ends. Raises TraceError and InputError as tracing does."""
    return _program(Build(tuple(_structure(branch) for branch in spec.leaves()), spec))


@lru_cache(KEPT)
def source_of(program: Program, vectors: int, alone: bool) -> str:
    """The text of a program for a kind of group; see ``print_source``."""
    return print_source(program, vectors, alone)


@lru_cache(KEPT)
def recipe_of(program: Program) -> Recipe:
    """How the constants of a program come from the numbers of a lane."""
    return Recipe(program.constants)


@lru_cache(KEPT)
def _program(build: Build) -> Program:
    return sort_tiers(trace_network(build.parts))


def _structure(branch: Branch) -> Hashable:
    curves = tuple((key, curve.form, len(curve.values)) for key, curve in branch.characteristics().items())
    return branch.name, branch.numbers, branch.element, _law(branch.element), tuple(branch.values), curves


def _law(element: type[Element]) -> Hashable:
    # a law may change with the methods and constants of its class
    entries = [entry for base in element.__mro__ for entry in vars(base).items()]
    return tuple((key, value) for key, value in entries if callable(value) or isinstance(value, float | int | str))
