"""The motions with which a network was identified, as its file records them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from dashpot.data.excitation import Excitation, channel_at
from dashpot.data.motion_range import motion_range
from dashpot.data.run import Run
from dashpot.fit.scored import ScoredRun
from dashpot.model.identified import outside
from dashpot.model.network import NetworkSpec
from dashpot.model.topology import topology_of


def seen_range(spec: NetworkSpec, runs: Sequence[ScoredRun]) -> dict[str, tuple[float, float]]:
    """The least and the largest of every quantity of the motion of each driven node; see ``data.motion_range``."""
    topology = topology_of(spec)
    records = {run.record or run.name: run.excitation for run in runs}
    seen = [each.at(topology.held("driven"), topology.held("loaded")) for each in records.values()]
    found: dict[str, tuple[float, float]] = {}
    for node in topology.held("driven"):
        ranges = motion_range([each.motions[node] for each in seen])
        found |= {channel_at(quantity, node): ends for quantity, ends in ranges.items()}
    return found


def covered(spec: NetworkSpec, excitation: Excitation) -> dict[str, tuple[float, float]]:
    """The same of a single run, with the strokes that count for the range that the network records."""
    topology, recorded = topology_of(spec), spec.identified.range
    motions = excitation.at(topology.held("driven"), topology.held("loaded")).motions
    return {
        channel_at(quantity, node): ends
        for node in topology.held("driven")
        for quantity, ends in motion_range([motions[node]], _smallest(recorded, node)).items()
    }


def beyond_range(spec: NetworkSpec, run: Run | Excitation) -> list[str]:
    """What of a run lies outside of the range of identification, in words; nothing where none is recorded."""
    recorded = spec.identified.range
    if not recorded:
        return []
    return outside(covered(spec, run if isinstance(run, Excitation) else Excitation.of_run(run)), recorded)


def warning_of_range(name: str, words: Sequence[str]) -> str:
    """The sentence for a run of that name with ``words`` from ``beyond_range``."""
    return f"run '{name}' lies outside of the range of identification: {'; '.join(words)}"


def _smallest(recorded: Mapping[str, tuple[float, float]], node: str) -> float | None:
    ends = recorded.get(channel_at("amplitude", node))
    return ends[0] if ends else None
