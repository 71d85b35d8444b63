"""``dashpot simulate``: the force of a network along measured motions."""

from __future__ import annotations

import io
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING
from zipfile import ZipFile, ZipInfo

import click

from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, output_option, switches

if TYPE_CHECKING:
    import numpy as np

    from dashpot.data.run import Run


@click.command("simulate")
@click.argument("spec")
@click.option("--data", "dataset", metavar="DATASET", required=True, help="Measured runs that give the motion.")
@output_option("A folder for one CSV file per run, or a file ending in .npz.")
@switches("quiet", "force")
def verb(spec: str, dataset: str, output: Path, switches: Switches) -> None:
    """Simulate a network along the measured motion of every run.

    SPEC is a network file or a shipped name. Each CSV file holds time, displacement and the simulated force in SI
    units; an .npz file holds the force of each run under the run's name.

    \b
    Example:
      dashpot simulate gehmann --data my/dataset.yaml -o simulated
    """
    from dashpot.kernel.api import simulate_runs

    session = Session(switches)
    network, measured = session.network(spec), session.dataset(dataset)
    archive = output.suffix == ".npz"
    files = [output.name] if archive else [f"{run.name}.csv" for run in measured.runs]
    folder = session.claim(output.parent if archive else output, *map(escape, files))
    forces = simulate_runs(network, measured, registry=session.registry)
    if archive:
        folder.write_bytes(output.name, npz_bytes(forces))
    else:
        for name, force in forces.items():
            folder.write(f"{name}.csv", csv_text(measured.run(name), force))
    session.talk.say(f"simulated {len(forces)} runs: {output}")


def csv_text(run: Run, force: np.ndarray) -> str:
    """A run's time (s), displacement (m) and simulated force (N), each as the shortest text that reads back alike."""
    rows = zip(run.time.tolist(), run.displacement.tolist(), force.tolist(), strict=True)
    return "\n".join(["time,displacement,force", "s,m,N", *(",".join(map(repr, row)) for row in rows)]) + "\n"


def npz_bytes(forces: dict[str, np.ndarray]) -> bytes:
    """The forces (N) by run as a NumPy archive, without a date in it; any name of a run will do."""
    import numpy as np

    content = io.BytesIO()
    with ZipFile(content, "w") as archive:
        for name, force in forces.items():
            with archive.open(ZipInfo(f"{name}.npy"), "w") as member:
                np.lib.format.write_array(member, force, allow_pickle=False)
    return content.getvalue()
