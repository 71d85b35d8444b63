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
        ...     '''The names of the parameters of a network.'''
        ...     word = "listed"
        ...     def files(self, network):
        ...         paths = [slot.path for slot in network.slots()]
        ...         return {f"{network.name}.txt": " ".join(paths).encode()}
        >>> Listed().files(dp.load("gehmann"))
        {'gehmann.txt': b'maxwell.stiffness maxwell.relaxation_time'}
    """

    word: ClassVar[str]
    """The name of the target on the command line."""

    @abstractmethod
    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """The content of every file by its name.

        Raises InputError for a network that the target cannot express; nothing is written then.
        """
