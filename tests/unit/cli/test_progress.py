"""Progress is seen where it helps, and nowhere else."""

from __future__ import annotations

import io
import time

import pytest

from dashpot.cli import progress as module
from dashpot.cli.progress import ProgressBar, describe


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_away_from_a_terminal_each_stage_is_one_line(capsys):
    with ProgressBar(quiet=False) as progress:
        for done in (0.1, 0.5, 1.0):
            progress("curve", done)
        progress("dynamics", None, 3.0, 1.0)
    output = capsys.readouterr()
    assert output.err == "curve ...\ndynamics ...\n"
    assert output.out == ""


@pytest.mark.parametrize("patience, shown", [(0.0, True), (60.0, False)])
def test_on_a_terminal_the_bar_waits_for_two_seconds(monkeypatch, patience, shown):
    stream = Terminal()
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setattr(module, "PATIENCE", patience)
    with ProgressBar(quiet=False) as progress:
        progress("curve", 0.5, 3.0, 1.0)
    assert ("curve, best 3, noise floor 1" in stream.getvalue()) is shown


def test_away_from_a_terminal_a_long_stage_tells_the_time_left(monkeypatch, capsys):
    now = [0.0]
    monkeypatch.setattr(module, "PAUSE", 10.0)
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    with ProgressBar(quiet=False) as progress:
        for second in range(0, 25):
            now[0] = float(second)
            progress("dynamics", second / 100, 3.0)
    assert capsys.readouterr().err == (
        "dynamics ...\ndynamics, best 3: 10 %, 1:30 left\ndynamics, best 3: 20 %, 1:20 left\n"
    )


def test_a_bar_appears_also_where_nothing_is_told(monkeypatch):
    stream = Terminal()
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setattr(module, "PATIENCE", 0.01)
    with ProgressBar(quiet=False, at_first="compiling"):
        deadline = time.monotonic() + 5.0
        while "compiling" not in stream.getvalue() and time.monotonic() < deadline:
            time.sleep(0.01)
    assert "compiling" in stream.getvalue()


def test_of_several_parts_the_time_left_is_that_of_all(capsys):
    with ProgressBar(quiet=False, parts=4) as progress:
        for number, name in enumerate("abcd"):
            progress(f"{name}: search", 0.5)
            assert progress._pace.share == pytest.approx((number + 0.5) / 4)
            progress(f"{name}: refinement")
            assert progress._pace.share == pytest.approx((number + 0.5) / 4)
    assert capsys.readouterr().err.startswith(
        "1 of 4, a: search ...\n1 of 4, a: refinement ...\n2 of 4, b: search ...\n"
    )


def test_quiet_is_quiet(monkeypatch, capsys):
    monkeypatch.setattr(module, "PATIENCE", 0.0)
    for stream in (Terminal(), io.StringIO()):
        monkeypatch.setattr("sys.stderr", stream)
        with ProgressBar(quiet=True) as progress:
            progress("curve", 0.5)
        assert stream.getvalue() == ""


def test_no_color_is_honoured(monkeypatch):
    stream = Terminal()
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setattr(module, "PATIENCE", 0.0)
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm-256color")
    with ProgressBar(quiet=False) as progress:
        progress("curve", 0.5)
    assert "curve" in stream.getvalue()
    assert "\x1b[3" not in stream.getvalue() and "\x1b[9" not in stream.getvalue()


def test_what_is_not_known_is_left_out():
    assert describe("curve", None, None) == "curve"
    assert describe("curve", 12.3456, None) == "curve, best 12.35"
