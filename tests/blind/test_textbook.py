"""The blind cases of the second kind: their laws against closed forms, their specimens, their strength, their seeds."""

import ast
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from run import Bench
from test_truth import ALLOWED, imported
from textbook import KINDS, RIGS, draw_textbook
from textbook.laws import delayed, logarithmic, ogden_roxburgh, ringing
from textbook.memory import maxwell, slider
from textbook.motion import MOTIONS, derivative, triangle
from textbook.record import Circumstances, Record
from textbook.specimen import NETWORKS, Specimen

from dashpot.contract.registry import load_registry
from dashpot.data.drive import drive_from_path
from dashpot.kernel.network import compile_network
from dashpot.model.reading import read_network

PACKAGE = Path(__file__).parent / "textbook"
RATE = 1000.0
TIME = np.arange(4000) / RATE
TREAD = replace(RIGS["tread"], rate=RATE)
CASE = Circumstances(TREAD, frozenset({"spoiled"}), 0.0, 0.8)


def record(displacement, **others):
    velocity = derivative(displacement, RATE)
    return Record(
        "run",
        "transient",
        TIME,
        displacement,
        velocity,
        derivative(velocity, RATE),
        **{"force": 2e5 * displacement, **others},
    )


def complex_stiffness(displacement, force, frequency):
    """First harmonic of the force over that of the displacement, in the last second."""
    turn = np.exp(-2j * np.pi * frequency * TIME[-1000:])
    return (force[-1000:] @ turn) / (displacement[-1000:] @ turn)


def test_it_imports_nothing_of_dashpot():
    names = {
        name
        for file in PACKAGE.glob("*.py")
        for node in ast.walk(ast.parse(file.read_text()))
        for name in imported(node)
    }
    assert {name.split(".")[0] for name in names} <= ALLOWED | {"truth"}
    assert {name for name in names if name.startswith("truth")} == {"truth.case", "truth.label"}


@pytest.mark.parametrize("frequency", [3.0, 40.0])
def test_a_maxwell_element_has_its_storage_and_its_loss(frequency):
    path = 1e-3 * np.sin(2 * np.pi * frequency * TIME)
    s = 2j * np.pi * frequency * 0.02
    assert complex_stiffness(path, maxwell(path, 0.02, RATE), frequency) == pytest.approx(s / (1 + s), rel=2e-3)


def test_a_slider_dissipates_four_times_reach_by_slip():
    path = 1e-3 * np.sin(2 * np.pi * 5.0 * TIME)
    area = np.trapezoid(slider(path, 2e-4)[-201:], path[-201:])
    assert area == pytest.approx(4 * 2e-4 * (1e-3 - 2e-4), rel=0.01)


def test_a_mass_on_a_spring_rings_where_it_should():
    frequency = 10.0
    path = 1e-3 * np.sin(2 * np.pi * frequency * TIME)
    s, own = 2j * np.pi * frequency, 2 * np.pi * 0.8 * TREAD.band[1]
    expected = s**2 * own**2 / (s**2 + 0.1 * own * s + own**2)
    found = complex_stiffness(path, ringing(record(path), CASE), frequency)
    assert found == pytest.approx(expected, rel=2e-3)


def test_creep_after_a_step_is_a_logarithm():
    held = logarithmic(record(np.full(TIME.size, 2e-3)), CASE)
    assert held == pytest.approx(-2e-3 * np.log10(1.0 + TIME / 0.3), abs=1e-12)


def test_on_virgin_ground_nothing_is_lost():
    there = 5e-3 * TIME / TIME[-1]
    back = np.concatenate([there[::2], there[::-2]])
    assert np.abs(ogden_roxburgh(record(there), CASE)).max() == 0.0
    assert ogden_roxburgh(record(back), CASE)[2500:3500].max() < -1e-4


def test_a_delay_is_a_force_that_comes_late():
    path = 1e-3 * np.sin(2 * np.pi * 5.0 * TIME)
    run = record(path)
    late = run.force + delayed(run, 2e-3)
    assert late[10:] == pytest.approx(run.force[8:-2], abs=1e-6 * np.abs(run.force).max())


@pytest.mark.parametrize("rig", RIGS)
def test_every_motion_keeps_to_its_amplitude_and_its_band(rig, rng):
    for motion in MOTIONS:
        path = motion(RIGS[rig], rng)
        spectrum = np.abs(np.fft.rfft(path * np.hanning(path.size))) ** 2
        frequency = np.fft.rfftfreq(path.size, 1.0 / RIGS[rig].rate)
        assert 0.9 < np.abs(path).max() <= 1.0 + 1e-9
        assert spectrum[frequency > 1.1 * RIGS[rig].band[1] + 1.0].sum() < 1e-2 * spectrum.sum()
    assert triangle(RIGS[rig]).max() > RIGS[rig].farthest


@pytest.mark.parametrize("network", NETWORKS)
def test_the_network_of_a_specimen_has_its_force(network, rng, tmp_path):
    """The compiled network, with the numbers of the specimen, is what the second kind of truth integrates."""
    rig = RIGS["mount"]
    specimen = replace(Specimen.draw(network, rig, rng), quadratic=0.0, cubic=0.0)
    path = 1e-3 * MOTIONS[0](rig, rng)
    velocity = derivative(path, rig.rate)
    force = specimen.force(path, velocity, rig)
    text = specimen.write_network("specimen", rig).replace("from: quasi_static", "start: 1 N/mm")
    (tmp_path / "network.yaml").write_text(text)
    spec = read_network(tmp_path / "network.yaml", load_registry().elements)
    k = specimen.stiffness
    numbers = {
        "stiffness.stiffness": k,
        "damping.damping": specimen.damping,
        "relaxation.stiffness": 0.2 * k,
        "relaxation.relaxation_time": specimen.relaxation_time,
        "joint.stiffness": 0.15 * k,
        "joint.exponent": 0.0,
        "joint.limit": 0.15 * k * specimen.reach,
    }
    values = np.array([[numbers[slot.path] for slot in spec.slots()]])
    drive = drive_from_path(1.0 / rig.rate, path, velocity, derivative(velocity, rig.rate))
    found = compile_network(spec).along(drive)(values)[0]
    assert np.std(found - force) < 1e-4 * np.std(force)


@pytest.mark.parametrize("rig", RIGS)
def test_what_is_hidden_has_its_strength_and_its_label(rig, seed, tmp_path):
    """By the difference of the forces from those of the same case with nothing hidden."""
    case = draw_textbook(seed, rig, "quadratic_damping", 2.0, folder=tmp_path / "some")
    draw_textbook(seed, rig, "null", folder=tmp_path / "none")
    truth = case.label.open("something")
    (effect,) = truth.effects
    assert effect.kind == "quadratic_damping"
    assert effect.strength_left == pytest.approx(2.0)
    assert effect.strength >= effect.strength_left
    assert not re.search("quadratic_damping|strength|null", (case.folder / "dataset.yaml").read_text())
    some, none = (sorted((tmp_path / kind).glob("*.csv")) for kind in ("some", "none"))
    assert len(some) == 17
    errors = [
        np.std(np.loadtxt(a, delimiter=",", skiprows=1)[:, 2] - np.loadtxt(b, delimiter=",", skiprows=1)[:, 2])
        for a, b in zip(some, none, strict=True)
    ]
    assert max(errors) > truth.noise["rms"]


def test_a_seed_repeats_its_case_and_words_are_checked(seed, tmp_path):
    one, other = (draw_textbook(seed, "mount", double=True, folder=tmp_path / name) for name in ("a", "b"))
    assert one.label.open("x") == other.label.open("x")
    assert all(path.read_bytes() == (other.folder / path.name).read_bytes() for path in one.folder.iterdir())
    with pytest.raises(ValueError, match="kind: expected words of friction, .* got nonsense"):
        draw_textbook(seed, "mount", "nonsense", folder=tmp_path / "c")
    with pytest.raises(ValueError, match="mount: expected no option but"):
        Bench(sensors=True).run(seed, "mount")


def test_two_different_effects_are_drawn(seed, tmp_path):
    truth = draw_textbook(seed, "strut", double=True, folder=tmp_path).label.open("x")
    assert len(set(truth.kinds)) == 2
    assert set(truth.kinds) < set(KINDS)


def test_the_engine_names_what_is_hidden_on_a_rig_of_another_size(seed):
    """A law of the textbook on two rigs: not both may be missed (P(both | 0.95) = 2.5e-3)."""
    outcomes = [Bench().run(seed, rig, "friction", 2.0) for rig in ("bushing", "strut")]
    for outcome in outcomes:
        print(outcome.line())
    assert any(outcome.right for outcome in outcomes)
