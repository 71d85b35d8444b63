"""What was measured of the specimen by other means, and how far the models of a study are from it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.data.reference import Reference
from dashpot.model.network import NetworkSpec

Json = Mapping[str, Any]

PLACES = 400  # velocities at which two curves are compared


def references_content(
    references: Iterable[Reference], networks: Sequence[NetworkSpec], models: Iterable[Json]
) -> list[dict[str, Any]]:
    """The references that some model has: numbers in SI, or curves with the ``deviations`` of the models from them.

    ``models`` are those of a study's result, ``networks`` their networks.
    """
    units = {slot.path: slot.value.unit for network in networks for slot in network.slots()}
    rows = [(model["name"], curve) for model in models for curve in model["velocity_curves"]]
    found = []
    for each in references:
        curves = [(name, curve) for name, curve in rows if curve["curve"] == each.path]
        told: dict[str, Any] = {"parameter": each.path, "by": each.by}
        if each.path in units:
            found.append(told | {"value": each.number(units[each.path]), "unit": units[each.path]})
        elif curves:
            measured = {"velocity": list(each.velocity), "force": list(each.force)}
            deviations = [{"model": name, **deviation(curve, measured)} for name, curve in curves]
            found.append(told | measured | {"deviations": deviations})
    return found


def deviation(curve: Json, measured: Json) -> dict[str, Any]:
    """How far a curve is from the measured one, both with ``velocity`` (k,) m/s, growing, and ``force`` (k,) N.

    From the least to the largest velocity that the runs ``reached`` and both tables hold: ``within`` (m/s), the RMS of
    the differences as ``rms`` in N and as ``share`` of the RMS of the measured force. All None where there is no such
    range.
    """
    from scipy.interpolate import PchipInterpolator

    ends = [(each["velocity"][0], each["velocity"][-1]) for each in (curve, measured)] + [curve["reached"]]
    low, high = max(end[0] for end in ends), min(end[1] for end in ends)
    if high <= low:
        return {"within": None, "rms": None, "share": None}
    places = np.linspace(low, high, PLACES)
    model, truth = (PchipInterpolator(each["velocity"], each["force"])(places) for each in (curve, measured))
    rms = float(np.sqrt(np.mean((model - truth) ** 2)))
    return {"within": [float(low), float(high)], "rms": rms, "share": rms / float(np.sqrt(np.mean(truth**2)))}
