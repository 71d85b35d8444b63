"""A network whose numbers are known: nothing of it is searched any more."""

from __future__ import annotations

from dataclasses import replace

from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError, Place


def fixed_as_found(spec: NetworkSpec) -> NetworkSpec:
    """The network with all its numbers fixed as they stand, and its curves from data as plain tables.

    Raises InputError for a curve that has not been taken from any data yet.
    """
    for path, curve in spec.data_curves().items():
        if curve.form == "data":
            place = curve.node.place if curve.node else Place()
            raise InputError.at(
                place,
                f"the curve '{path}' is to be taken from data and has no knots yet",
                "fit this network first and use the file that the fit writes",
            )
        spec = spec.with_curve(path, replace(curve, data=""))
    return spec.with_values({slot.path: slot.value.as_role("fixed") for slot in spec.slots()})
