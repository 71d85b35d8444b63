"""The laws of branches for one backward Euler step, from their differential equations.

Every law answers its force at the end of the step, how that changes with the relative velocity there (the place at the
end moves by h times as much), and its branch: a number that changes where the law bends. Elastic and viscous laws
have no memory; hysteretic ones have a force or stretches.
"""

from __future__ import annotations

import math

from numba import njit

MEMORY = 8
# called by compiled functions only
inner = njit(cache=True, no_cpython_wrapper=True, no_cfunc_wrapper=True, error_model="numpy")
(
    SPRING,
    DAMPER,
    MAXWELL,
    COULOMB,
    DAHL,
    PRANDTL,
    STOP,
    BACKLASH,
    CLEARANCE,
    BOUC_WEN,
    IWAN,
    QUADRATIC,
    LOOSE,
    ASYMMETRIC,
    STRIBECK,
) = range(15)
STRETCHED = (BACKLASH, IWAN, LOOSE)  # whose memory is a way, not a force
SHARPNESS = 10.0  # of a Prandtl element: slider over spring


@inner
def branch_force(kind, p, memory, old, x, v, h, new):
    """Force, slope and branch; ``new`` becomes the memory. ``p`` are the numbers, ``old`` and ``x`` the deflections."""
    way = x - old
    side = -1.0 if way < 0.0 else 1.0
    turned = 1 if way < 0.0 else 0
    if kind == SPRING:
        return p[0] * x, p[0] * h, 0
    if kind == DAMPER:
        return p[0] * v, p[0], 0
    if kind == QUADRATIC:
        return p[0] * abs(v) * v, 2.0 * p[0] * abs(v), 1 if v < 0.0 else 0
    if kind == ASYMMETRIC:
        if v > 0.0:
            below = 1.0 + p[2] * v
            return p[0] * v / below, p[0] / (below * below), 0
        return p[1] * v, p[1], 1
    if kind == COULOMB:
        level = math.tanh(v / p[1])
        return p[0] * level, p[0] / p[1] * (1.0 - level * level), 0
    if kind == MAXWELL:
        fades = 1.0 / (1.0 + h / p[1])
        new[0] = (memory[0] + p[0] * way) * fades
        return new[0], p[0] * h * fades, 0
    if kind == STOP:
        return (p[0] * (x - p[1]), p[0] * h, 1) if x > p[1] else (0.0, 0.0, 0)
    if kind == CLEARANCE:
        if abs(x) <= p[1]:
            return 0.0, 0.0, 0
        return (p[0] * (x - p[1]), p[0] * h, 1) if x > 0.0 else (p[0] * (x + p[1]), p[0] * h, 2)
    if kind == BACKLASH:
        new[0] = min(max(memory[0], x - p[1]), x + p[1])
        moved = 1 if new[0] > memory[0] else 2 if new[0] < memory[0] else 0
        return p[0] * new[0], p[0] * h if moved else 0.0, moved
    if kind == DAHL:
        left = (1.0 - side * memory[0] / p[1]) * math.exp(-p[0] * abs(way) / p[1])
        new[0] = side * p[1] * (1.0 - left)
        return new[0], p[0] * h * left, turned
    if kind == PRANDTL:
        return _prandtl(p, memory, way, side, turned, h, new)
    if kind == BOUC_WEN:
        return _bouc_wen(p, memory, way, side, turned, h, new)
    if kind == STRIBECK:
        return _stribeck(p, memory, v, way, side, turned, h, new)
    if kind == LOOSE:
        reach = p[2] + p[1] / p[0]
        new[0] = min(max(memory[0] + way, -reach), reach)
        slips = 1 if new[0] >= reach else 2 if new[0] <= -reach else 0
        taut = max(new[0] - p[2], 0.0) + min(new[0] + p[2], 0.0)
        held = 1 if taut > 0.0 else 2 if taut < 0.0 else 0
        return p[0] * taut, p[0] * h if held and not slips else 0.0, slips + 3 * held
    force, slope, code = 0.0, 0.0, 0
    for k in range(MEMORY):
        travel = p[1] * (p[2] / p[1]) ** (k / 7.0)
        new[k] = min(max(memory[k] + way, -travel), travel)
        slips = 1 if new[k] >= travel else 2 if new[k] <= -travel else 0
        force += 0.125 * p[0] * new[k]
        slope += 0.0 if slips else 0.125 * p[0] * h
        code = 3 * code + slips
    return force, slope, code


@inner
def _prandtl(p, memory, way, side, turned, h, new):
    """u = 1 - F/limit: u1 = u0 - a s u1/(1 + s u1), a quadratic equation."""
    s, before = SHARPNESS, max(1.0 - side * memory[0] / p[1], 0.0)
    a = p[0] * abs(way) / p[1]
    half = 0.5 * (1.0 - s * before + a * s)
    root = math.sqrt(half * half + s * before)
    left = before / (half + root) if half > 0.0 else (root - half) / s
    new[0] = side * p[1] * (1.0 - left)
    return new[0], p[0] * h * s * left / (2.0 * root), turned


@inner
def _bouc_wen(p, memory, way, side, turned, h, new):
    """y = F/limit along the motion: y1 = y0 + a (1 - |y1|^n (shape sgn y1 + 1 - shape)), which only rises with a."""
    before, a = side * memory[0] / p[1], p[0] * abs(way) / p[1]
    low, high = min(1.0, before), max(1.0, before)
    y = min(before + a, 0.5 * (low + high)) if before + a > high else before + a
    slope = 1.0
    for _ in range(100):
        share = 1.0 if y > 0.0 else 1.0 - 2.0 * p[2]
        gap = y - before - a * (1.0 - share * abs(y) ** p[3])
        turn = 1.0 if y > 0.0 else -1.0
        slope = 1.0 + a * p[3] * share * turn * abs(y) ** (p[3] - 1.0)
        low, high = (y, high) if gap < 0.0 else (low, y)
        step = gap / slope
        if abs(step) < 1e-15:
            break
        y = y - step if low < y - step < high else 0.5 * (low + high)
    share = 1.0 if y > 0.0 else 1.0 - 2.0 * p[2]
    new[0] = side * p[1] * y
    return new[0], p[0] * h * (1.0 - share * abs(y) ** p[3]) / slope, turned + (2 if y > 0.0 else 0)


@inner
def _stribeck(p, memory, v, way, side, turned, h, new):
    """A Dahl slider whose limit is that of the speed at the end."""
    above = (p[2] - p[1]) * math.exp(-((v / p[3]) ** 2))
    limit, away = p[1] + above, p[0] * abs(way)
    fades = math.exp(-away / limit)
    new[0] = side * limit - (side * limit - memory[0]) * fades
    falls = -2.0 * v / (p[3] * p[3]) * above
    with_limit = side * (1.0 - fades) - (side * limit - memory[0]) * fades * away / (limit * limit)
    return new[0], p[0] * h * (1.0 - side * memory[0] / limit) * fades + with_limit * falls, turned
