"""A header and a source in C99."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.contract.export import Export
from dashpot.model.network import NetworkSpec


class C(Export):
    """A header and a source in C99 that need nothing but ``math.h``: no allocation, for a hard real-time loop."""

    word = "c"

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``NAME.h`` and ``NAME.c``."""
        from dashpot.kernel.export import exported
        from dashpot.kernel.targets.c99.header import identifier, print_header
        from dashpot.kernel.targets.c99.source import print_source

        found, name = exported(network), identifier(network.name)
        header = print_header(found.online, network.name, found.title, network.identified)
        source = print_source(found.online, network.name, found.values, found.units, network.identified.range)
        return {f"{name}.h": header.encode(), f"{name}.c": source.encode()}
