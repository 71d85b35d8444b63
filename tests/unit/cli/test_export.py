"""``dashpot export`` and ``--backend``."""

from __future__ import annotations

import json
import os

import pytest

from dashpot.cli import main

MOUNT = "format: dashpot-network/1\nname: mount\nbranches: {rubber: {element: spring, stiffness: 220 N/mm}}\n"


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mount.yaml").write_text(MOUNT)
    return tmp_path / "mount.yaml"


def test_the_files_of_a_target_are_written_and_told(file, capsys):
    assert main(["export", "mount.yaml", "--to", "c", "-o", "out", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told == {"format": "dashpot-export/1", "network": "mount", "target": "c", "files": ["mount.c", "mount.h"]}
    assert sorted(path.name for path in (file.parent / "out").iterdir()) == told["files"]


def test_nothing_is_overwritten_unasked(file, capsys):
    command = ["export", "mount.yaml", "--to", "c", "-o", "out"]
    assert main(command) == 0
    assert main(command) == 1
    assert "mount.h" in capsys.readouterr().err
    assert main([*command, "--force"]) == 0


def test_an_unknown_target_is_told_with_the_nearest(file, capsys):
    assert main(["export", "mount.yaml", "--to", "modelika", "-o", "out"]) == 2
    assert "modelica" in capsys.readouterr().err


def test_nothing_is_written_for_a_network_that_cannot_be_exported(file, capsys):
    assert main(["export", "gehmann", "--to", "c", "-o", "out"]) == 1
    assert "is to be taken from data" in capsys.readouterr().err
    assert not (file.parent / "out").exists()


def test_a_backend_gives_the_same_files_and_is_forgotten(file, capsys):
    for backend in ("llvm", "numba"):
        command = ["simulate", "mount.yaml", "--rig", "triangle", "-o", backend, "--backend", backend]
        assert main(command) == 0
        assert "DASHPOT_BACKEND" not in os.environ
    first, second = (sorted((file.parent / name).iterdir()) for name in ("llvm", "numba"))
    assert [path.read_bytes() for path in first] == [path.read_bytes() for path in second]


SEEN = "identified:\n  range: {displacement: [-20 mm, 40 mm], speed: [0 m/s, 0.1 mm/s]}\n"


@pytest.mark.parametrize("seen", ["", SEEN], ids=["unknown", "known"])
def test_a_simulation_beyond_the_range_of_identification_is_warned_of(seen, file, capsys):
    file.write_text(MOUNT + seen)
    assert main(["simulate", "mount.yaml", "--rig", "triangle", "-o", "out", "--json"]) == 0
    out, err = capsys.readouterr()
    told = json.loads(out)["outside_of_identification"]
    assert set(told) == ({"quasi_static"} if seen else set())
    assert ("identified in 0 mm/s to 0.1 mm/s" in err) is bool(seen)
    assert main(["simulate", "mount.yaml", "--data", "out", "-o", "again"]) == 0
    assert ("identified in 0 mm/s to 0.1 mm/s" in capsys.readouterr().err) is bool(seen)


PRESSED = """format: dashpot-network/1
name: mount
branches:
  rubber:
    element: spring
    stiffness: {value: 220 N/mm, over: {setting: pressure, at: 2 bar, slope: 10 N/mm/bar}}
"""


def test_a_setting_gives_the_parameters_that_depend_on_it(file, capsys):
    file.write_text(PRESSED)
    command = ["export", "mount.yaml", "--to", "c", "-o", "out"]
    assert main(command) == 1
    error = capsys.readouterr().err
    assert "depends on the setting 'pressure', which is not given" in error and "--at pressure=VALUE" in error
    assert not (file.parent / "out").exists()
    assert main([*command, "--at", "pressure=2.5 bar"]) == 0
    # 220 N/mm and half a bar of 10 N/mm/bar
    assert '{"rubber.stiffness", "N/m", 225000.0}' in (file.parent / "out" / "mount.c").read_text()
    assert "(at pressure 250000 in SI)" in (file.parent / "out" / "mount.h").read_text()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (["pressure=2 bar", "load=3 N"], "no parameter of 'mount' depends on the setting 'load'"),
        (["pressure"], "--at expected KEY=VALUE, got 'pressure'"),
        (["pressure=2 fur"], "unknown unit 'fur'"),
    ],
)
def test_a_setting_that_makes_no_sense_is_told(file, capsys, given, message):
    file.write_text(PRESSED)
    options = [word for each in given for word in ("--at", each)]
    assert main(["export", "mount.yaml", "--to", "c", "-o", "out", *options]) == 2
    assert message in capsys.readouterr().err
