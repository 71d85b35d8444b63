"""Random networks with one to four unknown nodes, of elements that never give back more than was put in."""

from __future__ import annotations

import numpy as np

STIFF = "element: coulomb, limit: {force} N, creep_velocity: {creep} m/s"
LAWS = (
    "element: spring, stiffness: {stiffness} N/m",
    "element: damper, damping: {damping} N*s/m",
    "element: maxwell, stiffness: {stiffness} N/m, relaxation_time: {time} s",
    STIFF,
    "element: dahl, stiffness: {stiffness} N/m, limit: {force} N",
    "element: prandtl, stiffness: {stiffness} N/m, limit: {force} N",
    "element: end_stop, stiffness: {stiffness} N/m, compression: {gap} m",
    "element: contact, stiffness: {stiffness} N/m",
    "element: clearance, stiffness: {stiffness} N/m, gap: {gap} m",
    "element: backlash, stiffness: {stiffness} N/m, gap: {gap} m",
    "element: bouc_wen, stiffness: {stiffness} N/m, limit: {force} N, shape: 0.7, exponent: 1.5",
    "element: iwan, stiffness: {stiffness} N/m, shortest: 0.05 mm, longest: 1 mm",
    "element: quadratic_damper, damping: {damping} N*s^2/m^2",
    "element: loose_friction, limit: {force} N, stiffness: {stiffness} N/m, gap: 0.3 mm",
    "element: asymmetric_damper, compression: {damping} N*s/m, rebound: {other} N*s/m, compression_digression: 3 s/m",
    "element: stribeck, stiffness: {stiffness} N/m, limit: {force} N, breakaway: {higher} N, "
    "stribeck_velocity: {slow} m/s",
    "element: stribeck, stiffness: {stiffness} N/m, limit: {force} N, breakaway: {higher} N, "
    "stribeck_velocity: {slow} m/s, bristle_damping: {damping} N*s/m",
)


def draw_system(rng: np.random.Generator) -> tuple[str, str]:
    """The nodes and the branches of a chain from a driven node to the ground, with some branches across."""
    free = [f"n{number}" for number in range(1, rng.integers(2, 6))]
    holds = [f"{{mass: {_between(rng, 0.05, 30.0)} kg}}" if rng.random() < 0.4 else "free" for _ in free]
    nodes = ["base: driven", "wall: ground", *(f"{name}: {hold}" for name, hold in zip(free, holds, strict=True))]
    chain = ["base", *free, "wall"]
    ends = [pair for pair in zip(chain[:-1], chain[1:], strict=True) for _ in range(rng.integers(1, 4))]
    for _ in range(rng.integers(0, 3)):
        first, second = np.sort(rng.choice(len(chain), 2, replace=False))
        ends.append((chain[first], chain[second]))
    branches = [
        f"e{number}: {{{_law(rng)}, between: [{lower}, {upper}]}}" for number, (lower, upper) in enumerate(ends)
    ]
    return "{" + ", ".join(nodes) + "}", "\n".join(branches)


def _law(rng: np.random.Generator) -> str:
    force = _between(rng, 10.0, 316.0)
    return LAWS[rng.integers(len(LAWS))].format(
        stiffness=_between(rng, 1e4, 2e6),
        force=force,
        higher=round(1.5 * force, 3),
        slow=_between(rng, 1e-3, 1e-1),
        creep=_between(rng, 1e-7, 1e-3),
        damping=_between(rng, 30.0, 1e4),
        other=_between(rng, 30.0, 1e4),
        time=_between(rng, 1e-3, 1.0),
        gap=_between(rng, 3e-4, 3e-3),
    )


def _between(rng: np.random.Generator, low: float, high: float) -> float:
    return float(f"{np.exp(rng.uniform(np.log(low), np.log(high))):.6g}")
