"""Forces of any network of nodes and elements: backward Euler, extrapolated, with steps that end where a law bends.

An integrator of its own. A step is made with 1, 2, ... 5 equal backward Euler steps; Aitken and Neville's scheme takes
their errors away in turn (Deuflhard, SIAM Review 27 (1985) 505), and the last two columns tell the error that is left.
A law that bends within a step (a reversal, a stop, a gap, a slider that gives way) shows by its branch, which is not
the same in all of these small steps. There no order is relied on: the step has to be so short that one and two steps
give the same, down to 1e-9 s, so that the bend is located, and passed in a step that is too short to matter. Where the
driven node turns is known ahead, and a step ends there: its way beyond would show in none of the small steps.

In a backward Euler step the velocities at its end are the unknowns. The forces of laws that never fall with speed are
the slope of a convex potential of them: Newton's way, and along it the place where the pull ends, between two bounds.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from verification.truth.branches import MEMORY, STRETCHED, branch_force, inner

ORDERS, SHORTEST, MOST = 5, 1e-9, 40_000  # orders; s; steps in a record
ROUNDS, HALVINGS = 100, 80
FAST = 2.0 * math.pi * 20.0  # 1/s, of the fastest motions
BALANCED, BALANCED_SHARE, ROUNDING = 1e-10, 1e-13, 1e-15  # N, of all forces, of a velocity


@inner
def place_and_speed(t, waves, steps, sweep):
    """Of the driven node: cosines (mean shift, amplitude, omega), smooth steps (height, time, width), one sweep."""
    x, v = 0.0, 0.0
    for row in waves:
        x += row[0] * (math.cos(row[1] * t + row[2]) - math.cos(row[2]))
        v -= row[0] * row[1] * math.sin(row[1] * t + row[2])
    for row in steps:
        level = math.tanh((t - row[1]) / row[2])
        x += 0.5 * row[0] * (level - math.tanh(-row[1] / row[2]))
        v += 0.5 * row[0] * (1.0 - level * level) / row[2]
    angle = 2.0 * math.pi * t * (sweep[1] + 0.5 * sweep[2] * t)
    x += sweep[0] * math.sin(angle)
    v += sweep[0] * math.cos(angle) * 2.0 * math.pi * (sweep[1] + sweep[2] * t)
    return x, v


@inner
def _balance(v, h, place, speed, x, v_old, mass, kinds, ends, numbers, memory, missing, slopes, new, branch):
    """What every node lacks, the slopes of that, the force on the driven node and the size of all forces."""
    driving, size = 0.0, 0.0
    for i in range(x.size):
        missing[i] = 0.0
        for j in range(x.size):
            slopes[i, j] = 0.0
        inertia = mass[i] * (v[i] - v_old[i]) / h
        missing[i] -= inertia
        slopes[i, i] += mass[i] / h
        size += abs(inertia)
    for e in range(kinds.size):
        a, b = ends[e]
        # node -1 is driven, node -2 is the ground
        xa, va, old = (place[1], speed, place[0]) if a == -1 else (x[a] + h * v[a], v[a], x[a])
        xb, vb = 0.0, 0.0
        if b >= 0:
            xb, vb, old = x[b] + h * v[b], v[b], old - x[b]
        force, slope, branch[e] = branch_force(kinds[e], numbers[e], memory[e], old, xa - xb, va - vb, h, new[e])
        size += abs(force)
        if a == -1:
            driving += force
        else:
            missing[a] -= force
            slopes[a, a] += slope
        if b >= 0:
            missing[b] += force
            slopes[b, b] += slope
            if a >= 0:
                slopes[a, b] -= slope
                slopes[b, a] -= slope
    return driving, size


@inner
def _balanced(missing, slopes, v, speed, size):
    """Whether nothing is missing but what rounding of the forces and of the velocities makes."""
    fastest = abs(speed)
    for i in range(v.size):
        fastest = max(fastest, abs(v[i]))
    for i in range(v.size):
        if abs(missing[i]) > BALANCED + BALANCED_SHARE * size + ROUNDING * slopes[i, i] * fastest:
            return False
    return True


@inner
def _along(way, missing):
    total = 0.0
    for i in range(way.size):
        total += way[i] * missing[i]
    return total


@inner
def _solve(slopes, missing, way):
    """Gauss's elimination of a symmetric positive matrix, which it uses up."""
    n = way.size
    for i in range(n):
        way[i] = missing[i]
    for i in range(n):
        for j in range(i + 1, n):
            share = slopes[j, i] / slopes[i, i]
            way[j] -= share * way[i]
            for k in range(i, n):
                slopes[j, k] -= share * slopes[i, k]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            way[i] -= slopes[i, k] * way[k]
        way[i] /= slopes[i, i]


@inner
def _gap(one, other, scale):
    """The largest difference of two rows, as a share of their scale."""
    largest = 0.0
    for i in range(one.size):
        # what is not a number is as far as can be
        share = abs(one[i] - other[i]) / scale[i]
        largest = share if not share <= largest else largest
    return largest


@inner
def _euler(v, h, place, speed, x, v_old, mass, kinds, ends, numbers, memory, new, branch):
    """One backward Euler step from ``v`` as a guess, which becomes the answer; the force, NaN where none is found."""
    n = x.size
    missing, slopes, trial, way = np.zeros(n), np.zeros((n, n)), np.zeros(n), np.zeros(n)
    arguments = (x, v_old, mass, kinds, ends, numbers, memory, missing, slopes, new, branch)
    driving, size = _balance(v, h, place, speed, *arguments)
    for _ in range(ROUNDS):
        if _balanced(missing, slopes, v, speed, size):
            return driving
        for i in range(n):
            slopes[i, i] += 1e-12 + 1e-14 * slopes[i, i]
        _solve(slopes, missing, way)
        first = _along(way, missing)
        low, high, share = 0.0, np.inf, 1.0
        for _ in range(HALVINGS):
            for i in range(n):
                trial[i] = v[i] + share * way[i]
            driving, size = _balance(trial, h, place, speed, *arguments)
            pull = _along(way, missing)
            if abs(pull) <= 0.3 * first or _balanced(missing, slopes, trial, speed, size):
                break
            if pull > 0.0:
                low = share
            else:
                high = share
            share = 4.0 * share if high == np.inf else 0.5 * (low + high)
            if high - low < 1e-16 * high:
                break
        for i in range(n):
            v[i] = trial[i]
    return np.nan


@inner
def _course(parts, t, step, y, mass, kinds, ends, numbers, motion, out, first_branch, branch):
    """``parts`` small steps over one step fill ``out``; 0: no answer, 1: the branches changed, 2: they are the same."""
    n, m = mass.size, kinds.size
    x, v = y[:n].copy(), y[n : 2 * n].copy()
    memory = y[2 * n : 2 * n + MEMORY * m].reshape(m, MEMORY).copy()
    new, same, h = np.zeros((m, MEMORY)), 2, step / parts
    force, place = 0.0, np.zeros(2)
    place[1] = place_and_speed(t, *motion)[0]
    for part in range(1, parts + 1):
        place[0] = place[1]
        place[1], speed = place_and_speed(t + part * h, *motion)
        before = v.copy()
        force = _euler(v, h, place, speed, x, before, mass, kinds, ends, numbers, memory, new, branch)
        if not math.isfinite(force):
            return 0
        for e in range(m):
            if first_branch[e] == -1:
                first_branch[e] = branch[e]
            elif first_branch[e] != branch[e]:
                same = 1
        x += h * v
        memory[:, :] = new
    out[:n], out[n : 2 * n], out[2 * n : -1], out[-1] = x, v, memory.ravel(), force
    return same


@inner
def _extrapolated(t, step, y, mass, kinds, ends, numbers, motion, scale, answer):
    """A whole step into ``answer``, and its error as a share of the ``scale``; infinity where there is none."""
    table, row, error = np.zeros((ORDERS, y.size)), np.zeros(y.size), np.inf
    first, branch = np.full(kinds.size, -1, dtype=np.int64), np.zeros(kinds.size, dtype=np.int64)
    smooth = True
    for j in range(ORDERS):
        same = _course(j + 1, t, step, y, mass, kinds, ends, numbers, motion, row, first, branch)
        if same == 0:
            return np.inf
        smooth = smooth and same == 2
        below, corner = table[0].copy(), np.empty(y.size)
        for i in range(y.size):
            table[0, i] = row[i]
        if j == 1:
            error = _gap(row, below, scale)
        if j > 0 and not smooth:
            for i in range(y.size):
                answer[i] = row[i]
            return error
        for k in range(1, j + 1):
            for i in range(y.size):
                corner[i] = table[k, i]
                table[k, i] = table[k - 1, i] + (table[k - 1, i] - below[i]) / ((j + 1) / (j + 1 - k) - 1.0)
                below[i] = corner[i]
    for i in range(y.size):
        answer[i] = table[ORDERS - 1, i]
    return _gap(table[ORDERS - 1], table[ORDERS - 2], scale)


@inner
def _euler_start(y, mass, kinds, ends, numbers, motion):
    """The force with which the record begins: after a step too short to matter."""
    new, branch = np.zeros((kinds.size, MEMORY)), np.zeros(kinds.size, dtype=np.int64)
    memory, n = np.zeros((kinds.size, MEMORY)), mass.size
    place, speed = place_and_speed(SHORTEST, *motion)
    v = np.zeros(n)
    return _euler(
        v, SHORTEST, np.array([0.0, place]), speed, y[:n], np.zeros(n), mass, kinds, ends, numbers, memory, new, branch
    )


@inner
def _set_scale(scale, mass, kinds, span, largest):
    """What errors of places, of velocities with a memory, of stretches, and of forces are measured by."""
    n = mass.size
    for i in range(n):
        scale[i] = span
        scale[n + i] = FAST * span if mass[i] > 0.0 else np.inf
    for e in range(kinds.size):
        for k in range(MEMORY):
            scale[2 * n + MEMORY * e + k] = span if kinds[e] in STRETCHED else largest
    scale[-1] = largest


@inner
def _until_turn(t, step, motion):
    """The step, or as much of it as ends where the driven node turns."""
    before = place_and_speed(t, *motion)[1]
    low, high = 0.0, step
    if before * place_and_speed(t + step, *motion)[1] >= 0.0:
        return step
    while high - low > SHORTEST:
        middle = 0.5 * (low + high)
        if before * place_and_speed(t + middle, *motion)[1] > 0.0:
            low = middle
        else:
            high = middle
    return high


@njit(cache=True)
def hybrid_force(samples, dt, mass, kinds, ends, numbers, motion, span, tolerance):
    """The force on the driven node at every sample (samples,), from rest with all nodes at zero; NaN from where none is
    found. ``mass`` (nodes,) in kg, ``kinds`` (edges,) as in ``branches``, ``ends`` (edges, 2) node numbers, ``numbers``
    (edges, ...) of the laws, ``motion`` as ``place_and_speed`` takes it; the error of a step is at most ``tolerance``
    of ``span`` in m, of the speed that it makes at 20 Hz, and of the largest force so far.
    """
    size = 2 * mass.size + MEMORY * kinds.size + 1
    y, answer, scale = np.zeros(size), np.zeros(size), np.ones(size)
    forces, step, largest, t, made = np.full(samples, np.nan), 1e-5 * dt, 1.0, 0.0, 0
    forces[0] = _euler_start(y, mass, kinds, ends, numbers, motion)
    for sample in range(1, samples):
        goal = sample * dt
        while t < goal:
            last = step >= 0.999 * (goal - t)
            whole, made = goal - t if last else step, made + 1
            trial = _until_turn(t, whole, motion)
            last = last and trial == whole
            _set_scale(scale, mass, kinds, span, largest)
            error = _extrapolated(t, trial, y, mass, kinds, ends, numbers, motion, scale, answer)
            if error <= tolerance or (trial <= SHORTEST and math.isfinite(error)):
                t = goal if last else t + trial
                y[:] = answer
                largest = max(largest, abs(y[-1]))
                growth = min(4.0, 0.9 * (tolerance / max(error, 1e-300)) ** (1.0 / ORDERS))
                step = max(trial * growth, SHORTEST)
            elif trial <= SHORTEST or made > MOST:
                return forces
            else:
                step = max(0.4 * trial, SHORTEST) if error > 32.0 * tolerance else 0.7 * trial
        forces[sample] = y[-1]
    return forces
