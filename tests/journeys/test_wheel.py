"""The wheel alone holds everything that a user needs."""

from __future__ import annotations

import zipfile

import pytest

from .conftest import ROOT

# what the build adds: the one file of plotly that reports need, with its licence
OF_PLOTLY = {"dashpot/report/plotly.min.js", "dashpot/report/plotly-LICENSE.txt"}
SOURCES = {"framework/dashpot": "dashpot", "plugins": "", "specs": "dashpot/specs"}


def source_files() -> set[str]:
    """What lies in the source tree, under the names that it has in the wheel; pages beside the packages stay out."""
    found = set()
    for folder, target in SOURCES.items():
        for path in (ROOT / folder).rglob("*"):
            beside = path.parent == ROOT / folder and path.name == "README.md"
            if path.is_file() and "__pycache__" not in path.parts and not beside:
                found.add("/".join(part for part in (target, path.relative_to(ROOT / folder).as_posix()) if part))
    return found


def test_the_wheel_holds_the_source_tree_and_nothing_else(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    assert {name for name in names if ".dist-info/" not in name} == source_files() | OF_PLOTLY
    assert any(name.endswith(".dist-info/licenses/LICENSE") for name in names)


def test_the_installed_package_is_not_the_source_tree(installation, tmp_path):
    program = "import dashpot, dashpot_elements; print(dashpot.__file__, dashpot_elements.__file__)"
    done = installation.run(tmp_path, "python", "-c", program)
    assert done.returncode == 0, done.stderr
    assert str(ROOT) not in done.stdout
    assert done.stdout.count(str(installation.folder)) == 2


@pytest.mark.parametrize("kind, word", [("elements", "maxwell"), ("networks", "kelvin_voigt"), ("plugins", "elements")])
def test_the_built_in_things_are_found_from_another_folder(installation, tmp_path, kind, word):
    done = installation.run(tmp_path, "dashpot", "list", kind)
    assert done.returncode == 0, done.stderr
    assert any(line.split()[0] == word for line in done.stdout.splitlines())


def test_no_built_in_plugin_has_a_fault(installation, tmp_path):
    done = installation.run(tmp_path, "dashpot", "list", "plugins")
    assert done.stderr == ""
    assert "set aside" not in done.stdout


def test_a_shipped_network_is_checked(installation, tmp_path):
    done = installation.run(tmp_path, "dashpot", "check", "kelvin_voigt")
    assert (done.returncode, done.stdout) == (0, "kelvin_voigt: good\n"), done.stderr


def test_the_module_is_the_command(installation, tmp_path):
    done = installation.run(tmp_path, "python", "-m", "dashpot", "chek")
    assert done.returncode == 2
    assert "did you mean 'check'?" in done.stderr


# short runs: what is compared is the affair of other tests
MEASURE = """
from pathlib import Path
from dashpot import load_registry
from dashpot_specimens import test_tire
test_tire.SWEEP_DURATION, test_tire.LOOP_DURATION = 3.0, 12.0
print(load_registry().specimens["test_tire"]().measure(Path("data"), 1))
"""


# as where the package plotly was never installed
WITHOUT_PLOTLY = "import sys; sys.modules['plotly'] = None; from dashpot.cli import main; sys.exit(main(sys.argv[1:]))"


def test_networks_are_compared_on_measured_data(installation, tmp_path):
    data = installation.run(tmp_path, "python", "-c", MEASURE)
    assert data.returncode == 0, data.stderr
    arguments = ["compare", "spring", "kelvin_voigt", "--data", data.stdout.strip(), "-o", "out"]
    done = installation.run(tmp_path, "python", "-c", WITHOUT_PLOTLY, *arguments, DASHPOT_DEBUG="1")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"compare.json", "compare.csv", "report.html"}
