"""What the parameters of a network mean, as their elements declare them."""

from __future__ import annotations

from dashpot.model.network import NetworkSpec, Slot


def meanings_of(spec: NetworkSpec) -> dict[str, str]:
    """The meaning of every parameter and curve of a branch, by its path without an index."""
    found: dict[str, str] = {}
    for branch in spec.leaves():
        parameters = branch.element.declares.parameters
        found |= {f"{branch.numbers}.{key}": parameter.about for key, parameter in parameters.items()}
        curves = branch.characteristics()
        found |= {f"{branch.numbers}.{key}": written.curve.about for key, written in curves.items()}
    return found


def described(slot: Slot, meanings: dict[str, str]) -> str:
    """What a parameter is, and whether it was identified; of one that no element declares, the latter."""
    meaning = meanings.get(slot.path.partition("[")[0], "")
    return f"{meaning}, {slot.value.role}" if meaning else f"{slot.value.role} number"
