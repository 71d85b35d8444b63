"""A fingerprint of what was measured."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence

import numpy as np

from dashpot.data.run import Run


def digest_runs(runs: Sequence[Run]) -> str:
    """sha256 of the samples and of what they mean, in hexadecimal; names of files and folders play no part."""
    sum_of_all = hashlib.sha256()
    for run in runs:
        sum_of_all.update(json.dumps(_meaning(run), sort_keys=True, ensure_ascii=False).encode())
        for name in sorted(run.channels):
            sum_of_all.update(np.ascontiguousarray(run.channels[name], dtype="<f8").tobytes())
    return sum_of_all.hexdigest()


def _meaning(run: Run) -> dict[str, object]:
    return {
        "name": run.name,
        "kind": run.kind,
        "sample_time": run.sample_time,
        "samples": int(run.time.size),
        "channels": sorted(run.channels),
        "settings": dict(run.settings),
        "notes": dict(run.notes),
        "group": run.group,
        "held_out": run.held_out,
        "sensors": {name: dict(values) for name, values in run.sensors.items()},
    }
