"""From what happened to an exit code and a message."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable, Sequence
from enum import IntEnum

import click

from dashpot.text.problem import InputError, Place, Problem

DEBUG = "DASHPOT_DEBUG"


class ExitCode(IntEnum):
    """What scripts may rely on."""

    DONE = 0
    WRONG_INPUT = 1
    USAGE = 2
    INTERRUPTED = 3
    FAULT = 70


def exit_code_of(work: Callable[[], object], as_json: bool = False) -> int:
    """Do the work; tell what went wrong on standard error, without a traceback unless ``DASHPOT_DEBUG`` is set.

    With ``as_json`` it stands on standard output as JSON, too.
    """
    try:
        result = work()
    except BrokenPipeError:
        return _end_of_reader()
    except (Exception, KeyboardInterrupt) as error:
        code, problems = _told(error)
    else:
        return result if isinstance(result, int) else ExitCode.DONE
    if as_json:
        _print(code, problems)
    return code


def _told(error: BaseException) -> tuple[ExitCode, Sequence[Problem]]:
    """Say what went wrong; its exit code and its problems."""
    if isinstance(error, click.UsageError):
        error.show()
        return ExitCode.USAGE, [Problem(Place(), error.format_message())]
    if isinstance(error, InputError):
        _tell(str(error))
        return ExitCode.WRONG_INPUT, error.problems
    code, message = _of_the_rest(error)
    _tell(message)
    return code, [Problem(Place(), message)]


def _of_the_rest(error: BaseException) -> tuple[ExitCode, str]:
    if isinstance(error, click.Abort | KeyboardInterrupt):
        return ExitCode.INTERRUPTED, "interrupted; the same command goes on"
    if isinstance(error, OSError):
        told = f"{error.filename}: {error.strerror}" if error.filename else str(error)
        return ExitCode.WRONG_INPUT, f"{told}. Check the name, its rights and the space that is left"
    return ExitCode.FAULT, (
        f"dashpot has a fault, this should not happen: {type(error).__name__}: {error}\n"
        f"Please report it with the command you ran and the traceback, which {DEBUG}=1 shows."
    )


def _print(code: ExitCode, problems: Sequence[Problem]) -> None:
    from dashpot.report.json_text import json_text

    click.echo(json_text({"format": "dashpot-error/1", "exit_code": int(code), "problems": problems}), nl=False)


def _end_of_reader() -> ExitCode:
    # whoever read our output (`| head`) has enough; without this Python complains when it closes standard output
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return ExitCode.DONE


def _tell(message: str) -> None:
    if os.environ.get(DEBUG, "0") not in ("", "0"):
        traceback.print_exc()
    click.echo(message, err=True)
