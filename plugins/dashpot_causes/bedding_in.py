"""Stiffness that is lost where the specimen has been."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec
from dashpot_causes.session import REACHED

UNITS = {"stiffness": "N/m", "depth": "m", "exponent": "1", "widening": "1", "before": "m"}
PLACES = 6
HISTORIES: tuple[tuple[Mapping[str, str], str], ...] = (({}, ""), ({"before": REACHED}, ", from run to run"))
# element, form, further parameters
LAWS: tuple[tuple[str, str, Mapping[str, float]], ...] = (
    ("bedding_in", "bedding_in", {"exponent": 1.0}),
    ("mullins", "mullins", {}),
    ("mullins", "mullins, the wider the further it went", {"widening": 0.1}),
)


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
        """A spring that its largest deflection softens, for good or below that deflection, over its depth: within each
        run, or from run to run as well.
        """
        low, high = view.reach
        far = max(abs(low), abs(high))
        grid = tuple(np.geomspace(0.05 * far, 5.0 * far, PLACES))
        for given, since in HISTORIES if _has_history(view) else HISTORIES[:1]:
            for element, form, more in LAWS:

                def values(k: float, depth: float, more: Mapping[str, float] = more) -> Mapping[str, float]:
                    return {"stiffness": k, "depth": depth, **more}

                yield added_branch(
                    element,
                    "bedding_in",
                    grid,
                    values,
                    UNITS,
                    unknowns=1 + len(more),
                    form=form + since,
                    given=given,
                )


def _has_history(view: View) -> bool:
    """Whether the specimen was deflected before any of the runs."""
    return any(view.settings(run).get(REACHED, 0.0) > 0.0 for run in view.runs)
