"""Which way round displacement and force are: a specimen takes up work, and is mostly pressed."""

from __future__ import annotations

import numpy as np

from dashpot.data.importing.correlation import correlation

_CLEAR, _PRESSED = 0.1, 0.5
# a testing machine of class 1 after ISO 7500-1 may make so wide a loop of a force without any
THIN = 0.015
_PULLS = "the force pulls nearly all the time: compression seems to count negative here"
_TURNED = "work would be given back, other than in most runs: the sign is turned here"
_OTHERWISE = (
    "the force falls where the deflection grows, other than in most runs: either a mass outweighs the stiffness, or "
    "the sign of this run is another one"
)
_WHY = {
    (1, 1): "",
    (1, -1): "the force points against the motion as if work were given back: its sign is turned",
    (-1, -1): _PULLS,
    (-1, 1): _PULLS,
}


def find_signs(
    displacement: np.ndarray, force: np.ndarray, common: tuple[int, int] | None = None
) -> tuple[int, int, str]:
    """Signs of displacement and force, and why, where one of them is to be turned.

    Raw numbers of both (n,). The force goes with the velocity where the motion is closed, as work is lost, else with
    the displacement. A force that nearly always pulls is taken for one whose tension counts positive. `common` are the
    signs of most runs: a run that loses work only with another one gets a sign of its own, if that is clear or the
    force falls besides.
    """
    loss, slope = _loss(displacement, force), correlation(displacement, force)
    opposed = loss < 0 if abs(loss) > _CLEAR else slope < 0
    sign = -1 if opposed else 1
    if common is not None:
        turned = sign != common[0] * common[1]
        lost = common[0] * common[1] * lost_work(displacement, force)
        if turned and (abs(loss) > _CLEAR or lost < -THIN):
            return common[0], -common[1], _TURNED
        return *common, _OTHERWISE if turned and abs(slope) > _CLEAR and lost < THIN else _WHY[common]
    if np.mean(sign * force) < -_PRESSED * np.max(np.abs(force)):
        return -1, -sign, _WHY[-1, -sign]
    return (1, -1, _WHY[1, -1]) if opposed else (1, 1, "")


def _loss(displacement: np.ndarray, force: np.ndarray) -> float:
    """How well a force (n,) goes with the velocity, where the motion is closed; 0 where it is not."""
    part = closed_part(displacement)
    return correlation(np.gradient(displacement)[part], force[part])


def closed_part(motion: np.ndarray) -> slice:
    """Where a motion (n,) is closed, from the first to the last passage of its median.

    Nothing where that is less than half of its way, as of a ramp that is held.
    """
    passes = np.flatnonzero(np.diff(motion > np.median(motion))) if motion.size else np.empty(0)
    part = slice(int(passes[0]), int(passes[-1]) + 2) if passes.size else slice(0)
    moved = motion[part]
    return part if moved.size and np.ptp(moved) > 0.5 * np.ptp(motion) else slice(0)


def lost_work(motion: np.ndarray, force: np.ndarray) -> float:
    """The work that a force loses over a motion, as a part of all that is moved; below 0 where it is given back.

    That where the motion is closed: on the way to a preload, or of a ramp that is held, a spring takes up work, too.
    """
    part = closed_part(motion)
    way, middle = np.diff(motion[part]), 0.5 * (force[part][1:] + force[part][:-1])
    middle -= np.mean(force[part]) if middle.size else 0.0
    moved = float(np.sum(np.abs(middle * way)))
    return float(middle @ way) / moved if moved > 0.0 else 0.0


def falls(displacement: np.ndarray, force: np.ndarray) -> bool:
    """Whether a force (n,) that takes up work clearly falls with the deflection (n,); signs have been set."""
    return correlation(displacement, force) < -_CLEAR and _loss(displacement, force) > _CLEAR
