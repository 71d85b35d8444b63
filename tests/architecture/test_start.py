"""The command starts at once, and importing dashpot costs nothing."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

HEAVY = {"numpy", "scipy", "numba", "llvmlite", "pandas", "plotly", "pint", "jinja2", "rich"}
IMPORT = "import dashpot"
HELP = "from dashpot.cli import main; main(['--help'])"
LIST = "from dashpot.cli import main; main(['list'])"
CHECK = "from dashpot.cli import main; main(['check', 'gehmann'])"
SHOWN = "; import sys; print('LOADED', *sys.modules)"


def loaded(program: str) -> set[str]:
    """Top-level modules that a program has imported at its end."""
    output = subprocess.run([sys.executable, "-c", program + SHOWN], capture_output=True, text=True, check=True).stdout
    return {name.split(".")[0] for name in output.rpartition("LOADED")[2].split()}


def seconds(program: str) -> float:
    """The least CPU time of several runs, since others may be using the machine."""
    times = []
    for _ in range(5):
        before = os.times()
        subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
        after = os.times()
        times.append(after.children_user + after.children_system - before.children_user - before.children_system)
    return min(times)


@pytest.mark.parametrize("program", [IMPORT, HELP])
def test_nothing_heavy_is_imported(program):
    assert not loaded(program) & HEAVY


@pytest.mark.parametrize("program", [LIST, CHECK])
def test_lists_and_checks_need_numpy_alone(program):
    assert loaded(program) & HEAVY == {"numpy"}


def test_importing_dashpot_takes_less_than_a_tenth_of_a_second():
    assert seconds(IMPORT) - seconds("pass") < 0.1


def test_the_help_takes_less_than_half_a_second():
    assert seconds(HELP) < 0.5


def test_every_public_name_is_found():
    import dashpot

    missing = []
    for name in dashpot.__all__:
        try:
            getattr(dashpot, name)
        except (ImportError, AttributeError) as error:
            missing.append(f"{name}: {error}")
    assert not missing, "\n".join(missing)


def test_an_unknown_name_is_an_attribute_error():
    import dashpot

    with pytest.raises(AttributeError, match="module 'dashpot' has no attribute 'Elemnt'"):
        _ = dashpot.Elemnt
