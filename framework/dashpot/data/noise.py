"""The noise floor of a force: what no model can explain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from .noise_spectrum import NoiseSpectrum, collect_spectrum
from .order_tracking import Oscillation, follow, read_noise
from .phase import NotOscillatingError
from .repeats import compare_repeats
from .white_noise import FASTER, LENGTH, share_everywhere, white_noise

# Harmonics of the motion are looked for up to this order.
_HARMONICS = 4.0
_HIGHEST = 0.4
_ABOVE_NOISE = 30.0
_SPECTRUM_END = 1e-7
_SEGMENTS = 4
_LINES_OF_TREND = 4
_PIECES = 16  # of a record at least, a quarter of which is to be quiet
_LONGER = 1.5  # each length of pieces over the one before, at the most
_FEWEST_SAMPLES = 256


@dataclass(frozen=True)
class NoiseFloor:
    """RMS of the noise on a force, N, and where it was seen; value and source are None when it could not be.

    offset: N, scatter of the mean force between repeated runs, which is not part of the value;
    weight: how many samples say so; lower_bound: the noise may be larger, as part of it hides under the motion.
    """

    value: float | None
    source: Literal["repeats", "residual", "stated"] | None
    offset: float = 0.0
    weight: float = 0.0
    lower_bound: bool = False


UNKNOWN = NoiseFloor(None, None)


def noise_from_repeats(runs: Sequence[tuple[np.ndarray, np.ndarray]], sample_time: float) -> NoiseFloor:
    """Noise of k runs that repeat each other, given as (displacement m, force N).

    For two it is the RMS of their difference / sqrt 2. They are aligned to a fraction of a sample; what small
    differences of the displacement explain is taken out, and so is a constant difference, which goes to `offset`.
    Noise of any colour counts in full. Raises NotRepeatsError when the motions differ or the runs are too short.
    """
    departure = compare_repeats(runs, sample_time).departure
    means = departure.mean(axis=1, keepdims=True)
    freedom = len(runs) - 1
    variance = np.sum(np.mean((departure - means) ** 2, axis=1)) / freedom
    return NoiseFloor(
        value=float(np.sqrt(variance)),
        source="repeats",
        offset=float(np.sqrt(np.sum(means**2) / freedom)),
        weight=float(freedom * departure.shape[1]),
    )


def noise_from_residual(displacement: np.ndarray, force: np.ndarray, sample_time: float) -> NoiseFloor:
    """Noise of a single run: between the orders where it oscillates long enough, else above the motion."""
    try:
        oscillation = follow(displacement, sample_time)
    except NotOscillatingError:
        return noise_above_motion(displacement, force, sample_time)
    floor = noise_from_orders(force, oscillation)
    return floor if floor.source else noise_above_motion(displacement, force, sample_time)


def noise_from_orders(force: np.ndarray, oscillation: Oscillation) -> NoiseFloor:
    """Noise of a sweep or harmonic run, from what is between the orders of the motion.

    White and slowly varying noise alike, as its density is read from half the lowest tested frequency up and continued
    below. Noise that lives below that frequency only is underestimated. A hum counts, in part or in full.
    Unknown when fewer than six periods of steady amplitude follow each other.
    """
    return _floor(read_noise(force, oscillation), len(force))


def noise_above_motion(displacement: np.ndarray, force: np.ndarray, sample_time: float) -> NoiseFloor:
    """Noise of any run, from the force above the frequencies of the motion and its harmonics, taken as white below.

    Only what is there at all times counts: friction, valves and stops have harmonics without end, at the places where
    they bend. A lower bound: slow noise hides under the motion. Unknown when the motion leaves no frequencies free.
    """
    spectrum = spectrum_above_motion(displacement, force, sample_time)
    return UNKNOWN if spectrum is None else replace(_floor(spectrum, len(force)), lower_bound=True)


def spectrum_above_motion(displacement: np.ndarray, force: np.ndarray, sample_time: float) -> NoiseSpectrum | None:
    """The spectrum behind `noise_above_motion`; None when the motion leaves no frequencies free."""
    if len(force) < _FEWEST_SAMPLES:
        return None
    frequency, densities = _densities(displacement, sample_time)
    motion = np.mean(densities, axis=0)
    # The noise of the sensor, told from a fast motion by what there is close to the Nyquist frequency.
    own = min(white_noise(displacement) ** 2 * 2.0 * sample_time, float(np.median(motion[-len(motion) // 10 :])))
    excited = motion > max(_ABOVE_NOISE * own, _SPECTRUM_END * float(np.max(motion)))
    free = _HARMONICS * float(np.max(frequency[excited], initial=0.0))
    if free > _HIGHEST / sample_time:
        return None
    seen = frequency > free
    densities = _densities(force, sample_time)[1][:, seen]
    densities *= min(share_everywhere(force, length) for length in _lengths(free * sample_time, len(force))) ** 2
    return collect_spectrum(np.tile(frequency[seen], len(densities)), densities.ravel(), sample_time).flat_below()


def _lengths(free: float, samples: int) -> list[int]:
    """Samples of pieces of a record in which what is above `free` (1/sample) shows."""
    longest = max(LENGTH, int(min(FASTER / max(free, 1e-12), samples / _PIECES)))
    steps = int(np.log(longest / LENGTH) / np.log(_LONGER)) + 1
    return np.unique(np.geomspace(LENGTH, longest, steps + 1).astype(int)).tolist()


def pool_noise(floors: Sequence[NoiseFloor]) -> NoiseFloor:
    """One noise floor for many runs, of the most trustworthy kind: from repeats, else no lower bounds, else these."""
    for source, lower_bound in (("repeats", False), ("residual", False), ("residual", True), ("stated", False)):
        known = [
            (floor, floor.value)
            for floor in floors
            if (floor.source, floor.lower_bound) == (source, lower_bound) and floor.value is not None
        ]
        if known:
            weights = np.array([floor.weight for floor, _ in known])
            value = np.sqrt(np.average([value**2 for _, value in known], weights=weights))
            offset = np.sqrt(np.average([floor.offset**2 for floor, _ in known], weights=weights))
            return NoiseFloor(float(value), known[0][0].source, float(offset), float(weights.sum()), lower_bound)
    return UNKNOWN


def _floor(spectrum: NoiseSpectrum | None, samples: int) -> NoiseFloor:
    return UNKNOWN if spectrum is None else NoiseFloor(spectrum.deviation, "residual", weight=float(samples))


def _densities(signal: np.ndarray, sample_time: float) -> tuple[np.ndarray, np.ndarray]:
    """Power densities (segments, lines), without the line at zero and its neighbours, which hold mean and trend."""
    from scipy.signal import periodogram

    length = len(signal) // _SEGMENTS
    segments = np.lib.stride_tricks.sliding_window_view(signal, length)[:: length // 2]
    frequency, densities = periodogram(segments, 1.0 / sample_time, "blackmanharris", detrend="linear")
    return frequency[_LINES_OF_TREND:], densities[:, _LINES_OF_TREND:]
