"""From what happened to an exit code and a message."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable
from enum import IntEnum

import click

from dashpot.text.problem import InputError

DEBUG = "DASHPOT_DEBUG"


class ExitCode(IntEnum):
    """What scripts may rely on."""

    DONE = 0
    WRONG_INPUT = 1
    USAGE = 2
    INTERRUPTED = 3
    FAULT = 70


def exit_code_of(work: Callable[[], object]) -> int:
    """Do the work; tell what went wrong on standard error, without a traceback unless ``DASHPOT_DEBUG`` is set."""
    try:
        result = work()
    except click.UsageError as error:
        error.show()
        return ExitCode.USAGE
    except InputError as error:
        _tell(str(error))
        return ExitCode.WRONG_INPUT
    except (click.Abort, KeyboardInterrupt):
        _tell("interrupted; the same command goes on")
        return ExitCode.INTERRUPTED
    except BrokenPipeError:
        return _end_of_reader()
    except OSError as error:
        told = f"{error.filename}: {error.strerror}" if error.filename else str(error)
        _tell(f"{told}. Check the name, its rights and the space that is left")
        return ExitCode.WRONG_INPUT
    except Exception as error:
        return _fault(error)
    return result if isinstance(result, int) else ExitCode.DONE


def _end_of_reader() -> ExitCode:
    # whoever read our output (`| head`) has enough; without this Python complains when it closes standard output
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return ExitCode.DONE


def _fault(error: Exception) -> ExitCode:
    _tell(
        f"dashpot has a fault, this should not happen: {type(error).__name__}: {error}\n"
        f"Please report it with the command you ran and the traceback, which {DEBUG}=1 shows."
    )
    return ExitCode.FAULT


def _tell(message: str) -> None:
    if os.environ.get(DEBUG, "0") not in ("", "0"):
        traceback.print_exc()
    click.echo(message, err=True)
