"""Stiffness that is lost where the specimen has been."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {"stiffness": "N/m", "depth": "m", "exponent": "1", "widening": "1"}
PLACES = 6
WIDENING = 0.1


class BeddingIn(Cause):
    """A part of the stiffness that the largest deflection so far takes away (Mullins effect)."""

    word = "bedding_in"
    kind = "specimen"
    about = "bedding-in (Mullins effect)"
    shows = "the first cycles, and every first excursion beyond what was reached before, are stiffer than what follows"
    confused_with = {
        "creep": "repeat the run at once: what has bedded in stays soft, creep begins anew with the preload",
        "softening": "repeat the run after a rest: warmth is gone, bedding-in is not",
        "amplitude_softening": "the amplitude ladder up and down again: bedding-in does not come back",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A spring that its largest deflection softens, for good or below that deflection, over its depth."""
        low, high = view.reach
        far = max(abs(low), abs(high))
        grid = tuple(np.geomspace(0.05 * far, 5.0 * far, PLACES))
        yield added_branch(
            "bedding_in",
            "bedding_in",
            grid,
            lambda k, depth: {"stiffness": k, "depth": depth, "exponent": 1.0},
            UNITS,
            unknowns=2,
        )
        yield added_branch("mullins", "bedding_in", grid, lambda k, depth: {"stiffness": k, "depth": depth}, UNITS)
        yield added_branch(
            "mullins",
            "bedding_in",
            grid,
            lambda k, depth: {"stiffness": k, "depth": depth, "widening": WIDENING},
            UNITS,
            unknowns=2,
            form="mullins, the wider the further it went",
        )
