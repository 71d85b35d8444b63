"""The shell completes names that are installed, quickly and without anything heavy."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from dashpot.cli.completion import SHELLS, VARIABLE

PROGRAM = (
    "import atexit, sys; atexit.register(lambda: print('LOADED', *sys.modules)); from dashpot.cli import main; main()"
)
NEVER = {"numba", "pint", "plotly", "jinja2", "rich", "pandas"}


def complete(line: str) -> tuple[list[str], set[str]]:
    """What bash is offered at the end of a line, and the modules that were loaded for it."""
    words = {VARIABLE: "bash_complete", "COMP_WORDS": line, "COMP_CWORD": str(len(line.split(" ")) - 1)}
    told = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True, env={**os.environ, **words}
    )
    offered, _, loaded = told.stdout.rpartition("LOADED")
    return offered.split(), {name.partition(".")[0] for name in loaded.split()}


@pytest.mark.parametrize("shell", SHELLS)
def test_the_script_of_each_shell_asks_this_command(call, shell):
    code, out, _ = call("completion", shell)
    assert code == 0
    assert f"{VARIABLE}={shell}_complete" in out


@pytest.mark.parametrize(
    "line, offered",
    [
        ("dashpot compl", ["plain,completion"]),
        ("dashpot fit kelv", ["plain,kelvin_voigt", "file,kelv"]),
        ("dashpot diagnose spring my", ["file,my"]),
        ("dashpot list elem", ["plain,elements"]),
        ("dashpot study paper_t", ["plain,paper_tire", "file,paper_t"]),
        ("dashpot fit spring data --out", ["plain,--output"]),
    ],
)
def test_verbs_networks_files_and_options_need_no_plugin(line, offered):
    found, loaded = complete(line)
    assert found == offered
    assert not loaded & (NEVER | {"numpy", "scipy"})


@pytest.mark.parametrize(
    "line, offered",
    [
        ("dashpot fit spring data --optimizer ps", "plain,pso"),
        ("dashpot fit spring data --optimizer pso+least", "plain,pso+least_squares"),
        ("dashpot fit spring data --optimizer pso --set part", "plain,particles="),
        ("dashpot fit spring data --optimizer pso+least_squares --set pso.part", "plain,pso.particles="),
        ("dashpot simulate spring --rig tria", "plain,triangle"),
        ("dashpot simulate spring --rig triangle --set dep", "plain,depth="),
    ],
)
def test_things_of_plugins_and_their_options(line, offered):
    found, loaded = complete(line)
    assert offered in found
    assert not loaded & (NEVER | {"scipy"})
