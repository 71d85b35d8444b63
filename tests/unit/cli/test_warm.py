"""``dashpot warm``: compiled once, then known; and a fit finds what it needs."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.data.drive import drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.kernel.network import compile_network
from dashpot.kernel.parts import take_apart
from dashpot.kernel.targets.llvm import native
from dashpot.model.reading import read_network

NETWORK = """format: dashpot-network/1
name: pair
branches:
  spring: {element: spring, stiffness: {from: quasi_static}}
  relaxation: {element: maxwell, stiffness: 7 N/mm, relaxation_time: 20 ms}
"""
NODES = """format: dashpot-network/1
name: nodes
nodes: {lower: driven, body: {mass: 5 kg}, wheel: {hold: loaded, mass: {setting: added_mass, value: 1 kg}}}
branches:
  a: {element: spring, between: [lower, body], stiffness: 20 N/mm}
  b: {element: damper, between: [wheel, body], damping: 100 N*s/m}
  c: {element: spring, between: [wheel, lower], stiffness: 20 N/mm}
"""
TABLE = "{deflection: [0 mm, 2 mm, 5 mm, 9 mm], force: [0 N, 40 N, 90 N, 200 N]}"


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path / "cache"))
    (tmp_path / "pair.yaml").write_text(NETWORK)
    return tmp_path / "pair.yaml"


def test_a_second_call_compiles_nothing(call, file, monkeypatch):
    code, text, error = call("warm", file, "--json")
    assert code == 0, error
    assert json.loads(text)["new"] > 0
    monkeypatch.setattr(native, "compiled", None)
    code, text, error = call("warm", file, "--json")
    assert code == 0, error
    assert json.loads(text)["new"] == 0


def test_after_it_nothing_is_left_to_compile(call, file, monkeypatch):
    assert call("warm", file)[0] == 0
    monkeypatch.setattr(native, "compiled", None)
    native._native.cache_clear()
    file.write_text(NETWORK.replace("{from: quasi_static}", TABLE))
    spec = read_network(file, load_registry().elements)
    drive = drive_from_samples(1e-3, 1e-3 * np.sin(np.arange(200.0)))
    whole = compile_network(spec)
    for network in (whole, *(part.network for part in take_apart(spec).members)):
        for lanes in (1, 40):
            force = network.simulate(network.prepare(drive), np.repeat(network.start[None], lanes, axis=0))
            assert np.isfinite(force).all()


def test_a_network_with_a_mistake_is_told(call, file):
    file.write_text(NETWORK.replace("maxwell", "maxwel"))
    code, _, error = call("warm", file)
    assert code == 1 and "maxwell" in error


def kept(folder: Path) -> set[str]:
    return {path.name for path in folder.rglob("*.nbc")}


@pytest.mark.parametrize("text", [NETWORK, NODES], ids=["pair", "nodes"])
def test_after_it_nothing_is_left_to_compile_on_numba(call, file, tmp_path, monkeypatch, text):
    file.write_text(text)
    code, told, error = call("warm", file, "--backend", "numba", "--json")
    assert code == 0, error
    before = kept(tmp_path)
    file.write_text(text.replace("{from: quasi_static}", TABLE))
    assert json.loads(told)["new"] == len(before) > 0
    monkeypatch.setenv("DASHPOT_BACKEND", "numba")
    network = compile_network(read_network(file, load_registry().elements))
    drive = drive_from_samples(1e-3, 1e-3 * np.sin(np.arange(200.0)))
    whole = Excitation({"lower": drive}, {"wheel": np.zeros(200)}, {}, drive.dt, drive.samples)
    run = network.prepare(drive if text == NETWORK else whole)
    values = np.repeat(network.start[None], 5, axis=0)
    assert np.isfinite(network.simulate(run, values)).all()
    assert np.isfinite(network.score([run], [np.zeros(200)], [np.ones(200)], values)).all()
    assert kept(tmp_path) == before
