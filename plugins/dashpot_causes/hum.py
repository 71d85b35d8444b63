"""Mains in the force channel."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, ChannelFault, Suspect, View
from dashpot.data.correction import Correction
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]
MAINS = (50.0, 60.0, 100.0, 120.0, 150.0, 180.0)  # Hz, with harmonics
HIGHEST = 0.4  # of the sampling rate
BESIDE, RESOLUTIONS = 8, 2.0  # lines to either side, and how far apart they are
HARMONICS = 5  # of a sine: where laws show
WIDTH, SINE = 3, 0.9  # lines of a spectrum to either side that belong to a sine; its share of the square of the motion


class Hum(Cause):
    """A line of the mains, of its own phase in every run."""

    word = "hum"
    kind = "measurement"
    about = "mains hum in the force channel"
    shows = (
        "a line at a frequency of the mains that is no harmonic of the motion; repeated runs disagree about its phase"
    )
    cure = "shield and ground the channel; take the line out by a notch filter on both channels alike"
    confused_with = {
        "resonance": "a run at rest: hum stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """None: its phase differs from run to run."""
        return ()

    def channel_faults(self, view: View) -> Iterable[ChannelFault]:
        """Sine and cosine of a frequency of the mains or one of its harmonics."""
        highest = HIGHEST / max(view.step(run) for run in view.runs)
        for frequency in (line for line in MAINS if view.highest_frequency < line < highest):
            yield ChannelFault(
                f"{frequency:g} Hz",
                "amplitude",
                "N",
                partial(_line, frequency),
                partial(_corrected, frequency),
                "at_rest",
                f"a line at {frequency:g} Hz, where nothing was driven, above all lines beside it",
                alike=partial(_lines_beside, frequency),
            )


def _line(frequency: float, view: View, run: str) -> Array:
    angle = 2.0 * np.pi * frequency * view.step(run) * np.arange(view.force(run).size)
    return np.array([np.cos(angle), np.sin(angle)])


def _lines_beside(frequency: float, view: View, run: str) -> Array:
    """Lines that no mains have; where the mains are a harmonic of a sine, its neighbours of the same parity.

    What a model lacks of a law that is the same in both directions has odd harmonics only. Nothing distinguishes the
    mains from one of the first harmonics: there the answer is the line itself, so that it is no evidence.
    """
    spacing = RESOLUTIONS / (view.step(run) * view.force(run).size)
    sine = _frequency_of_sine(view, run)
    if sine and abs(frequency - sine * round(frequency / sine)) < spacing:
        if round(frequency / sine) <= HARMONICS:
            return _line(frequency, view, run)[None]
        spacing = 2.0 * sine * np.ceil(0.5 * spacing / sine)
    places = [frequency + side * number * spacing for number in range(1, BESIDE + 1) for side in (-1.0, 1.0)]
    return np.array([_line(place, view, run) for place in places if (sine or 0.0) < place < 0.5 / view.step(run)])


def _frequency_of_sine(view: View, run: str) -> float | None:
    """The frequency in Hz of a run that is a sine; None for any other motion."""
    moved = view.displacement(run) - view.displacement(run).mean()
    spectrum = np.abs(np.fft.rfft(moved * np.hanning(moved.size))) ** 2
    peak = int(np.argmax(spectrum))
    if not peak or spectrum[max(peak - WIDTH, 0) : peak + WIDTH + 1].sum() < SINE * spectrum.sum():
        return None
    turned = moved * np.exp(-2j * np.pi * peak * np.arange(moved.size) / moved.size)
    early, late = (np.sum(half * np.hanning(half.size)) for half in np.array_split(turned, 2))
    bins = peak + np.angle(late * np.conj(early)) / np.pi
    return float(bins / (moved.size * view.step(run)))


def _corrected(frequency: float, strengths: Sequence[float]) -> Correction:
    return Correction(hum=(frequency, strengths[0], strengths[1]))
