"""The oscillation of a run, followed once however often it is asked for."""

from __future__ import annotations

from weakref import WeakKeyDictionary

from dashpot.data.order_tracking import Oscillation, follow
from dashpot.data.phase import NotOscillatingError
from dashpot.data.run import Run
from dashpot.data.steady import STEADY

_known: WeakKeyDictionary[Run, Oscillation | None] = WeakKeyDictionary()


def track(run: Run) -> Oscillation | None:
    """How a sweep, a harmonic run or a row of a table oscillates; None for a run that does not."""
    if run not in _known:
        _known[run] = _follow(run)
    return _known[run]


def _follow(run: Run) -> Oscillation | None:
    if run.kind not in ("sweep", "harmonic", STEADY):
        return None
    try:
        return follow(run.displacement, run.sample_time)
    except NotOscillatingError:
        return None
