"""Where to begin the search of the ends of a force: where the measured forces end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from dashpot.data.steady import STEADY
from dashpot.fit.scored import ScoredRun
from dashpot.model.network import NetworkSpec

LARGEST, LEAST = "force.largest", "force.least"


def ends_from_records(spec: NetworkSpec, runs: Sequence[ScoredRun]) -> NetworkSpec:
    """The network whose searched ``largest`` and ``least`` force begin among the measured forces, within their bounds.

    An end beyond all forces changes nothing, so that no search would move it; and no record goes beyond its end. So
    ``largest`` begins at the largest measured force at the latest, and ``least``, which is one of the specimen, at the
    least one, with offset and gain of the channel taken back. One that begins between them stays; so do both where
    there are tables only, which tell no forces.
    """
    records = [run.force[run.first :] for run in runs if run.kind != STEADY]
    searched = {key: value for key, value in spec.measurement.items() if key in (LARGEST, LEAST) and value.searched}
    if not records or not searched:
        return spec
    offset, gain = (spec.measurement.get(key) for key in ("force.offset", "force.gain"))
    low, high = min(map(np.min, records)), max(map(np.max, records))
    lifted = (low - (offset.number if offset else 0.0)) / (gain.number if gain else 1.0)
    changed = {}
    for key, value in searched.items():
        number = min(value.number, high) if key == LARGEST else max(value.number, lifted)
        inside = float(np.clip(number, *(value.bounds or value.sensible)))
        changed[f"measurement.{key}"] = replace(value, number=inside)
    return spec.with_values(changed)
