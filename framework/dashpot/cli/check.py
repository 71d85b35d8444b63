"""``dashpot check``: all mistakes of network files at once."""

from __future__ import annotations

import click

from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, switches
from dashpot.text.problem import InputError, Problem


@click.command("check")
@click.argument("specs", nargs=-1, required=True, metavar="SPEC...")
@switches("json", "quiet")
def verb(specs: tuple[str, ...], switches: Switches) -> None:
    """Say every mistake of network files, each as file:line:column with what to do.

    \b
    Example:
      dashpot check kelvin_voigt my_network.yaml
    """
    session = Session(switches)
    found = {spec: problems_of(spec, session) for spec in specs}
    good = "\n".join(f"{spec}: good" for spec, problems in found.items() if not problems)
    entries = [{"spec": spec, "problems": problems} for spec, problems in found.items()]
    session.talk.result(good, {"format": "dashpot-check/1", "specs": entries})
    if any(found.values()):
        raise InputError(problem for problems in found.values() for problem in problems)


def problems_of(spec: str, session: Session) -> tuple[Problem, ...]:
    """What is wrong with one network: with its text, or with solving it."""
    from dashpot.kernel.trace import trace_network

    try:
        trace_network(session.network(spec))
    except InputError as error:
        return error.problems
    return ()
