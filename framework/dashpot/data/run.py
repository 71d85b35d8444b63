"""One measured run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

KINDS = ("quasi_static", "sweep", "harmonic", "random", "hold", "transient")
# what kinds of runs are called elsewhere
OTHER_WORDS = {
    **dict.fromkeys(("static", "slow", "ramp", "triangle", "triangular", "quasistatic"), "quasi_static"),
    **dict.fromkeys(("chirp", "swept_sine", "sine_sweep"), "sweep"),
    **dict.fromkeys(("sine", "sinus", "sinusoidal", "dynamic", "steady", "stepped_sine", "cyclic"), "harmonic"),
    **dict.fromkeys(("noise", "white_noise", "road", "stochastic"), "random"),
    **dict.fromkeys(("static_hold", "step_and_hold", "dwell"), "hold"),
    **dict.fromkeys(("step", "impact", "drop", "pulse", "free_decay"), "transient"),
}


@dataclass(frozen=True, eq=False)
class Run:
    """Channels of one run on a uniform time grid that starts at 0; SI, compression positive, read-only.

    time (n,) s; channels: "displacement", "force", "velocity", "force@platform_left", ... -> (n,).
    kind: one of KINDS; of a row of a table, "steady": the fundamental of a steady sine (`dashpot.data.steady`).
    settings: settings of the test procedure in SI ("amplitude", "preload", "start", "stop", ...); notes: its words.
    units: those in which free settings, and channels by the name of their mean, were told; nothing for bare numbers.
    group: the name of the original; all repeats of a run share it. repeats: the original, None for an original.
    held_out: what the dataset says about it, None when it says nothing.
    sensors: channel -> its specification in SI (gain, zero, delay, noise).
    source: the file it came from; order: its number in the dataset, from 0, as it was measured; history: what the
    specimen has gone through in the runs before, in SI (`dashpot.data.history`).
    uneven: whether the clock was not, and the samples were laid on the even grid.
    end: the node whose force it is about, where a run with several forces was taken apart.
    accept: what the dataset says is known and harmless.

    Examples:
        >>> run = dp.load_dataset("mount").runs[1]
        >>> run.name, run.kind, run.group
        ('a0p5_p2_up_b', 'sweep', 'a0p5_p2_up')
        >>> run.time.shape == run.displacement.shape == run.force.shape
        True
        >>> run.settings["amplitude"], run.sample_time
        (0.0005, 0.002)
    """

    name: str
    kind: str
    time: np.ndarray
    channels: Mapping[str, np.ndarray]
    settings: Mapping[str, float] = field(default_factory=dict)
    repeats: str | None = None
    group: str = ""
    held_out: bool | None = None
    sensors: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    source: str = ""
    order: int = 0
    history: Mapping[str, float] = field(default_factory=dict)
    notes: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    uneven: bool = False
    end: str = ""
    accept: tuple[str, ...] = ()

    @property
    def sample_time(self) -> float:
        """Seconds between two samples."""
        return float(self.time[1] - self.time[0])

    @property
    def record(self) -> str:
        """The name of the measured run; those that were taken apart share it."""
        return self.name.removesuffix(f"@{self.end}") if self.end else self.name

    @property
    def cluster(self) -> str:
        """What is fitted or held out together: a run, its repeats, and all forces of both."""
        return self.group.removesuffix(f"@{self.end}") if self.end else self.group

    @property
    def displacement(self) -> np.ndarray:
        """The deflection (n,) in m. KeyError when the run has only channels at nodes."""
        return self.channels["displacement"]

    @property
    def force(self) -> np.ndarray:
        """The force (n,) in N. KeyError when the run has only channels at nodes."""
        return self.channels["force"]
