"""What an importer of mock-up units gets, as FMPy sees it."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from unit.exports.mounts import leg, mount, sine

from dashpot import declare, load_registry
from dashpot.kernel.network import compile_network

fmpy = pytest.importorskip("fmpy")

CLOSE = 1e-9


def export(network, word: str, folder: Path) -> Path:
    [(name, content)] = load_registry().exports[word]().files(network).items()
    (folder / name).write_bytes(content)
    return folder / name


class Unit:
    """A unit of either version, stepped along a motion."""

    def __init__(self, path: Path) -> None:
        from fmpy.fmi2 import FMU2Slave
        from fmpy.fmi3 import FMU3Slave

        self.about = fmpy.read_model_description(str(path), validate=True)
        self.folder = fmpy.extract(str(path))
        newer = self.about.fmiVersion == "3.0"
        given = {"unzipDirectory": self.folder, "modelIdentifier": self.about.coSimulation.modelIdentifier}
        self.unit = (FMU3Slave if newer else FMU2Slave)(guid=self.about.guid, instanceName="it", **given)
        self.number = {each.name: each.valueReference for each in self.about.modelVariables}
        self.get = self.unit.getFloat64 if newer else self.unit.getReal
        self.set = self.unit.setFloat64 if newer else self.unit.setReal
        self.keep = self.unit.getFMUState if newer else self.unit.getFMUstate
        self.go_back = self.unit.setFMUState if newer else self.unit.setFMUstate
        self.drop = self.unit.freeFMUState if newer else self.unit.freeFMUstate
        self.unit.instantiate()
        if not newer:
            self.unit.setupExperiment(startTime=0.0)

    def begin(self, x: float, v: float) -> float:
        self.unit.enterInitializationMode()
        self._move(x, v)
        self.unit.exitInitializationMode()
        return self.get([self.number["force"]])[0]

    def step(self, k: int, x: float, v: float, dt: float) -> float:
        self._move(x, v)
        self.unit.doStep((k - 1) * dt, dt)
        return self.get([self.number["force"]])[0]

    def _move(self, x: float, v: float) -> None:
        self.set([self.number["displacement"], self.number["velocity"]], [x, v])

    def close(self) -> None:
        self.unit.terminate()
        self.unit.freeInstance()
        shutil.rmtree(self.folder)


@pytest.fixture(params=["fmu", "fmu2"])
def word(request) -> str:
    return request.param


@pytest.mark.parametrize("declared", [mount, leg])
def test_a_unit_gives_the_simulated_force(declared, word, tmp_path):
    unit, drive = Unit(export(declared(), word, tmp_path)), sine()
    network = compile_network(declared())
    expected = network.simulate(network.prepare(drive))
    motion = zip(drive.displacement, drive.velocity, strict=True)
    found = [unit.step(k, *at, drive.dt) if k else unit.begin(*at) for k, at in enumerate(motion)]
    unit.close()
    assert np.max(np.abs(found - expected)) <= CLOSE * np.max(np.abs(expected))


def test_a_unit_goes_back_to_a_kept_state(word, tmp_path):
    unit, drive = Unit(export(mount(), word, tmp_path)), sine()
    unit.begin(drive.displacement[0], drive.velocity[0])
    for k in range(1, 100):
        unit.step(k, drive.displacement[k], drive.velocity[k], drive.dt)
    state = unit.keep()
    first = [unit.step(k, drive.displacement[k], drive.velocity[k], drive.dt) for k in range(100, 150)]
    unit.go_back(state)
    again = [unit.step(k, drive.displacement[k], drive.velocity[k], drive.dt) for k in range(100, 150)]
    unit.drop(state)
    unit.close()
    assert first == again


def test_a_unit_is_valid_and_tells_units_starts_and_intervals(word, tmp_path):
    from fmpy.validation import validate_fmu

    path = export(mount(), word, tmp_path)
    assert validate_fmu(str(path)) == []
    about = fmpy.read_model_description(str(path))
    numbers = {each.name: each for each in about.modelVariables}
    limit = numbers["friction.limit"]
    assert (limit.unit, limit.start, limit.causality) == ("N", "60.0", "parameter")
    assert {each.name for each in about.modelVariables if each.causality == "input"} == {"displacement", "velocity"}


def test_another_number_changes_the_force(word, tmp_path):
    unit = Unit(export(mount(), word, tmp_path))
    unit.set([unit.number["rubber.stiffness"]], [3e5])
    assert unit.begin(1e-3, 0.0) == pytest.approx(300.0, rel=1e-12)
    unit.close()


def test_the_same_network_gives_the_same_bytes(word, tmp_path):
    first, second = (load_registry().exports[word]().files(mount()) for _ in range(2))
    assert first == second


def test_the_sources_in_a_unit_build_alone(word, tmp_path):
    path = export(mount(), word, tmp_path)
    shutil.unpack_archive(path, tmp_path / "unit", "zip")
    sources = sorted((tmp_path / "unit" / "sources").glob("*.c"))
    assert len(sources) == 2
    subprocess.run(
        [
            "cc",
            "-std=c99",
            "-pedantic",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-fPIC",
            "-shared",
            "-o",
            str(tmp_path / "it.so"),
            *map(str, sources),
            "-lm",
        ],
        check=True,
    )


def test_a_missing_compiler_is_told(word, monkeypatch):
    from dashpot.text.problem import InputError

    monkeypatch.setenv("PATH", "")
    with pytest.raises(InputError, match="needs the C compiler 'cc', which is not there"):
        load_registry().exports[word]().files(mount())


LOADED = """
format: dashpot-network/1
name: system
nodes: {block: {hold: loaded, mass: 5 kg}, wall: ground}
branches:
  spring: {element: spring, between: [block, wall], stiffness: 20 N/mm}
  damping: {element: damper, between: [block, wall], damping: 100 N*s/m}
"""


def test_a_force_driven_network_answers_its_displacement(word, tmp_path):
    unit = Unit(export(declare(LOADED), word, tmp_path))
    inputs = {each.name for each in unit.about.modelVariables if each.causality == "input"}
    assert inputs == {"force@block"}
    number = unit.number
    unit.unit.enterInitializationMode()
    unit.set([number["force@block"]], [100.0])
    unit.unit.exitInitializationMode()
    # the record begins at rest in equilibrium
    assert unit.get([number["displacement@block"]]) == pytest.approx([100.0 / 20e3], rel=1e-9)
    for k in range(400):
        unit.set([number["force@block"]], [50.0])
        unit.unit.doStep(k * 1e-3, 1e-3)
    time, rate, decay = 0.4, np.sqrt(20e3 / 5.0 - 100.0), 10.0
    free = np.exp(-decay * time) * (np.cos(rate * time) + decay / rate * np.sin(rate * time))
    assert unit.get([number["displacement@block"]])[0] == pytest.approx(2.5e-3 * (1.0 + free), rel=1e-2)
    unit.close()


IDENTIFIED = """
format: dashpot-network/1
name: known
branches:
  rubber: {element: spring, stiffness: {value: 200 N/mm, interval: [190 N/mm, 215 N/mm]}}
  damping: {element: damper, damping: 300 N*s/m}
"""


def test_the_interval_of_an_identified_number_stands_in_its_annotation(word, tmp_path):
    path = export(declare(IDENTIFIED), word, tmp_path)
    shutil.unpack_archive(path, tmp_path / "unit", "zip")
    text = (tmp_path / "unit" / "modelDescription.xml").read_text()
    stiffness, damping = text.partition('name="rubber.')[2].split('name="damping.')
    assert (
        ">190000.0 215000.0</" in stiffness
        and 'description="force over deflection, or its constant slope, identified"' in stiffness
    )
    assert (
        ">190000.0 215000.0</" not in damping
        and 'description="force over velocity, or its constant slope, fixed"' in damping
    )
