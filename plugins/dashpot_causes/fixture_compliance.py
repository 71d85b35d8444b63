"""A fixture that gives way."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, Suspect, View, unchanged
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]
PROBE = 1e-9  # m/N


class FixtureCompliance(Cause):
    """The specimen is deflected less than measured, by the force over the stiffness of the fixture."""

    word = "fixture_compliance"
    kind = "measurement"
    about = "compliance of the fixture"
    shows = "everything looks softer, the more so the stiffer the specimen; mostly hidden in the numbers of the model"
    cure = "measure the displacement across the specimen, or a rigid bar in its place and subtract its deflection"
    confused_with = {
        "stiffness_curve": "a rigid bar in place of the specimen: its deflection is that of the fixture",
        "delay": "a rigid bar in place of the specimen",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A deflection in proportion to the force, taken out of the measured one."""
        yield Suspect("compliance", (0.0,), _lost, unchanged, unknowns=0, mends=True,
                      quantity="compliance", unit="m/N", tell=_tell)  # fmt: skip


def _lost(view: View, run: str) -> Array:
    moved = view.moved(run, -PROBE * view.force(run))
    return (moved - view.force(run))[None] / PROBE


def _tell(strengths: Sequence[float]) -> Mapping[str, tuple[float, str]]:
    return {"stiffness": (1.0 / max(strengths[0], np.finfo(float).tiny), "N/m")}
