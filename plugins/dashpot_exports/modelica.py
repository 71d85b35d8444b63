"""A Modelica model."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.contract.export import Export
from dashpot.kernel.export import exported
from dashpot.kernel.targets.c99.header import identifier
from dashpot.kernel.targets.modelica.model import print_model
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError, Place


class Modelica(Export):
    """A Modelica package: a model with two flanges that samples its deflection and holds its force in between.

    Networks with nodes whose motion has to be solved for are refused.
    """

    word = "modelica"

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``NAME.mo``."""
        found = exported(network)
        if found.online.system:
            nodes = ", ".join(f"'{node}'" for node in found.online.free) or "several driven nodes"
            raise InputError.at(Place(network.file), f"the network has {nodes} whose motion is solved for, which the "
                                "Modelica model cannot", "export it with --to fmu")  # fmt: skip
        name = identifier(network.name)
        text = print_model(found.online, name, found.title, found.values, found.units)
        return {f"{name}.mo": text.encode()}
