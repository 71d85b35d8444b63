"""How small an effect the silence of a diagnosis is about."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dashpot.assess.screen import POWER_95, Columns, Limit
from dashpot.assess.suspicion import left_by_refit


def of_interest(limit: Limit, columns: Columns, least_force: float) -> Limit:
    """The limit where effects of which a refit seems to leave less than ``least_force`` (RMS, N) are not named.

    The size that it seems to have scatters about the true one, which has to be that much larger.
    """
    seems = least_force * limit.strength / max(left_force(limit, columns), 1e-300)
    grown = max(1.0, (seems + POWER_95 * limit.deviation) / limit.strength)
    return replace(limit, strength=grown * limit.strength, force=grown * limit.force)


def left_force(limit: Limit, columns: Columns) -> float:
    """The RMS in N that a refit leaves of an effect at its limit; all runs weigh the same."""
    strengths = np.zeros(columns.bank.size)
    strengths[limit.column] = limit.strength
    effect = {run: columns.bank.combined(strengths, run) for run in columns.residual}
    return float(np.sqrt(left_by_refit(columns.tangents, effect) / len(effect)))
