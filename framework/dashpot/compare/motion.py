"""What a general model remembers of the motion of a run: rates, stops, relaxing and ringing travel, and wear."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.data.reversals import stroke_edges

Array = NDArray[np.float64]

YIELDS, TIMES, TONES = 16, 12, 10
SMALLEST_YIELD, LARGEST_YIELD = 1.0 / 600.0, 0.5  # of the range of the deflection
SHORTEST_TIME = 0.2  # of the time of one radian of the fastest run: shorter ones look like a velocity
LONGEST_TIME = 1.0 / 3.0  # of the longest run
LOWEST_TONE, HIGHEST_TONE = 0.1, 4.0  # of the fastest run, rad/s
DAMPING_RATIO = 0.1
FADING_WEAR = (3.0, 30.0)  # ranges of the deflection travelled


@dataclass(frozen=True, eq=False)
class Grid:
    """Sizes of the motions of the training runs, and the places of the memories.

    ``middle`` and ``half_range`` of the deflection in m, ``speed`` m/s and ``acceleration`` m/s^2 (largest root mean
    squares of a run), ``yields`` (16,) m, ``times`` (12,) s and ``tones`` (10,) rad/s.
    """

    middle: float
    half_range: float
    speed: float
    acceleration: float
    yields: Array
    times: Array
    tones: Array


@dataclass(frozen=True, eq=False)
class Memory:
    """What is remembered at every sample of a run, dimensionless and of order one.

    ``deflection``, ``velocity`` and ``acceleration`` (n,), ``stops`` (n, 16), ``relaxing`` (n, 12) fading memories of
    the travel, ``lagging`` (n, 8) fading memories of powers of velocity, ``ringing`` (n, 20), ``wear`` (n, 5): fading
    memories of the way travelled; ``since`` (n, 2): travel and logarithm of the time since the last reversal.
    """

    deflection: Array
    velocity: Array
    acceleration: Array
    stops: Array
    relaxing: Array
    lagging: Array
    ringing: Array
    wear: Array
    since: Array

    def at(self, rows: NDArray[np.intp]) -> Memory:
        """The memory at some samples."""
        return Memory(**{name: values[rows] for name, values in vars(self).items()})

    def together(self) -> Array:
        """All memories (n, 76) side by side."""
        return np.column_stack(list(vars(self).values()))


def grid_of(drives: Sequence[Drive]) -> Grid:
    """The grid for the motions of the training runs."""
    low = min(float(drive.displacement.min()) for drive in drives)
    high = max(float(drive.displacement.max()) for drive in drives)
    speeds, bends = ([_size(getattr(drive, rate)) for drive in drives] for rate in ("velocity", "acceleration"))
    fastest = max((bend / speed for bend, speed in zip(bends, speeds, strict=True) if speed > 0.0), default=1.0)
    shortest = max(min(drive.dt for drive in drives), SHORTEST_TIME / fastest)
    longest = max(LONGEST_TIME * max(drive.dt * drive.samples for drive in drives), 2.0 * shortest)
    return Grid(
        middle=0.5 * (low + high),
        half_range=0.5 * (high - low),
        speed=max(speeds),
        acceleration=max(bends),
        yields=np.geomspace(SMALLEST_YIELD * (high - low), LARGEST_YIELD * (high - low), YIELDS),
        times=np.geomspace(shortest, longest, TIMES),
        tones=fastest * np.geomspace(LOWEST_TONE, HIGHEST_TONE, TONES),
    )


def remember(drive: Drive, grid: Grid) -> Memory:
    """The memories along a motion that starts at rest."""
    velocity = drive.velocity / grid.speed
    steps = np.diff(drive.displacement, prepend=drive.displacement[0])
    powers = [np.sign(velocity) * np.sqrt(np.abs(velocity)), velocity * np.abs(velocity)]
    return Memory(
        deflection=(drive.displacement - grid.middle) / grid.half_range,
        velocity=velocity,
        acceleration=drive.acceleration / grid.acceleration,
        stops=stops(drive.displacement, grid.yields) / grid.yields,
        relaxing=np.column_stack([relaxing(steps, drive.dt, time) for time in grid.times]) / grid.half_range,
        lagging=np.column_stack([_lagged(power, drive.dt, time) for time in grid.times[1:9:2] for power in powers]),
        ringing=_ringing(steps, drive.dt, grid.tones) / grid.half_range,
        wear=_wear(drive, steps, grid),
        since=_since_reversal(drive, grid),
    )


def stops(path: Array, yields: Array) -> Array:
    """Stop operators (n, m) in m along a path (n,): ds = dx within |s| <= yield; exact, as every stroke is monotone.

    Source: Brokate and Sprekels, Hysteresis and Phase Transitions (1996), section 2.3.
    """
    state = np.zeros(yields.size)
    values = np.zeros((path.size, yields.size))
    edges = stroke_edges(path, 0.0).tolist()
    for first, last in zip(edges, edges[1:], strict=False):
        travelled = path[first + 1 : last + 1] - path[first]
        values[first + 1 : last + 1] = np.clip(state + travelled[:, None], -yields, yields)
        state = values[last]
    return values


def relaxing(steps: Array, dt: float, time: float) -> Array:
    """The fading memory q (n,) of the travel: dq/dt = dx/dt - q/time, exact for steps (n,) taken at even speed."""
    from scipy.signal import lfilter

    fading = np.exp(-dt / time)
    return lfilter([(1.0 - fading) * time / dt], [1.0, -fading], steps)


def _lagged(signal: Array, dt: float, time: float) -> Array:
    from scipy.signal import lfilter

    fading = np.exp(-dt / time)
    return lfilter([1.0 - fading], [1.0, -fading], signal)


def _ringing(steps: Array, dt: float, tones: Array) -> Array:
    from scipy.signal import lfilter

    poles = np.exp((-DAMPING_RATIO + 1j) * tones * dt)
    rung = [lfilter([1.0], [1.0, -pole], steps.astype(complex)) for pole in poles]
    return np.column_stack([part for each in rung for part in (each.real, each.imag)])


def _wear(drive: Drive, steps: Array, grid: Grid) -> Array:
    """Three fading memories of the speed, and two of what is left of the first strokes."""
    way = np.cumsum(np.abs(steps)) / (2.0 * grid.half_range)
    speed = np.abs(drive.velocity) / grid.speed
    warmth = [_lagged(speed, drive.dt, time) for time in grid.times[-5::2]]
    return np.column_stack([*warmth, *(np.exp(-way / length) for length in FADING_WEAR)])


def _since_reversal(drive: Drive, grid: Grid) -> Array:
    smallest = float(grid.yields[0])
    edges = stroke_edges(drive.displacement, smallest)
    last = edges[np.searchsorted(edges, np.arange(drive.samples), side="right") - 1]
    travelled = (drive.displacement - drive.displacement[last]) / grid.half_range
    passed = drive.dt * (np.arange(drive.samples) - last)
    return np.column_stack([travelled, np.log1p(passed / grid.times[0])])


def _size(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
