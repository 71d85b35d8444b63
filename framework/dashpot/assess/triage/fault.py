"""What triage says of a measurement: a fault comes before any blame of the model."""

from __future__ import annotations

from dataclasses import dataclass, replace

from dashpot.data.run import Run


@dataclass(frozen=True)
class Fault:
    """A fault of one run: ``kind`` in a word, ``evidence`` in a sentence, ``cure`` says what to do.

    ``factor`` by which the force was multiplied here so that the run may stay; None for a run that is set aside.
    """

    run: str
    kind: str
    evidence: str
    cure: str
    factor: float | None = None

    @property
    def sentence(self) -> str:
        """The fault for a list of warnings."""
        done = "left out here" if self.factor is None else f"its force was multiplied by {self.factor:.6g} here"
        return f"Run '{self.run}': {self.evidence}; {done}. {self.cure}."


def mended(run: Run, factor: float) -> Run:
    """The run with its force multiplied."""
    return replace(run, channels={**run.channels, "force": factor * run.force})
