"""A slider that nobody put into the model."""

import numpy as np

from dashpot import Cause, added_branch


class MissingSlider(Cause):
    """The force of a soft slider, over a grid of the travel in which it gives way."""

    word, kind, about = "missing_slider", "specimen", "a slider that gives way gradually"
    shows = "the loop keeps its width however slowly it is driven, and is rounded after a reversal"
    confused_with = {"friction": "a loop of small amplitude: this slider is softer right after a reversal"}

    def suspects(self, view, network):
        """A soft slider of unknown limit for each travel in which it gives way; its stiffness is limit over travel."""
        travels = np.geomspace(0.002, 0.5, 12) * view.stroke
        units = {"limit": "N", "stiffness": "N/m"}
        yield added_branch("soft_slider", "soft_slider", travels, numbers, units)


def numbers(limit, travel):
    """The parameters of a soft slider of this limit (N) and travel (m)."""
    return {"limit": limit, "stiffness": limit / travel}
