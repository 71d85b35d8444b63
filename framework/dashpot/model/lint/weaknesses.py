"""Everything that is weak in the structure of a network."""

from __future__ import annotations

from dashpot.model.lint.graph import find_loose_nodes, find_sliding_nodes
from dashpot.model.lint.power import find_pumps
from dashpot.model.lint.sensitivity import find_equal_starts, find_idle_and_confused
from dashpot.model.network import NetworkSpec
from dashpot.model.topology import topology_of
from dashpot.text.problem import Problem, in_text_order


def find_weaknesses(spec: NetworkSpec) -> tuple[Problem, ...]:
    """Errors where a network cannot be solved, warnings where it can but not as it was meant, in the order of the text.

    A curve that is to come from data is probed as a slightly bent line.
    """
    topology = topology_of(spec, fixture=False)
    problems = [*find_loose_nodes(topology, spec)]
    if any(problem.severity == "error" for problem in problems):
        return in_text_order(problems)
    problems += find_sliding_nodes(topology, spec)
    problems += find_idle_and_confused(topology, spec)
    problems += find_equal_starts(topology)
    problems += find_pumps(spec)
    return in_text_order(problems)
