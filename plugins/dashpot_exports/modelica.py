"""A Modelica model."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.contract.export import Export
from dashpot.model.network import NetworkSpec
from dashpot_exports.description import described

KEYWORDS = frozenset(
    "algorithm and annotation block break class connect connector constant constrainedby der discrete each else "
    "elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for "
    "function if import impure in initial inner input loop model not operator or outer output package parameter "
    "partial protected public pure record redeclare replaceable return stream then true type when while within".split()
)


class Modelica(Export):
    """A Modelica package: a model with a flange for each driven end that samples its motion and holds its force.

    Its documentation states the law of every branch.
    """

    word = "modelica"

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``NAME.mo``."""
        from dashpot.kernel.export import exported
        from dashpot.kernel.targets.c99.header import identifier
        from dashpot.kernel.targets.modelica.model import print_model

        found = exported(network)
        name = identifier(network.name)
        name = f"{name}_network" if name in KEYWORDS else name
        text = print_model(found, name, described(found))
        return {f"{name}.mo": text.encode()}
