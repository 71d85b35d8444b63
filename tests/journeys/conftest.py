"""dashpot as a user gets it: a wheel, installed where there is no source tree."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import venv
from dataclasses import dataclass, field
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
OURS = re.compile(r"_?_?(editable__*)?_?dashpot", re.IGNORECASE)


@dataclass(frozen=True)
class Installation:
    """A virtual environment, and more folders for it to import from."""

    folder: Path
    also: tuple[Path, ...] = field(default=())

    @property
    def python(self) -> Path:
        return self.folder / "bin" / "python"

    def run(
        self, cwd: Path, program: str, *arguments: str | Path, **environment: str
    ) -> subprocess.CompletedProcess[str]:
        """Run a program of the environment from the folder ``cwd``."""
        clean = {
            name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "DASHPOT", "VIRTUAL"))
        }
        clean |= {"PYTHONPATH": os.pathsep.join(map(str, self.also)), **environment}
        command = [str(self.folder / "bin" / program), *map(str, arguments)]
        return subprocess.run(command, cwd=cwd, env=clean, capture_output=True, text=True)


def install(python: Path, *what: str | Path) -> None:
    """Install without a network and without dependencies, into the environment of ``python`` or where ``what`` says."""
    command = [sys.executable, "-m", "pip", "--python", str(python), "install", "--no-deps", "--no-index", "--quiet"]
    subprocess.run([*command, "--no-build-isolation", *map(str, what)], check=True)


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of the source tree."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    built = subprocess.run(build, capture_output=True, text=True)
    assert built.returncode == 0, built.stdout + built.stderr
    [path] = folder.glob("*.whl")
    return path


@pytest.fixture(scope="session")
def installation(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installation:
    """An empty environment with the wheel in it.

    The libraries that dashpot requires are linked from the environment of the tests, so that no network is needed;
    nothing of dashpot is among them.
    """
    made = Installation(tmp_path_factory.mktemp("empty") / "env")
    venv.create(made.folder, with_pip=False)
    [packages] = made.folder.glob("lib/python*/site-packages")
    libraries = made.folder / "libraries"
    libraries.mkdir()
    link_libraries(libraries)
    (packages / "libraries.pth").write_text(f"{libraries}\n", encoding="utf-8")
    install(made.python, wheel)
    return made


def link_libraries(folder: Path) -> None:
    """Link every installed library but dashpot into ``folder``."""
    places = [Path(place) for place in sys.path if Path(place).name in ("site-packages", "dist-packages")]
    for entry in (entry for place in places if place.is_dir() for entry in place.iterdir()):
        if not OURS.match(entry.name) and entry.suffix != ".pth" and not (folder / entry.name).exists():
            (folder / entry.name).symlink_to(entry)
