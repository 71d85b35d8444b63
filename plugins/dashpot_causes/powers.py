"""What dampers with a power of the velocity share: which powers are turbulent, and where their force is told."""

from __future__ import annotations

from dashpot.contract.cause import Suspect, View, added_branch

NEARLY_ONE = (0.9, 1.1)  # powers that still stand for a dashpot
NEARLY_TWO = (1.7, 2.3)  # powers that still stand for turbulent flow
SHARE = 0.3  # of the largest speed


def reference_speed(view: View) -> float:
    """The velocity in m/s, rounded, at which the force of a power is told."""
    return float(f"{SHARE * view.speed:.2g}")


def power_near(view: View, branch: str, power: float, bounds: tuple[float, float], form: str) -> Suspect:
    """The suspect that a damper is missing whose power of the velocity is near to a whole one, within ``bounds``."""
    reference = reference_speed(view)
    return added_branch(
        "power_law_damper",
        branch,
        (power,),
        lambda force, exponent: {"force": force, "exponent": exponent, "reference": reference},
        {"force": "N", "exponent": "1", "reference": "m/s"},
        fixed=("reference",),
        bounds={"exponent": bounds},
        form=form,
    )
