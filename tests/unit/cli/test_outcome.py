"""Every outcome has its exit code and one clear message; a traceback is shown only on demand."""

from __future__ import annotations

import click
import pytest

from dashpot.cli.outcome import exit_code_of
from dashpot.text.problem import InputError, Place, Problem


def raising(error: BaseException):
    def work():
        raise error

    return work


PROBLEMS = InputError([Problem(Place("a.yaml", 3, 5), "expected a number"), Problem(Place("a.yaml", 9, 1), "too deep")])

OUTCOMES = {
    "several mistakes": (PROBLEMS, 1, "a.yaml:3:5: expected a number\na.yaml:9:1: too deep\n"),
    "a file not there": (FileNotFoundError(2, "No such file or directory", "x.csv"), 1, "x.csv: No such file or dir"),
    "no space left": (OSError(28, "No space left on device"), 1, "No space left on device"),
    "misuse": (click.UsageError("no such thing"), 2, "Error: no such thing"),
    "ctrl-c": (KeyboardInterrupt(), 3, "interrupted; the same command goes on\n"),
    "ctrl-c within click": (click.Abort(), 3, "interrupted; the same command goes on\n"),
    "a fault of ours": (
        ZeroDivisionError("division by zero"),
        70,
        "ZeroDivisionError: division by zero\nPlease report",
    ),
}


@pytest.mark.parametrize("error, code, message", OUTCOMES.values(), ids=OUTCOMES)
def test_what_happened_decides_the_exit_code(capsys, monkeypatch, error, code, message):
    monkeypatch.delenv("DASHPOT_DEBUG", raising=False)
    assert exit_code_of(raising(error)) == code
    output = capsys.readouterr()
    assert message in output.err
    assert "Traceback" not in output.err
    assert output.out == ""


def test_work_that_is_done_gives_zero():
    assert exit_code_of(lambda: None) == 0


def test_the_debug_switch_shows_the_traceback(capsys, monkeypatch):
    monkeypatch.setenv("DASHPOT_DEBUG", "1")
    assert exit_code_of(raising(ZeroDivisionError("why"))) == 70
    assert "Traceback" in capsys.readouterr().err
