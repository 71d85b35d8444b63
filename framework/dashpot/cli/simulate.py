"""``dashpot simulate``: the force of a network along measured or prescribed motions."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zipfile import ZipFile, ZipInfo

import click

from dashpot.cli import complete
from dashpot.cli.arguments import model_and_dataset
from dashpot.cli.energy import FILE as ENERGIES
from dashpot.cli.energy import write_energies
from dashpot.cli.session import Session, split_setting
from dashpot.cli.switches import Switches, output_option, switches

TABLE = "stiffness.csv"

if TYPE_CHECKING:
    import numpy as np

    from dashpot.data.run import Run
    from dashpot.kernel.api import RunSolution
    from dashpot.model.network import NetworkSpec

ROWS = 50_000  # that are written at a time


@click.command("simulate")
@model_and_dataset(optional=True)
@click.option(
    "--rig", metavar="RIG", help="A test procedure or a bench file that gives the motion.", shell_complete=complete.rigs
)
@click.option(
    "--set",
    "settings",
    metavar="KEY=VALUE",
    multiple=True,
    help='An option of the rig, e.g. depth="20 mm".',
    shell_complete=complete.settings,
)
@click.option("--energy", is_flag=True, help="Also the energy balance of every run and part: energy.csv.")
@click.option(
    "--tolerance",
    metavar="SHARE",
    type=click.FloatRange(1e-9, 1.0),
    default=1e-3,
    show_default=True,
    help="Allowed numerical error, as a share of the RMS force, where nodes are free to move.",
)
@click.option(
    "--refine",
    metavar="N",
    type=click.IntRange(1, 1000),
    help="N times as many steps between two samples as usual, in place of a tolerance.",
)
@click.option("--table", is_flag=True, help="Dynamic stiffness at the rows of the dataset's tables: stiffness.csv.")
@output_option("A folder; with DATASET also a file ending in .npz.", files=(".npz",))
@switches("seed", "json", "quiet", "force", "backend", "allow_outside")
def verb(
    model: str,
    dataset: str | None,
    rig: str | None,
    settings: tuple[str, ...],
    energy: bool,
    tolerance: float,
    refine: int | None,
    table: bool,
    output: Path,
    switches: Switches,
) -> None:
    """Simulate a network along runs or on a rig.

    The motions are those of a dataset, or those of a virtual test rig. MODEL is a network file or a shipped name. With
    DATASET the folder gets a CSV file for every run with time, displacement and the simulated force in SI units; an
    .npz file holds the force of each run under the run's name. With --rig it becomes a dataset, with the noise of the
    rig, that every verb reads. With --energy the work of the rig is balanced with the energy stored and dissipated.
    With --table the folder gets the dynamic stiffness of the network at the rows of the tables of the dataset, beside
    the measured one.

    \b
    Example:
      dashpot simulate gehmann.yaml my/dataset.yaml -o simulated
      dashpot simulate gehmann.yaml --rig tire_bench -o measured
    """
    if (dataset is None) == (rig is None):
        raise click.UsageError("Say either DATASET or --rig RIG")
    session = Session(switches)
    network = session.network(model)
    if table and (dataset is None or energy):
        raise click.UsageError("--table goes with DATASET, and without --energy")
    if rig is not None:
        return measure_on(rig, settings, network, output, session, energy, refine, tolerance)
    if settings:
        raise click.UsageError("--set gives an option of a rig: name it with --rig")
    assert dataset is not None
    if table:
        return tabulate(dataset, network, output, session, refine, tolerance)
    return follow(dataset, network, output, session, energy, refine, tolerance)


def follow(
    dataset: str,
    network: NetworkSpec,
    output: Path,
    session: Session,
    energy: bool,
    refine: int | None,
    tolerance: float,
) -> None:
    """Write the force along every measured run; no more than one of them is in memory at a time."""
    from dashpot.data.excitation import Excitation
    from dashpot.fit.seen_range import beyond_range
    from dashpot.kernel.api import forces_by_name, solve_each
    from dashpot.kernel.settings import require_settings

    runs = session.runs(dataset)
    require_settings(network, runs.conditions)
    archive = output.suffix == ".npz"
    files = [f"{name}.csv" for name in runs.names]
    others = [ENERGIES] * energy
    folder = session.claim_beside(output, *others) if archive else session.claim(output, *map(escape, files), *others)
    forces, names, beyond = ForceArchive(), list[str](), dict[str, list[str]]()
    error = peak = 0.0
    with folder.together() as results:
        with session.watch("compiling") as progress:
            solved = solve_each(network, runs, len(runs.names), refine=refine, tolerance=tolerance, progress=progress)
            for run, solution in solved:
                if archive:
                    forces.add(forces_by_name({run.name: solution}))
                else:
                    results.write_pieces(f"{run.name}.csv", csv_pieces(run, solution))
                names.append(run.name)
                beyond[run.name] = beyond_range(network, run)
                error, peak = max(error, *solution.error.values()), max(peak, *solution.peak.values())
        session.warn_of(runs.problems)
        warn_of_range(beyond, session)
        if archive:
            results.write_bytes(output.name, forces.content())
        if energy:
            write_energies(network, map(Excitation.of_run, runs), results, session.talk)
    session.talk.result(
        f"simulated {len(names)} runs: {output}{told_error(error)}",
        content_of(network, names, output, (error, peak), beyond),
    )


def tabulate(
    dataset: str, network: NetworkSpec, output: Path, session: Session, refine: int | None, tolerance: float
) -> None:
    """Write the dynamic stiffness at every row of the tables of a dataset."""
    from dashpot.data.steady import STEADY
    from dashpot.data.stiffness_text import table_text
    from dashpot.fit.seen_range import beyond_range
    from dashpot.kernel.api import solve_each
    from dashpot.kernel.settings import require_settings
    from dashpot.text.problem import InputError, Place

    runs = session.runs(dataset)
    require_settings(network, runs.conditions)
    folder = session.claim(output, TABLE)
    rows = [run for run in runs if run.kind == STEADY]
    if not rows:
        raise InputError.at(Place(dataset), "the dataset has no table of dynamic stiffness", "list one under 'tables'")
    with session.watch("compiling") as progress:
        solved = solve_each(network, rows, len(rows), refine=refine, tolerance=tolerance, progress=progress)
        found = list(solved)
    folder.write(TABLE, table_text((run, next(iter(solution.force.values()))) for run, solution in found))
    session.warn_of(runs.problems)
    beyond = {run.name: beyond_range(network, run) for run in rows}
    warn_of_range(beyond, session)
    error, peak = (
        max(max(bounds.values(), default=0.0) for bounds in each)
        for each in zip(*((solution.error, solution.peak) for _, solution in found), strict=True)
    )
    session.talk.result(
        f"simulated {len(rows)} rows: {output / TABLE}{told_error(error)}",
        content_of(network, list(beyond), output, (error, peak), beyond),
    )


def measure_on(
    rig: str,
    settings: tuple[str, ...],
    network: NetworkSpec,
    output: Path,
    session: Session,
    energy: bool,
    refine: int | None,
    tolerance: float,
) -> None:
    """Write what a virtual rig measures as a dataset."""
    from dashpot.compare.metrics import metric_lines, metric_rows
    from dashpot.contract.bench import find_bench
    from dashpot.data.dataset import Dataset
    from dashpot.data.ends import one_force_each
    from dashpot.data.writing import dataset_files
    from dashpot.fit.driven import NOTE
    from dashpot.fit.seen_range import beyond_range
    from dashpot.fit.virtual_test import bench_as_driven, virtual_test

    try:
        bench = find_bench(rig, session.registry.rigs, dict(map(split_setting, settings)))
    except ValueError as error:
        raise click.UsageError(str(error)) from error
    with session.watch("compiling") as progress:
        bench = bench_as_driven(network, bench, refine, tolerance)
        runs = virtual_test(network, bench, session.switches.seed, refine, progress, tolerance)
    files = dataset_files(f"{network.name} on {bench.name} (virtual)", runs)
    folder = session.claim(output, *map(escape, files), *[ENERGIES] * energy)
    beyond = {planned.name: beyond_range(network, planned.excitation()) for planned in bench.runs()}
    warn_of_range(beyond, session)
    limited = {planned.name: planned.notes[NOTE] for planned in bench.runs() if NOTE in planned.notes}
    for name, words in limited.items():
        session.talk.warn(f"run '{name}' is not as planned: {words}")
    with folder.together() as results:
        for name, text in files.items():
            results.write(name, text)
        if energy:
            write_energies(network, (planned.excitation() for planned in bench.runs()), results, session.talk)
    dataset = output / "dataset.yaml"
    names = [run.name for run in runs]
    told = metric_rows(session.registry.metrics.values(), one_force_each(Dataset(bench.name, tuple(runs))).runs)
    content = {**content_of(network, names, dataset, (None, None), beyond), "metrics": told, NOTE: limited}
    session.talk.result("\n".join([f"measured {len(runs)} runs: {dataset}", *metric_lines(told)]), content)


def warn_of_range(beyond: Mapping[str, list[str]], session: Session) -> None:
    """Warn of runs beyond the range of identification."""
    from dashpot.fit.seen_range import warning_of_range

    for name, words in beyond.items():
        if words:
            session.talk.warn(warning_of_range(name, words))


def content_of(
    network: NetworkSpec,
    runs: list[str],
    output: Path,
    errors: tuple[float | None, float | None],
    beyond: Mapping[str, list[str]],
) -> dict[str, Any]:
    """What ``--json`` tells: the network, its runs and where they are, bounds in N of the root mean square and of the
    peak of the numerical ``errors``, and the runs that go ``beyond`` the range of identification.
    """
    return {
        "format": "dashpot-simulation/1",
        "network": network.name,
        "runs": runs,
        "output": str(output),
        "numerical_error": errors[0],
        "numerical_error_peak": errors[1],
        "outside_of_identification": {name: words for name, words in beyond.items() if words},
    }


def csv_pieces(run: Run, solution: RunSolution) -> Iterator[str]:
    """Time (s), measured and simulated displacements (m) and simulated forces (N), as the shortest texts that read back
    alike, some rows at a time.
    """
    from dashpot.data.excitation import channel_at

    columns = {"time": ("s", run.time)}
    columns |= {name: ("m", values) for name, values in run.channels.items() if name.startswith("displacement")}
    columns |= {channel_at("displacement", node): ("m", values) for node, values in solution.motion.items()}
    columns |= {channel_at("force", node): ("N", values) for node, values in solution.force.items()}
    yield ",".join(columns) + "\n" + ",".join(unit for unit, _ in columns.values()) + "\n"
    for first in range(0, run.time.size, ROWS):
        rows = zip(*(values[first : first + ROWS].tolist() for _, values in columns.values()), strict=True)
        yield "".join(",".join(map(repr, row)) + "\n" for row in rows)


def told_error(largest: float) -> str:
    """The largest estimated numerical error of a force in words, where there is one."""
    return f"; estimated numerical error of the forces at most {largest:.2g} N rms" if largest else ""


class ForceArchive:
    """Forces (N) by run as a NumPy archive, without a date in it; any name of a run will do."""

    def __init__(self) -> None:
        self._bytes = io.BytesIO()
        self._archive = ZipFile(self._bytes, "w")

    def add(self, forces: Mapping[str, np.ndarray]) -> None:
        """Add some."""
        import numpy as np

        for name, force in forces.items():
            with self._archive.open(ZipInfo(f"{name}.npy"), "w") as member:
                np.lib.format.write_array(member, force, allow_pickle=False)

    def content(self) -> memoryview:
        """The bytes of the archive, to which nothing more can be added."""
        self._archive.close()
        return self._bytes.getbuffer()
