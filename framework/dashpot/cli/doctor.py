"""``dashpot doctor``: is everything there that dashpot needs?"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, metadata, requires, version
from typing import TYPE_CHECKING, Any

import click

from dashpot.cli.columns import in_columns
from dashpot.cli.outcome import ExitCode
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, available_cores, switches

if TYPE_CHECKING:
    from dashpot.cli.checkup import Finding

MARKS = {"good": "ok", "note": "--", "fault": "!!"}


@click.command("doctor")
@switches("json", "quiet")
def verb(switches: Switches) -> int:
    """Check the installation, with advice for each fault.

    Checked are Python, the libraries, the compiler, the cache of compiled networks, the plugins, what is shipped, and
    what could be added. Reports are files that any browser opens; none is needed here. The exit code is 1 when there is
    a fault.

    \b
    Example:
      dashpot doctor
    """
    session = Session(switches)
    with session.watch("compiling"):
        findings = list(examine(session))
    faults = [finding for finding in findings if finding.state == "fault"]
    session.talk.result(as_text(findings), content_of(findings))
    if switches.quiet:
        for fault in faults:
            session.talk.warn(f"{fault.what}: {fault.found}. {fault.advice}")
    return ExitCode.WRONG_INPUT if faults else ExitCode.DONE


def examine(session: Session) -> Iterator[Finding]:
    """All findings."""
    from dashpot.cli import checkup
    from dashpot.kernel.cache import cache_folder
    from dashpot.model.shipped import spec_folder

    requirements = [checkup.Requirement.of(text) for text in requires("dashpot") or ()]
    about = metadata("dashpot")
    yield from checkup.python(about["Requires-Python"] if "Requires-Python" in about else "")
    yield from checkup.libraries(requirements, installed)
    yield from checkup.cache(cache_folder())
    yield from checkup.compiler()
    yield from checkup.threads(available_cores())
    yield from checkup.plugins(session.registry)
    yield from checkup.specs(spec_folder())
    yield from checkup.extras(requirements, installed, session.registry)


def installed(name: str) -> str | None:
    """The version of an installed distribution, None where it is not."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def as_text(findings: list[Finding]) -> str:
    """A line for each finding, below a fault what to do, then the sum."""
    lines = in_columns([(MARKS[each.state], each.what, each.found) for each in findings]).splitlines()
    advised = []
    for finding, line in zip(findings, lines, strict=True):
        advised += [line, *([f"    -> {finding.advice}"] if finding.advice else [])]
    return "\n".join([*advised, "", summary(findings)])


def summary(findings: list[Finding]) -> str:
    """The answer in a sentence."""
    count = Counter(finding.state for finding in findings)["fault"]
    return f"{count} fault{'s' * (count > 1)}: see what is marked {MARKS['fault']}" if count else "Nothing is wrong."


def content_of(findings: list[Finding]) -> dict[str, Any]:
    """What ``--json`` tells."""
    healthy = all(finding.state != "fault" for finding in findings)
    return {"format": "dashpot-doctor/1", "healthy": healthy, "findings": findings}
