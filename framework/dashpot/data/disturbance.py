"""What a channel shows too much while a run lasts: a zero that drifts, and hum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.text.form import Form
from dashpot.text.node import Node
from dashpot.text.node import Sequence as SequenceNode
from dashpot.text.problem import Problem


@dataclass(frozen=True)
class Hum:
    """cosine * cos(2 pi frequency t) + sine * sin(2 pi frequency t), with the time t of the run; Hz and SI."""

    frequency: float
    cosine: float
    sine: float


def disturbance(drift: float, hum: Sequence[Hum], dt: float, samples: int) -> NDArray[np.float64]:
    """What is subtracted from a channel: (samples,), by the time since the first sample of the run.

    ``drift`` is reached at the last sample, along a straight line from 0 at the first one.
    """
    found = np.linspace(0.0, drift, samples)
    for line in hum:
        phase = 2.0 * np.pi * line.frequency * dt * np.arange(samples)
        found += line.cosine * np.cos(phase) + line.sine * np.sin(phase)
    return found


def read_hum(node: Node, unit: str, what: str, problems: list[Problem]) -> tuple[Hum, ...]:
    """One line, ``{frequency: 50 Hz, cosine: 1 N, sine: 2 N}``, or a list of them."""
    items = node.items if isinstance(node, SequenceNode) else (node,)
    lines = [_read_line(Form(item, problems, f"{what}, 'hum'"), unit) for item in items]
    return tuple(line for line in lines if line)


def _read_line(form: Form, unit: str) -> Hum | None:
    frequency = form.quantity("frequency", "Hz")
    cosine, sine = (form.quantity(key, unit, 0.0) for key in ("cosine", "sine"))
    form.close()
    if frequency is None:
        return None
    if not frequency > 0.0:
        form.complain("frequency", f"{form.what}: expected a frequency above 0, got {frequency:g} Hz")
        return None
    return Hum(frequency, cosine, sine)
