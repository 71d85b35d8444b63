"""Simulating measured runs, as the load cell would show them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.registry import Registry, load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.excitation import Excitation, settings_of
from dashpot.data.run import Run
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.settings import require_settings
from dashpot.kernel.solution import Solution, Status
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.within import TOLERANCE, solve_at, solve_within
from dashpot.model.network import END, NetworkSpec
from dashpot.model.reading import read_network
from dashpot.text.problem import InputError, Place

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RunSolution:
    """A simulated run: ``force`` (n,) in N at the driven nodes, as load cells show it, and ``motion`` (n,) in m of the
    nodes that are free to move, both by node. ``error`` is meant as a bound of the root mean square numerical error of
    each force in N, ``peak`` as one of its largest absolute value; they are 0 where the law is solved exactly along the
    path. ``refine`` is how many times as many steps as usual lay between two samples.
    """

    force: Mapping[str, Array]
    motion: Mapping[str, Array]
    error: Mapping[str, float]
    peak: Mapping[str, float]
    refine: int = 1


def solve_runs(
    spec: NetworkSpec | str | Path,
    dataset: Dataset,
    *,
    refine: int | None = None,
    tolerance: float = TOLERANCE,
    registry: Registry | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> dict[str, RunSolution]:
    """Forces and motions of a network along the motions of every run, by the name of the run.

    The forces are seen through the network's ``measurement`` (gain, offset ...). A network given by file or shipped
    name is read with the elements of ``registry``, by default the installed ones. Where the motion of a node is
    unknown, so many steps lie between two samples that the error of each force is at most the ``tolerance``, a share of
    its root mean square; or, by hand, ``refine`` times as many as usual. ``progress`` hears of each run, by
    name and with the share of those before it. Raises InputError for a network with mistakes or with a curve that has
    no numbers yet, for a run that lacks a motion, and for one that cannot be solved.
    """
    if not isinstance(spec, NetworkSpec):
        spec = read_network(spec, (registry or load_registry()).elements)
    require_settings(spec, {run.name: settings_of(run) for run in dataset.runs})
    solved = solve_each(spec, dataset.runs, len(dataset.runs), refine=refine, tolerance=tolerance, progress=progress)
    return {run.name: solution for run, solution in solved}


def solve_each(
    spec: NetworkSpec,
    runs: Iterable[Run],
    count: int,
    *,
    refine: int | None = None,
    tolerance: float = TOLERANCE,
    progress: Callable[[str, float], None] | None = None,
) -> Iterator[tuple[Run, RunSolution]]:
    """The same for one of ``count`` runs after the other; none is kept."""
    network = compile_network(spec)
    for number, run in enumerate(runs):
        if progress:
            progress(run.name, number / count)
        yield run, solve(network, Excitation.of_run(run), refine, tolerance)


def solve(
    network: CompiledNetwork | CompiledSystem,
    excitation: Excitation,
    refine: int | None = None,
    tolerance: float = TOLERANCE,
) -> RunSolution:
    """One run with the parameters of the file. Raises InputError with the reason where it cannot be solved."""
    observation = network.observation(network.start, excitation)
    if isinstance(network, CompiledNetwork):
        alone = network.simulate(network.prepare(excitation))
        return RunSolution({END: observation.see(alone[None], excitation.dt)[0]}, {}, {END: 0.0}, {END: 0.0})
    if refine is None:
        bounded = solve_within(network, excitation, None, tolerance)
    else:
        bounded = solve_at(network, excitation, refine)
    found = _good(network, bounded.solution, excitation)
    force = [observation.see(row[None], excitation.dt)[0] for row in found.force[0]]
    motion = {node: row for node, row in zip(found.unknown, found.motion[0], strict=True) if ":" not in node}
    error, peak = (dict(zip(found.driven, each.tolist(), strict=True)) for each in (bounded.error, bounded.peak))
    return RunSolution(dict(zip(found.driven, force, strict=True)), motion, error, peak, bounded.refine)


def _good(network: CompiledSystem, found: Solution, excitation: Excitation) -> Solution:
    if found.status[0] is not Status.GOOD:
        raise InputError.at(
            Place(network.spec.file),
            f"{excitation.name or 'the run'} cannot be simulated: {found.status[0].value}",
            "check the parameters with 'dashpot check'",
        )
    return found


def simulate_runs(
    spec: NetworkSpec | str | Path, dataset: Dataset, *, registry: Registry | None = None
) -> dict[str, Array]:
    """The force (n,) in N of a network along the motion of every run, by the name of the run; see ``solve_runs``.

    Where a network has several driven nodes the names are ``run@node``.
    """
    return forces_by_name(solve_runs(spec, dataset, registry=registry))


def forces_by_name(found: Mapping[str, RunSolution]) -> dict[str, Array]:
    """All forces, called ``run`` or, where there are several, ``run@node``."""
    return {
        f"{name}@{node}" if len(each.force) > 1 else name: force
        for name, each in found.items()
        for node, force in each.force.items()
    }
