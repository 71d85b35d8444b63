"""What triage says of a measurement: a fault comes before any blame of the model."""

from __future__ import annotations

from dataclasses import dataclass, replace

from dashpot.data.correction import Correction
from dashpot.data.run import Run

ENERGY, OTHER_RUNS, RANGE, RECORD = "energy", "other_runs", "range", "record"


@dataclass(frozen=True)
class Fault:
    """A fault of one run: ``kind`` in a word, ``evidence`` in a sentence, ``cure`` says what to do.

    ``evidence_of`` says what shows it: ``energy`` that it gives back, ``other_runs`` that it does not agree with,
    ``range`` that its values end at, else what the ``record`` shows by itself.
    ``factor`` by which ``channel`` was multiplied here so that the run may stay; None for a run that is set aside.
    """

    run: str
    kind: str
    evidence: str
    cure: str
    factor: float | None = None
    channel: str = "force"
    evidence_of: str = RECORD

    @property
    def done(self) -> str:
        """What was done here."""
        if self.factor is None:
            return "left out here"
        return f"the {self.channel} was multiplied by {self.factor:.6g} here"

    @property
    def correction(self) -> Correction | None:
        """What was corrected here, for the dataset file; None for a run that is set aside."""
        if self.factor is None:
            return None
        return Correction(gain=self.factor) if self.channel == "force" else Correction(displacement_gain=self.factor)


def corrected(run: Run, fault: Fault) -> Run:
    """The run with the channel of a fault, also where it stands at a node, multiplied by its factor."""
    names = {fault.channel, f"{fault.channel}@{run.end}"} if run.end else {fault.channel}
    changed = {name: fault.factor * values for name, values in run.channels.items() if name in names}
    return replace(run, channels={**run.channels, **changed})
