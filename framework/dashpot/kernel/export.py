"""What exporters need of a network: its program, its numbers, and where both come from."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from dashpot import __version__
from dashpot.kernel.compiler.compile import online_of
from dashpot.kernel.ir.online import Online
from dashpot.kernel.settings import used_settings, with_settings
from dashpot.model.meanings import described, meanings_of
from dashpot.model.network import NetworkSpec, Slot


@dataclass(frozen=True, eq=False)
class Exported:
    """A network ready to be printed; ``values`` are those of its ``slots`` in SI, ``title`` says where from."""

    spec: NetworkSpec
    online: Online
    slots: tuple[Slot, ...]
    values: tuple[float, ...]
    title: str

    @property
    def units(self) -> list[str]:
        """The units of the values."""
        return [slot.value.unit for slot in self.slots]

    @property
    def abouts(self) -> list[str]:
        """What the values mean, and whether they were identified."""
        meanings = meanings_of(self.spec)
        return [described(slot, meanings) for slot in self.slots]


def exported(spec: NetworkSpec, settings: Mapping[str, float] = MappingProxyType({})) -> Exported:
    """The network with its own parameters; InputError where one is missing, or depends on a setting not given."""
    online = online_of(spec)
    slots = spec.slots()
    start = np.array([[slot.value.number for slot in slots]])
    values = with_settings(spec, start, used_settings(spec, settings))[0]
    return Exported(spec, online, slots, tuple(values.tolist()), f"{spec.name}: {_about(spec)}")


def digest_of(spec: NetworkSpec) -> str:
    """A digest of the text of a network, or, where it was built without one, of what it declares."""
    content = spec.document.text if spec.document else repr([(slot.path, slot.value.number) for slot in spec.slots()])
    return hashlib.sha256(content.encode()).hexdigest()[:16]


def _about(spec: NetworkSpec) -> str:
    found = sum(slot.value.role == "identified" for slot in spec.slots())
    origin = f"{found} of {len(spec.slots())} parameters identified" if spec.slots() else "without parameters"
    record = spec.identified.record
    by = f" ({', '.join(f'{key} {word}' for key, word in record.items())})" if record else ""
    told = spec.identified.told()
    seen = f" with {told}" if told else ""
    source = f", source: {spec.source}" if spec.source else ""
    return f"network {digest_of(spec)}, {origin}{by}{seen}{source}; written by dashpot {__version__}"
