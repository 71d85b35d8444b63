"""A branch or a node of a model, its numbers as attributes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from dashpot.model.network import NetworkSpec, Slot
from dashpot.text.problem import nearest
from dashpot.text.quantity import pretty


class Part:
    """What ``model["rubber"]`` gives: ``.stiffness`` is the parameter in SI, and can be set as in a file.

    A parameter with several values, as the knots of a table, is a tuple.

    Examples:
        >>> model = dp.load("kelvin_voigt")
        >>> model["damping"].damping = "0.4 N*s/mm"
        >>> model["damping"].damping
        400.0
        >>> model["damping"].element
        'damper'
    """

    __slots__ = ("_name", "_set", "_spec")

    def __init__(self, spec: NetworkSpec, name: str, change: Callable[[str, str, Any], None]) -> None:
        object.__setattr__(self, "_spec", spec)
        object.__setattr__(self, "_name", name)
        object.__setattr__(self, "_set", change)

    @property
    def element(self) -> str:
        """The word of its law; nothing for a node or a group."""
        words = [branch.element.word for branch in self._spec.leaves() if self._name in (branch.name, branch.family)]
        return words[0] if words else ""

    def __getattr__(self, key: str) -> Any:
        found = [slot.value.number for slot in self._slots() if _key(slot) == key]
        if not found:
            known = dict.fromkeys(map(_key, self._slots()))
            raise AttributeError(
                f"'{self._name}' has no parameter '{key}'; "
                f"{nearest(key, known) or 'it has ' + (', '.join(known) or 'none')}"
            )
        return found[0] if len(found) == 1 else tuple(found)

    def __setattr__(self, key: str, value: Any) -> None:
        self._set(self._name, key, value)

    def __dir__(self) -> list[str]:
        return ["element", *dict.fromkeys(map(_key, self._slots()))]

    def __repr__(self) -> str:
        told = [f"{slot.path} = {pretty(slot.value.number, slot.value.unit)}" for slot in self._slots()]
        return ", ".join(told) or self._name

    def _slots(self) -> list[Slot]:
        homes = {
            part.numbers
            for part in (*self._spec.leaves(), *self._spec.joints.values())
            if self._name in (part.name, getattr(part, "family", ""))
        }
        return [slot for slot in self._spec.slots() if slot.path.rpartition(".")[0] in homes]


def _key(slot: Slot) -> str:
    return slot.path.rpartition(".")[2].partition("[")[0]
