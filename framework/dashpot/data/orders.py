"""A signal in short windows as a sum of orders, that is of multiples of one turning phase.

In every window the signal is fitted by weighted least squares with 1, t, cos k theta, sin k theta (k = 1 ... orders).
The weights are a Hann window over the phase, so that neighbouring orders do not leak into each other.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, chain

import numpy as np

TURN = 2.0 * np.pi

# Orders above this part of the Nyquist frequency are not told from their mirror images.
_NYQUIST_SHARE = 0.9
_FEWEST_SAMPLES = 3


@dataclass(frozen=True)
class Windows:
    """Overlapping windows of equal length in phase: the samples `start` to `stop` (m,) around the phase `centre` (m,).

    `periods` is their length, `step` the distance of their centres, both in periods.
    """

    start: np.ndarray
    stop: np.ndarray
    centre: np.ndarray
    periods: float
    step: float

    def sums(self, angle: np.ndarray, columns: Iterable[np.ndarray]) -> np.ndarray:
        """Hann-weighted sums (m, c) of columns (n,) over every window."""
        lean = np.exp(1j * np.nan_to_num(angle) / self.periods)
        turn = 0.25 * np.exp(-1j * self.centre / self.periods)
        sums = [
            0.5 * self._plain_sums(column)
            + turn * self._plain_sums(column * lean)
            + turn.conj() * self._plain_sums(column * lean.conj())
            for column in columns
        ]
        return np.stack(sums, axis=1)

    def select(self, chosen: np.ndarray) -> Windows:
        """The windows named by a mask or by numbers."""
        return Windows(self.start[chosen], self.stop[chosen], self.centre[chosen], self.periods, self.step)

    def __len__(self) -> int:
        return len(self.centre)

    def _plain_sums(self, column: np.ndarray) -> np.ndarray:
        """Differences of running sums, which go from one end of a window to the next."""
        ends, (start, stop) = self._ends
        parts = np.add.reduceat(column[: ends[-1]], ends[:-1])
        running = np.concatenate([[0.0], np.cumsum(parts)])
        return running[stop] - running[start]

    @cached_property
    def _ends(self) -> tuple[np.ndarray, np.ndarray]:
        """The samples where windows start or stop, in order, and the places (2, m) of each window among them."""
        ends, places = np.unique([self.start, self.stop], return_inverse=True)
        return ends, places.reshape(2, -1)


@dataclass(frozen=True)
class OrderFit:
    """What the windows say of s signals.

    middle: (m,) weighted mean sample number; mean: (m, s) value there; slope: (m, s) per sample;
    harmonics: (m, orders, s) complex amplitudes H_k of Re sum H_k exp(j k theta), NaN above the Nyquist frequency;
    variance: (m, s) of the residual, per degree of freedom; samples: (m,) as many equally weighted ones would do.
    """

    middle: np.ndarray
    mean: np.ndarray
    slope: np.ndarray
    harmonics: np.ndarray
    variance: np.ndarray
    samples: np.ndarray


def place_windows(angle: np.ndarray, periods: float, step: float) -> Windows:
    """Windows of `periods` every `step` periods wherever the phase `angle` (n,) is known, that is not NaN.

    Windows with fewer than three samples a period are left out.
    """
    half = 0.5 * periods * TURN
    places = [(np.zeros(0, int), np.zeros(0, int), np.zeros(0))]
    for first, last in known_parts(angle):
        part = angle[first:last]
        centres = np.arange(part[0] + half, part[-1] - half + 1e-9, step * TURN)
        start = first + np.searchsorted(part, centres - half, side="left")
        stop = first + np.searchsorted(part, centres + half, side="right")
        places.append((start, stop, centres))
    start, stop, centre = (np.concatenate(column) for column in zip(*places, strict=True))
    windows = Windows(start, stop, centre, periods, step)
    return windows.select(stop - start >= _FEWEST_SAMPLES * periods)


def known_parts(angle: np.ndarray) -> list[tuple[int, int]]:
    """First and one-past-last sample of every stretch without NaN."""
    known = np.concatenate([[False], np.isfinite(angle), [False]])
    edges = np.flatnonzero(np.diff(known.astype(int)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


@dataclass(frozen=True, eq=False)
class OrderBasis:
    """The orders of one phase `angle` (n,) in m windows: what the fits of all signals with this phase have in common.

    Hann-weighted sums over every window, t the sample number: `tones` (m, 2K+1) of exp(j k theta), k = 0 ... 2K,
    `timed` (m, K+1) of t exp(j k theta), k = 0 ... K, and `squared` (m,) of t^2.
    """

    angle: np.ndarray
    windows: Windows
    tones: np.ndarray
    timed: np.ndarray
    squared: np.ndarray

    @classmethod
    def of(cls, angle: np.ndarray, windows: Windows, orders: int) -> OrderBasis:
        """The basis for K `orders` of a phase."""
        time, tones = np.arange(len(angle), dtype=float), _tones(angle, 2 * orders)
        timed = (time * tone for tone in tones[: orders + 1])
        sums = windows.sums(angle, chain(tones, timed, [time**2]))
        return cls(angle, windows, sums[:, : len(tones)], sums[:, len(tones) : -1], sums[:, -1].real)

    def select(self, chosen: np.ndarray) -> OrderBasis:
        """The windows named by a mask or by numbers."""
        sums = (self.tones[chosen], self.timed[chosen], self.squared[chosen])
        return OrderBasis(self.angle, self.windows.select(chosen), *sums)

    def fit(self, signals: np.ndarray, orders: int) -> OrderFit:
        """Fit signals (n, s), which have this phase, with its lowest `orders`, K or fewer, in every window."""
        level = np.mean(signals, axis=0)
        middle, gram = self._normal_matrix(orders)
        right, power = self._right_sides(signals - level, middle, orders)
        countable = np.minimum(orders, countable_orders(self.windows))
        solution, explained = np.full(right.shape, np.nan + 0j), np.empty(power.shape)
        for count in np.unique(countable):
            chosen = np.flatnonzero(countable == count)
            kept = np.r_[orders - count : orders + count + 1, 2 * orders + 1]
            part = np.linalg.solve(gram[np.ix_(chosen, kept, kept)], right[np.ix_(chosen, kept)])
            solution[np.ix_(chosen, kept)] = part
            explained[chosen] = np.sum(part * right[np.ix_(chosen, kept)].conj(), axis=1).real
        # A Hann window of n samples weighs n / 2 together, its squares 3 n / 8.
        total = gram[:, 0, 0].real
        freedom = np.maximum(total - 0.75 * (2 * countable + 2), 1.0)
        return OrderFit(
            middle=middle,
            mean=solution[:, orders].real + level,
            slope=solution[:, -1].real,
            harmonics=2.0 * solution[:, orders + 1 : -1],
            variance=np.maximum(power - explained, 0.0) / freedom[:, None],
            samples=4.0 / 3.0 * total,
        )

    def _normal_matrix(self, orders: int) -> tuple[np.ndarray, np.ndarray]:
        """Middle (m,) and Gram matrices (m, 2K+2, 2K+2) of exp(j k theta), k = -K ... K, and of the local time.

        Products of tones are tones: sum w exp(j (l - k) theta) depends on l - k alone.
        """
        plain, total = self.tones[:, : 2 * orders + 1], self.tones[:, 0].real
        middle = self.timed[:, 0].real / total
        timed = self.timed[:, : orders + 1] - middle[:, None] * plain[:, : orders + 1]
        both = np.concatenate([plain[:, :0:-1].conj(), plain], axis=1)
        numbers = np.arange(2 * orders + 1)
        gram = np.empty((len(plain), 2 * orders + 2, 2 * orders + 2), complex)
        gram[:, :-1, :-1] = both[:, 2 * orders + numbers[None, :] - numbers[:, None]]
        gram[:, -1, :-1] = np.concatenate([timed[:, :0:-1].conj(), timed], axis=1)
        gram[:, :-1, -1] = gram[:, -1, :-1].conj()
        gram[:, -1, -1] = self.squared - total * middle**2
        return middle, gram

    def _right_sides(self, signals: np.ndarray, middle: np.ndarray, orders: int) -> tuple[np.ndarray, np.ndarray]:
        """Products of the signals with exp(j k theta), k = -K ... K, and with the local time; weighted power (m, s)."""
        time, tones = np.arange(len(self.angle), dtype=float), _tones(self.angle, orders)
        right, power = [], []
        for signal in signals.T:
            columns = chain((signal * tone for tone in tones), [signal * time, signal**2])
            sums = self.windows.sums(self.angle, columns)
            with_tones, timed = sums[:, :-2], sums[:, -2] - middle * sums[:, 0]
            right.append(np.column_stack([with_tones[:, :0:-1], with_tones.conj(), timed]))
            power.append(sums[:, -1].real)
        return np.stack(right, axis=-1), np.stack(power, axis=-1)


def countable_orders(windows: Windows) -> np.ndarray:
    """How many orders (m,) the samples of each window can tell apart; the first is asked for in any case."""
    samples_per_period = (windows.stop - windows.start) / windows.periods
    return np.maximum(1, (0.5 * _NYQUIST_SHARE * samples_per_period).astype(int))


def _tones(angle: np.ndarray, highest: int) -> list[np.ndarray]:
    """exp(j k theta), k = 0 ... highest."""
    turns = np.exp(1j * np.nan_to_num(angle))
    return list(accumulate([turns] * highest, np.multiply, initial=np.ones_like(turns)))
