"""A fixture that gives way."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_measurement
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
PROBE = 1e-9  # m/N
MOST = 30.0  # times the prediction of the linear step


class FixtureCompliance(Cause):
    """The specimen is deflected less than measured, by the force over the stiffness of the fixture."""

    word = "fixture_compliance"
    kind = "measurement"
    about = "compliance of the fixture"
    shows = "the specimen looks softer, the more so the stiffer it is; mostly absorbed by the parameters of the model"
    cure = "measure the displacement across the specimen, or a rigid bar in its place and subtract its deflection"
    evidence_of = "data_sheet"
    confused_with = {
        "stiffness_curve": "a rigid bar in place of the specimen: its deflection is that of the fixture",
        "delay": "a rigid bar in place of the specimen",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A deflection in proportion to the force, ahead of the whole network."""
        if "force.compliance" not in network.measurement:
            yield Suspect(
                "compliance", (0.0,), _lost, _extend, unknowns=0, measured=True, quantity="compliance", unit="m/N"
            )


def _lost(view: View, run: str) -> Array:
    moved = view.moved(run, -PROBE * view.force(run))
    return (moved - view.force(run))[None] / PROBE


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    compliance = atoms[0][0]
    bounds = f"[0 m/N, {pretty(MOST * compliance, 'm/N', 6)}]"
    return add_measurement(text, "compliance", f"{{start: {pretty(compliance, 'm/N', 6)}, bounds: {bounds}}}")
