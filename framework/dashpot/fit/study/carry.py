"""Numbers taken over from a model that was identified before."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dashpot.model.network import NetworkSpec, Value


def carry_over(spec: NetworkSpec, source: NetworkSpec) -> NetworkSpec:
    """The network with the curves that `source` has taken from data, and with its parameters of the same path.

    A number that is fixed in the network stays; one beyond its bounds comes to the nearest.
    """
    taken = source.data_curves()
    for path, curve in spec.data_curves().items():
        if curve.form == "data" and path in taken and taken[path].form == "table":
            spec = spec.with_curve(path, taken[path])
    known = {slot.path: slot.value for slot in source.slots()}
    alike = [slot for slot in spec.slots() if slot.value.searched and slot.path in known]
    return spec.with_values({slot.path: _moved(slot.value, known[slot.path].number) for slot in alike})


def _moved(value: Value, number: float) -> Value:
    low, high = value.bounds or (-np.inf, np.inf)
    return replace(value, number=float(np.clip(number, low, high)))
