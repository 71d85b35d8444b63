"""Where a report comes from: what one needs to make the same again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from dashpot.report.evidence import Evidence


def colophon(result: Mapping[str, Any], evidence: Evidence) -> tuple[tuple[str, str], ...]:
    """Names and digests from the result file, then the entries of `provenance` in their order."""
    entries = {"result format": result.get("format")}
    for key in ("model", "dataset"):
        described = result.get(key) or {}
        entries |= {key: described.get("name"), f"{key} digest": described.get("digest")}
    told = list(entries.values())
    provenance = evidence.get("provenance", {})
    entries |= {key.replace("_", " "): value for key, value in provenance.items() if value not in told}
    return tuple((key, str(value)) for key, value in entries.items() if value is not None)
