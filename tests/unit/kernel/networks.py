"""Networks of the built-in elements, written in a line."""

from __future__ import annotations

from textwrap import dedent, indent

from dashpot import load_registry
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import parse_network

ELEMENTS = load_registry().elements
HEAD = "format: dashpot-network/1\nname: bench\nbranches:\n"


def network(branches: str, more: str = "") -> NetworkSpec:
    """The network with these branches."""
    return parse_network(HEAD + indent(dedent(branches).strip("\n"), "  ") + "\n" + more, ELEMENTS, "n.yaml")


def compiled(branches: str, more: str = "") -> CompiledNetwork:
    """The same, compiled."""
    return compile_network(network(branches, more))
