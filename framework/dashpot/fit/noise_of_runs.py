"""The colour of the noise of every run, before any model is fitted."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.data.noise import NoiseFloor, spectrum_above_motion
from dashpot.data.noise_spectrum import NoiseSpectrum
from dashpot.data.order_tracking import read_noise
from dashpot.data.run import Run
from dashpot.data.steady import SAMPLES, STEADY
from dashpot.data.tracking import track

Array = NDArray[np.float64]

NYQUIST = 0.5
FOLDS = 400


def noise_of_runs(runs: Iterable[Run], floor: NoiseFloor) -> dict[str, NoiseSpectrum]:
    """The spectrum of the noise of each run by name, read between the orders of its motion, else above all of them.

    A single run tells a density in so few places that its colour is that of all runs together, and only its power its
    own. A run whose motion leaves no room has the noise of the others as its own sampling would fold it; where no run
    leaves any, the noise is white and as large as the noise ``floor`` says, 1 N where that is unknown.
    """
    runs = list(runs)
    records, rows = ([run for run in runs if (run.kind == STEADY) is steady] for steady in (False, True))
    told = {run.name: _as_white(run, floor) for run in rows}
    read = {run.name: spectrum for run in records if (spectrum := _read(run)) is not None}
    if not read:
        return told | {run.name: white({run.name: floor.value or 1.0}, run.sample_time)[run.name] for run in records}
    colour = _pooled(list(read.values()))
    return told | {run.name: _own(colour, read.get(run.name), run.sample_time) for run in records}


def _as_white(row: Run, floor: NoiseFloor) -> NoiseSpectrum:
    """White noise from which the fundamental over a period would have the scatter of a row of a table."""
    scatter = row.sensors.get("force", {}).get("noise") or floor.value or 1.0
    return white({row.name: float(np.sqrt(0.5 * SAMPLES)) * scatter}, row.sample_time)[row.name]


def variance_of(columns: Array, noise: NoiseSpectrum) -> Array:
    """Covariance (p, p) of the sums of noise weighted by ``columns`` (p, n), the noise taken as periodic in the record.

    For white noise of variance s^2 it is s^2 times the products of the columns.
    """
    lines = np.fft.rfft(columns, axis=1, norm="ortho")
    frequency = np.fft.rfftfreq(columns.shape[1], noise.sample_time)
    power = noise.white_equivalent(frequency) ** 2
    power[1 : (columns.shape[1] + 1) // 2] *= 2.0  # a line stands for its mirror image too
    return np.real((lines * power) @ lines.conj().T)


def _read(run: Run) -> NoiseSpectrum | None:
    oscillation = track(run) if run.kind in ("sweep", "harmonic") else None
    found = read_noise(run.force, oscillation) if oscillation else None
    return found or spectrum_above_motion(run.displacement, run.force, run.sample_time)


def _pooled(read: list[NoiseSpectrum]) -> NoiseSpectrum:
    """The mean density of all runs that were sampled like the first."""
    alike = [each for each in read if np.isclose(each.sample_time, read[0].sample_time)]
    places = np.unique(np.round(np.concatenate([each.frequency for each in alike]), 6))
    density = np.mean([np.interp(places, each.frequency, each.density) for each in alike], axis=0)
    return NoiseSpectrum(places, density, read[0].sample_time)


def _own(colour: NoiseSpectrum, read: NoiseSpectrum | None, sample_time: float) -> NoiseSpectrum:
    folded = _sampled(colour, sample_time)
    if read is None or folded.deviation == 0.0:
        return folded
    return replace(folded, density=folded.density * (read.deviation / folded.deviation) ** 2)


def _sampled(noise: NoiseSpectrum, sample_time: float) -> NoiseSpectrum:
    """The same noise sampled more slowly without a filter: what was above the new Nyquist frequency folds back."""
    rate, end = 1.0 / sample_time, NYQUIST / noise.sample_time
    if sample_time <= noise.sample_time * (1.0 + 1e-9):
        return replace(noise, sample_time=sample_time)
    places = np.linspace(0.0, NYQUIST * rate, FOLDS)
    images = [places] + [k * rate + side * places for k in range(1, int(end / rate) + 2) for side in (-1.0, 1.0)]
    density = sum(np.where(image <= end, np.interp(image, noise.frequency, noise.density), 0.0) for image in images)
    return NoiseSpectrum(places, np.asarray(density), sample_time)


def white(deviations: Mapping[str, float], sample_time: float) -> dict[str, NoiseSpectrum]:
    """White noise of given standard deviations by run."""
    return {
        run: NoiseSpectrum(np.array([NYQUIST / sample_time]), np.array([2.0 * sample_time * each**2]), sample_time)
        for run, each in deviations.items()
    }
