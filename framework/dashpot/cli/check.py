"""``dashpot check``: all mistakes and weaknesses of networks and datasets, and the differences of two networks."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dashpot.cli import complete
from dashpot.cli.outcome import ExitCode
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, switches
from dashpot.text.problem import InputError, Place, Problem, problem_lines

if TYPE_CHECKING:
    from dashpot.model.network import NetworkSpec


@click.command("check")
@click.argument("specs", nargs=-1, required=True, metavar="MODEL|DATASET...", shell_complete=complete.networks)
@click.option(
    "--against",
    "other",
    metavar="MODEL",
    help="List the differences of each MODEL from this one.",
    shell_complete=complete.networks,
)
@switches("json", "quiet", "allow_outside")
def verb(specs: tuple[str, ...], other: str | None, switches: Switches) -> int:
    """Report mistakes of networks and datasets.

    Every mistake and every weakness of a network file stands as file:line:column with what to do. Of a dataset, all
    faults of its file and its measurements, such as runs that generate energy.

    With --against the networks are compared by their structure, whatever names their parts have; where the structure is
    the same, by their parameters.

    \b
    Example:
      dashpot check kelvin_voigt my_network.yaml
      dashpot check my/dataset.yaml
      dashpot check my_network.yaml --against axle_model_3
    """
    session = Session(switches)
    found = {spec: problems_of(spec, session) for spec in specs}
    failed = [problem for problems in found.values() for problem in problems if problem.severity == "error"]
    content: dict[str, Any] = {
        "format": "dashpot-check/1",
        "specs": [{"spec": spec, "problems": problems} for spec, problems in found.items()],
    }
    lines = [line for spec, problems in found.items() if (line := praise(spec, problems))]
    if other and not failed:
        content["against"] = compared = differences(specs, other, session)
        lines += [line for entry in compared for line in tell(entry, other)]
    session.talk.result("\n".join(lines), content)
    for problems in found.values():
        for line in problem_lines(problem for problem in problems if problem.severity == "warning"):
            click.echo(line, err=True)
    if failed and switches.json:
        # the problems stand in the JSON above
        click.echo(str(InputError(failed)), err=True)
        return ExitCode.WRONG_INPUT
    if failed:
        raise InputError(failed)
    return ExitCode.DONE


def praise(spec: str, problems: tuple[Problem, ...]) -> str:
    """What is said of a network that can be used."""
    if any(problem.severity == "error" for problem in problems):
        return ""
    count = len(problems)
    return f"{spec}: good" + (f", with {count} warning{'s' * (count > 1)}" if count else "")


def problems_of(spec: str, session: Session) -> tuple[Problem, ...]:
    """What is wrong or weak with one network: with its text, its laws, or its structure. Or with a dataset."""
    from dashpot.data.description import is_dataset
    from dashpot.kernel.compiler.trace import trace_branch
    from dashpot.model.lint import find_weaknesses

    try:
        if is_dataset(Path(spec)):
            return problems_of_dataset(spec, session)
        network: NetworkSpec = session.network(spec)
        for branch in network.leaves():
            trace_branch(branch)
    except InputError as error:
        return error.problems
    return find_weaknesses(network)


def problems_of_dataset(path: str, session: Session) -> tuple[Problem, ...]:
    """What is wrong with a dataset file, and what triage finds in the runs that it holds."""
    from dashpot.data.dataset import read_dataset
    from dashpot.triage.examine import examine

    dataset = read_dataset(path, session.readers(), session.switches.allow_outside)
    found = (replace(problem, place=Place(path)) for problem in examine(dataset).problems)
    return (*dataset.problems, *found)


def differences(specs: tuple[str, ...], other: str, session: Session) -> list[dict[str, Any]]:
    """What each network differs in from another one."""
    from dashpot.model.likeness import compare_structures

    model = session.network(other)
    found = [(spec, compare_structures(session.network(spec), model)) for spec in specs]
    return [
        {
            "spec": spec,
            "other": other,
            "same_structure": likeness.same_structure,
            "structure": likeness.structure,
            "numbers": likeness.numbers,
        }
        for spec, likeness in found
    ]


def tell(entry: dict[str, Any], other: str) -> list[str]:
    """The differences in words, a line each."""
    if not entry["same_structure"]:
        return [
            f"{entry['spec']} against {other}: the structures differ",
            *(f"  {line}" for line in entry["structure"]),
        ]
    if not entry["numbers"]:
        return [f"{entry['spec']} against {other}: the same structure and the same parameters"]
    return [
        f"{entry['spec']} against {other}: the same structure, other parameters",
        *(f"  {line}" for line in entry["numbers"]),
    ]
