"""What an exporter promises: files by which a network is used elsewhere."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import ClassVar

from dashpot.model.network import NetworkSpec


class Export(ABC):
    """Writes a network for another program.

    Examples:
        >>> class Listed(dp.Export):
        ...     '''The numbers of a network, a line each.'''
        ...     word = "listed"
        ...     def files(self, network):
        ...         lines = [f"{slot.path} {slot.value.number!r}" for slot in network.slots()]
        ...         return {f"{network.name}.txt": "\\n".join(lines).encode()}
        >>> Listed().files(dp.load("spring"))["spring.txt"].decode().splitlines()
        ['spring.stiffness[0] 0.0', 'spring.stiffness[1] 200.0']
    """

    word: ClassVar[str]
    """The name of the target on the command line."""

    @abstractmethod
    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """The content of every file by its name.

        Raises InputError for a network that the target cannot express; nothing is written then.
        """
