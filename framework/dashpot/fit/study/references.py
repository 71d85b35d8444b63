"""Whether what was measured by other means can stand beside the parameters of a study's models."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.data.reference import Reference
from dashpot.fit.excited import is_over_velocity
from dashpot.fit.study.declaration import StudySpec
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError


def require_references(study: StudySpec, references: Mapping[str, Reference]) -> None:
    """InputError for a reference of another kind or unit than the parameter of its path in any model.

    A reference of a parameter that no model has is left alone: a dataset serves many studies.
    """
    for plan in study.models:
        _require(plan.network, references)


def _require(network: NetworkSpec, references: Mapping[str, Reference]) -> None:
    numbers, curves = {slot.path: slot.value for slot in network.slots()}, network.curves()
    for path, reference in references.items():
        if path in numbers:
            reference.number(numbers[path].unit)
        elif path in curves and (reference.text or not is_over_velocity(curves[path])):
            got = f"the number {reference.text}" if reference.text else "a force over velocity"
            message = f"the reference of '{path}' is {got}, in '{network.name}' it is another curve"
            raise InputError.at(reference.place, message, "only curves of force over velocity can be compared")
