"""The elastic backbone of a specimen from a slow loading and unloading test."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .loop import Loop, mean_loop
from .monotone import fit_rising, noise_of_rising

_KNOT_DISTANCE = 1e-3
_FEWEST_KNOTS, _MOST_KNOTS = 16, 24
_INTERIOR = (0.25, 0.75)
_JUMP_SHARE = 1.0 - np.exp(-1.0)


@dataclass(frozen=True)
class Backbone:
    """A rising table of force (m,) N over deflection (m,) m, and the friction around it.

    half_width: (m,) N, half the width of the loop at the knots; friction: N, its value in the interior, the sum of the
    friction limits; both NaN when only one direction was measured (`complete` is False): the force then still holds the
    friction of that direction. loops: full loops in the record; error: (m,) N, standard errors of the force at knots,
    from the scatter of the mid line about the table; infinite where they are not known.
    """

    deflection: np.ndarray
    force: np.ndarray
    half_width: np.ndarray
    friction: float
    complete: bool
    loops: int
    error: np.ndarray


@dataclass(frozen=True)
class FrictionStart:
    """Starting values of one friction element: limit N, and travel m that does 63 % of the jump at a reversal."""

    limit: float
    travel: float

    @property
    def stiffness(self) -> float:
        """Slope of the friction force at rest, N/m."""
        return self.limit / self.travel


def extract_backbone(displacement: np.ndarray, force: np.ndarray, knots: int | None = None) -> Backbone:
    """Take the mid line of a slow loop, displacement (n,) m and force (n,) N, as a smooth rising table.

    Knots stand about a millimetre apart, 16 to 24 of them unless their number is given. Near its ends the mid line is
    not the backbone yet: friction bends it by up to its own limit; see `correct_backbone`.
    Raises ValueError when nothing moves.
    """
    loop = mean_loop(displacement, force)
    places = _knots(loop, knots)
    force = fit_rising(loop.deflection, loop.middle, places)
    left = loop.middle - _between(places, force, loop.deflection)
    errors, freedom = noise_of_rising(loop.deflection, places)
    return Backbone(
        deflection=places,
        force=force,
        half_width=np.interp(places, loop.deflection, loop.half_width),
        friction=interior_width(loop),
        complete=loop.complete,
        loops=loop.count,
        error=np.sqrt(np.sum(left**2) / max(left.size - freedom, 1.0)) * errors,
    )


def correct_backbone(
    backbone: Backbone, displacement: np.ndarray, measured: np.ndarray, simulated: np.ndarray
) -> Backbone:
    """Move the backbone by what the measured mid line has more than the simulated one.

    `simulated` (n,) N is the force of the present backbone together with the friction model over the same displacement
    (n,) m. With the right friction one such step leaves no bias at the ends; otherwise fit the friction and repeat.
    """
    missing = mean_loop(displacement, measured - simulated)
    inside = backbone_force(backbone, missing.deflection)
    return replace(backbone, force=fit_rising(missing.deflection, inside + missing.middle, backbone.deflection))


def backbone_force(backbone: Backbone, deflection: np.ndarray) -> np.ndarray:
    """Force of the table between its knots, monotone cubic (PCHIP); the range is not left."""
    return _between(backbone.deflection, backbone.force, deflection)


def _between(knots: np.ndarray, force: np.ndarray, deflection: np.ndarray) -> np.ndarray:
    from scipy.interpolate import PchipInterpolator

    return np.asarray(PchipInterpolator(knots, force)(np.clip(deflection, knots[0], knots[-1])))


def friction_start(displacement: np.ndarray, force: np.ndarray) -> FrictionStart:
    """Limit and travel of friction from the width of a slow loop.

    Right after a reversal the loop opens like 2 limit (1 - exp(-way / travel)); the backbone cancels in its width.
    Raises ValueError when one direction was not measured, or loading is not above unloading.
    """
    loop = mean_loop(displacement, force)
    if not loop.complete:
        raise ValueError(
            "expected a loop with loading and unloading, got one direction only; "
            "give the friction start values by hand, or a run that turns round"
        )
    limit = interior_width(loop)
    if limit <= 0.0:
        raise ValueError(
            f"expected a loop that dissipates, got a friction force of {limit:.3g} N; there is none to start from, "
            "or a channel has the wrong sign"
        )
    return FrictionStart(limit, _opening_travel(loop, limit))


def touch_point(backbone: Backbone, low: float = 200.0, high: float = 1000.0) -> float:
    """Deflection m at which contact begins: the line through the backbone between two forces N, carried on to zero.

    The force must have been zeroed without contact. Raises ValueError when the backbone does not reach these forces.
    """
    places = np.linspace(backbone.deflection[0], backbone.deflection[-1], 1001)
    force = backbone_force(backbone, places)
    seen = (force >= low) & (force <= high)
    if force[-1] < high or seen.sum() < 2:
        raise ValueError(
            f"expected a backbone through {low:g} to {high:g} N, got {force[0]:.4g} to {force[-1]:.4g} N; "
            "give the forces between which the line is to be laid"
        )
    slope, offset = np.polyfit(places[seen], force[seen], 1)
    return float(-offset / slope)


def _knots(loop: Loop, knots: int | None) -> np.ndarray:
    step = loop.deflection[1] - loop.deflection[0]
    start, stop = loop.deflection[0] - 0.5 * step, loop.deflection[-1] + 0.5 * step
    count = knots or int(np.clip(round((stop - start) / _KNOT_DISTANCE) + 1, _FEWEST_KNOTS, _MOST_KNOTS))
    return np.linspace(start, stop, count)


def interior_width(loop: Loop) -> float:
    """Half the width of a loop in its middle half, where friction is fully developed, N."""
    low, high = np.quantile(loop.deflection, _INTERIOR)
    return float(np.median(loop.half_width[(loop.deflection >= low) & (loop.deflection <= high)]))


def _opening_travel(loop: Loop, limit: float) -> float:
    """Way after a reversal, mean of both ends, at which the loop is 63 % open."""
    step = loop.deflection[1] - loop.deflection[0]
    ways = step * (np.arange(len(loop.deflection)) + 0.5)
    opening = 0.5 * (loop.half_width + loop.half_width[::-1])
    rising = np.maximum.accumulate(opening)
    return float(np.interp(_JUMP_SHARE * limit, np.append(0.0, rising), np.append(0.0, ways)))
