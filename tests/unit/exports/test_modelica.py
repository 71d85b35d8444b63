"""What a Modelica tool gets."""

from __future__ import annotations

import csv
import html
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from unit.exports.modelica_functions import Array, functions_of
from unit.exports.mounts import SAMPLES, STEP, leg, mount, sine

from dashpot import declare, load_registry
from dashpot.data.drive import drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.kernel.export import exported
from dashpot.kernel.network import compile_network
from dashpot.kernel.targets.modelica.model import unit_of

CURVED = """
format: dashpot-network/1
name: curved
branches:
  rubber: {element: spring, stiffness: {deflection: [-2 mm, 0 mm, 1 mm, 3 mm], force: [-300 N, 0 N, 200 N, 900 N]}}
  sliding: {element: prandtl, stiffness: 400 N/mm, limit: 50 N}
"""


def written(network) -> str:
    [content] = load_registry().exports["modelica"]().files(network).values()
    return content.decode()


NODES = """
format: dashpot-network/1
name: car
gravity: 9.81 m/s^2
nodes: {left: driven, right-hand: driven, body: {mass: 50 kg}, arm: {hold: loaded, mass: 5 kg}}
branches:
  a: {element: spring, between: [left, body], stiffness: 20 N/mm}
  b: {element: damper, between: [right-hand, body], damping: 500 N*s/m}
  c: {element: spring, between: [right-hand, arm], stiffness: 30 N/mm}
  d: {element: prandtl, between: [arm, body], stiffness: 100 N/mm, limit: 50 N}
"""
SMOOTH_LOOP = """
format: dashpot-network/1
name: smooth
branches:
  loop: {element: bouc_wen, stiffness: 400 N/mm, limit: 50 N, exponent: 1, shape: 0.5}
"""
SPAN = 4e-3


def run(network, drives, loads) -> np.ndarray:
    """All answers (samples, answers) of the function that a model calls at every sample."""
    sampled, online = functions_of(written(network))["sampled"], exported(network).online
    numbers = Array(exported(network).values)
    memory, found = Array(np.zeros(online.size)), []
    for k in range(drives[0].samples):
        x, v = (Array([getattr(each, name)[k] for each in drives]) for name in ("displacement", "velocity"))
        memory = sampled(memory, drives[0].dt, numbers, x, v, Array([load[k] for load in loads]), SPAN)
        found.append(memory.values[online.outputs : online.before])
    return np.array(found)


@pytest.mark.parametrize(
    "network", [mount(), declare(CURVED), leg(), declare(SMOOTH_LOOP)], ids=["mount", "curved", "leg", "loop"]
)
def test_the_functions_give_the_simulated_force(network):
    drive, compiled = sine(200), compile_network(network)
    expected = compiled.simulate(compiled.prepare(drive))
    force = run(network, [drive], [])[:, 0]
    assert np.max(np.abs(force - expected)) <= 1e-12 * np.max(np.abs(expected))


def test_the_functions_solve_for_nodes_under_motions_and_loads():
    network, left, samples = declare(NODES), sine(150), 150
    right = drive_from_path(left.dt, *(0.5 * each for each in (left.displacement, left.velocity, left.acceleration)))
    load = 20.0 * np.sin(np.linspace(0.0, 9.0, samples))
    compiled = compile_network(network)
    excitation = Excitation({"left": left, "right-hand": right}, {"arm": load}, {}, left.dt, samples, "run")
    expected = compiled.solve(compiled.prepare(excitation))
    found = run(network, [left, right], [load])
    # a load goes straight from sample to sample here, along a spline there
    assert np.max(np.abs(found[:, :2].T - expected.force[0])) <= 2e-3 * np.max(np.abs(expected.force))


@pytest.mark.parametrize(
    "network", [mount(), declare(CURVED), leg(), declare(NODES)], ids=["mount", "curved", "leg", "nodes"]
)
def test_a_parser_takes_the_text(network):
    parser = pytest.importorskip("pymoca.parser")
    tree = parser.parse(written(network))
    assert tree is not None
    inner = tree.classes[network.name].classes
    assert {"Specimen", "Law"} <= set(inner) and "sampled" in inner["Law"].classes


def test_numbers_are_parameters_with_units_and_intervals():
    about = '"sliding force, identified, 95 % interval 55 to 66"'
    assert f"parameter Real 'friction.limit'(unit = \"N\") = 60.0 {about};" in written(mount())
    assert "'leg.valve.damping'(unit = \"N.s/m\") = 2000.0" in written(leg())


@pytest.mark.parametrize(
    ("unit", "expected"),
    [
        ("1", "1"),
        ("N*s^2/m^2", "N.s2/m2"),
        ("N/(m/s)", "N.s/m"),
        ("N/m/K", "N/(m.K)"),
        ("1/s", "1/s"),
        ("N*s^0.3/m", ""),
    ],
)
def test_units_are_those_of_the_language(unit, expected):
    assert unit_of(unit) == expected


def test_the_documentation_states_the_law_of_every_branch():
    text = written(replace(leg(), about='a "leg" of <rubber>'))
    info = html.unescape(text.partition('info = "')[2])
    assert 'a "leg" of <rubber>' in info and "In parallel: rubber, leg (in series: leg.valve, leg.bush)." in info
    assert "leg.valve: damper" in info and "F = f(v)" in info
    assert "d between arm and body" in written(declare(NODES))


@pytest.mark.parametrize("name", ["expm1", "log1p"])
def test_functions_that_the_language_lacks_lose_no_digits(name):
    # after Bouc and Wen with half a shape: the law needs both near zero, where 1 + x would be 1
    law = functions_of(written(declare(SMOOTH_LOOP)))[name]
    x = np.concatenate([side * 10.0 ** np.linspace(-40.0, -0.01, 200) for side in (-1.0, 1.0)] + [[0.0, 3.0, 40.0]])
    expected = getattr(np, name)(x)
    assert np.max(np.abs([law(each) for each in x] - expected) / np.maximum(np.abs(expected), 1e-300)) <= 1e-15


def test_nodes_have_flanges_inputs_and_places():
    text = written(declare(NODES))
    assert "Flange_a flange_left;" in text and "flange_right_hand.f = force[2];" in text
    assert 'RealInput load_arm(unit = "N");' in text and "discrete Modelica.Units.SI.Position place_body" in text
    assert "Flange_a flange_a" in written(leg()) and "place_" not in written(leg())


def integrated(drive) -> np.ndarray:
    """The force of the mount by its rate equations, with small steps of a general integrator."""
    rate, size = 60.0, 2e-3

    def rates(t, state):
        speed = size * rate * np.cos(rate * t)
        friction, relaxing = state
        return speed * 900e3 * (1.0 - np.sign(speed) * friction / 60.0), 150e3 * speed - relaxing / 20e-3

    at = drive.dt * np.arange(drive.samples)
    friction, relaxing = solve_ivp(
        rates, (0.0, at[-1]), (0.0, 0.0), t_eval=at, method="DOP853", rtol=1e-9, atol=1e-9, max_step=1e-4
    ).y
    return 220e3 * drive.displacement + friction + relaxing


def test_the_functions_follow_the_rate_equations_of_the_laws():
    drive = sine(200)
    expected = integrated(drive)
    # between samples the path is a cubic
    assert np.max(np.abs(run(mount(), [drive], [])[:, 0] - expected)) <= 1e-5 * np.max(np.abs(expected))


BENCH = """
model Bench
  mount.Specimen specimen(step = 1e-3);
  Modelica.Blocks.Sources.Sine sine(amplitude = 2e-3, f = 60.0 / (2.0 * Modelica.Constants.pi));
  Modelica.Mechanics.Translational.Sources.Position move(exact = true);
  Modelica.Mechanics.Translational.Components.Fixed fixed;
equation
  connect(sine.y, move.s_ref);
  connect(move.flange, specimen.flange_a);
  connect(specimen.flange_b, fixed.flange);
end Bench;
"""
SCRIPT = """
loadModel(Modelica); getErrorString();
loadFile("mount.mo"); getErrorString();
loadFile("Bench.mo"); getErrorString();
simulate(Bench, stopTime = 0.4, numberOfIntervals = 400, tolerance = 1e-9, outputFormat = "csv"); getErrorString();
"""


@pytest.mark.skipif(shutil.which("omc") is None, reason="OpenModelica is not installed")
def test_openmodelica_gives_the_simulated_force(tmp_path):
    for name, text in (("mount.mo", written(mount())), ("Bench.mo", BENCH), ("run.mos", SCRIPT)):
        (tmp_path / name).write_text(text)
    done = subprocess.run(["omc", "run.mos"], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert (tmp_path / "Bench_res.csv").is_file(), done.stdout
    with (tmp_path / "Bench_res.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    # the last row of a moment is that after its event
    forces = {
        round(float(row["time"]) / STEP): float(row["specimen.force[1]"])
        for row in rows
        if abs(float(row["time"]) / STEP - round(float(row["time"]) / STEP)) < 1e-6
    }
    compiled = compile_network(mount())
    expected = compiled.simulate(compiled.prepare(sine()))
    found = np.array([forces[k] for k in range(SAMPLES)])
    assert np.max(np.abs(found - expected)) <= 1e-6 * np.max(np.abs(expected))
