"""Work put in = stored + dissipated: closed forms of loops, passive elements, every shipped network."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from verification.shipped import KNOTS

from dashpot import load_registry
from dashpot.data.drive import Drive, drive_from_path, drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.kernel.energy import EnergyBalance, EnergyCounter
from dashpot.model.network import Characteristic, NetworkSpec, Value
from dashpot.model.reading import parse_network, read_network
from dashpot.model.shipped import shipped_networks
from dashpot.testing import draw_sizes, draw_specimens, random_drive

REGISTRY = load_registry()
RNG = np.random.default_rng(seed_of("test_energy"))
SEED = int(RNG.integers(2**32))
DT = 1e-3
# a contact that is shorter than a step has no work that could be counted; see test_elements_that_change
STRUCK = {"rattling_mass"}
# a force that jumps at a touch has a work that is right to a step
PAIRS = {"loose_kelvin_voigt": 8}
PASSIVE = {word for word, law in REGISTRY.elements.items() if law.passive and law.declares.states}
REMEMBERING = sorted((PASSIVE | PAIRS.keys()) - STRUCK)
QUICK = {"kelvin_voigt", "eub", "quarter_car"}
NETWORKS = [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in shipped_networks()]


@pytest.fixture
def rng() -> np.random.Generator:
    print(f"seed {SEED}")
    return np.random.default_rng(SEED)


def network(text: str) -> NetworkSpec:
    return parse_network(f"format: dashpot-network/1\nname: account\n{text}", REGISTRY.elements)


def alone(word: str, **numbers: float) -> NetworkSpec:
    listed = "".join(f", {key}: {value!r}" for key, value in numbers.items())
    return network(f"branches: {{part: {{element: {word}{listed}}}}}")


def sine(amplitude: float, frequency: float, cycles: int) -> Drive:
    time, turning = DT * np.arange(round(cycles / frequency / DT) + 1), 2.0 * np.pi * frequency
    sin, cos = amplitude * np.sin(turning * time), amplitude * np.cos(turning * time)
    return drive_from_path(DT, sin, turning * cos, -(turning**2) * sin)


def last_cycle(counter: EnergyCounter, amplitude: float, frequency: float, cycles: int) -> tuple[float, float]:
    """What the last of some cycles dissipates and how much more is stored after it."""
    before, after = (counter.balance(sine(amplitude, frequency, count)) for count in (cycles - 1, cycles))
    return after.dissipated - before.dissipated, after.stored - before.stored


def test_a_dashpot_dissipates_the_area_of_its_ellipse(rng):
    damping, amplitude, frequency = 500.0 * rng.uniform(0.5, 2.0), 5e-3 * rng.uniform(0.5, 2.0), 8.0
    lost, kept = last_cycle(EnergyCounter.of(alone("damper", damping=damping)), amplitude, frequency, 2)
    assert lost == pytest.approx(np.pi * damping * 2.0 * np.pi * frequency * amplitude**2, rel=1e-7)
    assert kept == 0.0


def test_a_dahl_slider_dissipates_the_area_of_its_loop(rng):
    stiffness, limit, amplitude = 6e4 * rng.uniform(0.5, 2.0), 80.0 * rng.uniform(0.5, 2.0), 5e-3
    yielding = limit / stiffness
    lost, kept = last_cycle(EnergyCounter.of(alone("dahl", stiffness=stiffness, limit=limit)), amplitude, 2.0, 4)
    area = 4.0 * limit * (amplitude - yielding * np.tanh(amplitude / yielding))
    assert lost == pytest.approx(area, rel=1e-5)
    assert abs(kept) < 1e-5 * area


def test_a_maxwell_element_stores_in_its_spring_and_dissipates_its_loss_stiffness(rng):
    stiffness, time, amplitude, frequency = 2e4 * rng.uniform(0.5, 2.0), 0.03 * rng.uniform(0.5, 2.0), 5e-3, 4.0
    counter = EnergyCounter.of(alone("maxwell", stiffness=stiffness, relaxation_time=time))
    dynamic = stiffness / (1.0 + 1.0 / (2j * np.pi * frequency * time))
    decayed = np.exp(-11.0 / (frequency * time))
    lost, _ = last_cycle(counter, amplitude, frequency, 12)
    loss = np.pi * amplitude**2 * dynamic.imag
    assert lost == pytest.approx(loss, rel=1e-7 + 100.0 * decayed)
    # a sine ends where its displacement is zero: the force is that of the loss stiffness
    held = 0.5 * (amplitude * dynamic.imag) ** 2 / stiffness
    assert counter.balance(sine(amplitude, frequency, 12)).stored == pytest.approx(held, rel=1e-7 + 100.0 * decayed)


def test_a_hydraulic_mount_dissipates_its_loss_stiffness(rng):
    mass, walls, chamber, damping = 50.0, 2e5, 3e4, 1600.0 * rng.uniform(1.0, 2.0)
    amplitude, frequency = 1e-3, 8.0
    turning = 2.0 * np.pi * frequency
    track = chamber - mass * turning**2 + 1j * turning * damping
    loss = np.pi * amplitude**2 * (walls * track / (walls + track)).imag
    spec = alone("hydro", fluid_mass=mass, stiffness=walls, damping=damping, compensation_stiffness=chamber)
    lost, kept = last_cycle(EnergyCounter.of(spec), amplitude, frequency, 16)
    decayed = np.exp(-damping / (2.0 * mass) * 15.0 / frequency)
    assert lost == pytest.approx(loss, rel=1e-6 + 100.0 * decayed)
    assert abs(kept) < (1e-6 + 100.0 * decayed) * loss


def test_an_absorber_dissipates_its_loss_stiffness(rng):
    mass, stiffness, damping = 5.0, 2e4, 160.0 * rng.uniform(1.0, 2.0)
    amplitude, frequency = 1e-3, 8.0
    turning = 2.0 * np.pi * frequency
    hung = stiffness + 1j * turning * damping
    loss = np.pi * amplitude**2 * (-mass * turning**2 * hung / (hung - mass * turning**2)).imag
    spec = alone("vibration_absorber", mass=mass, stiffness=stiffness, damping=damping)
    lost, kept = last_cycle(EnergyCounter.of(spec), amplitude, frequency, 16)
    decayed = np.exp(-damping / (2.0 * mass) * 15.0 / frequency)
    assert lost == pytest.approx(loss, rel=1e-6 + 100.0 * decayed)
    assert abs(kept) < (1e-6 + 100.0 * decayed) * loss


def test_a_wheel_and_a_body_dissipate_what_their_complex_amplitudes_say(rng):
    tire, suspension, damping = 2e5, 2.5e4, 1500.0 * rng.uniform(0.7, 1.4)
    masses, frequency, amplitude = np.array([36.0, 346.0]), 10.0, 2e-3
    spec = network(f"""
nodes: {{platform: driven, wheel: {{mass: 36 kg}}, body: {{mass: 346 kg}}}}
branches:
  tire: {{element: spring, stiffness: {tire!r}, between: [platform, wheel]}}
  spring: {{element: spring, stiffness: {suspension!r}, between: [wheel, body]}}
  damper: {{element: damper, damping: {damping!r}, between: [wheel, body]}}
""")
    turning = 2.0 * np.pi * frequency
    leg = suspension + 1j * turning * damping
    matrix = np.array([[tire + leg, -leg], [-leg, leg]]) - np.diag(masses) * turning**2
    wheel, body = np.linalg.solve(matrix, [tire * amplitude, 0.0])
    lost, _ = last_cycle(EnergyCounter.of(spec), amplitude, frequency, 60)
    assert lost == pytest.approx(np.pi * damping * turning * abs(wheel - body) ** 2, rel=2e-5)


def test_the_kinetic_and_the_potential_energy_of_a_mass_are_those_at_the_end():
    spec = network("""
gravity: 9.81 m/s^2
nodes: {platform: driven, mass: {mass: 7 kg}}
branches: {rod: {element: spring, stiffness: 1e8, between: [platform, mass]},
           brake: {element: damper, damping: 1e4, between: [platform, mass]}}
""")
    time = DT * np.arange(1001)
    lift = drive_from_path(DT, 0.1 * time**3, 0.3 * time**2, 0.6 * time)
    balance = EnergyCounter.of(spec).balance(lift)
    (mass,) = balance.masses
    assert mass.stored == pytest.approx(0.5 * 7.0 * 0.3**2 + 7.0 * 9.81 * 0.1, rel=1e-5)
    assert balance.put_in == pytest.approx(mass.stored, rel=1e-4)


@pytest.mark.parametrize("word", REMEMBERING)
def test_a_passive_element_never_gives_dissipated_work_back(word, rng):
    sizes = draw_sizes(rng)
    specimen = draw_specimens(REGISTRY.elements[word], rng, sizes, 3)[0]
    counter = EnergyCounter.of(specimen.spec)
    drive = random_drive(rng, "multisine", sizes.length, sizes.time, 2400, sizes.time / 40.0)
    for values in specimen.values:
        parts = [_part(drive, count) for count in range(300, 2401, 150)]
        course = [counter.balance(part, values, PAIRS.get(word, 1)) for part in parts]
        lost, slack = np.array([b.dissipated for b in course]), 10.0 * max(b.error for b in course)
        work = np.max(np.abs([b.put_in for b in course]))
        assert np.min(np.diff(lost)) >= -slack - 1e-9 * work
        # a motion that stays within a play, or hardly leaves it, does next to no work
        assert slack <= max(0.02 * work, 1e-5 * sizes.of("N*m"))


@pytest.mark.parametrize("name", NETWORKS)
def test_the_work_put_into_a_shipped_network_is_stored_and_dissipated(name, state):
    spec = read_network(name, REGISTRY.elements)
    for path, curve in spec.data_curves().items():
        values = tuple(Value(1.8e5 * x + 1e6 * x * x, "N", scale="linear") for x in KNOTS.tolist())
        spec = spec.with_curve(path, Characteristic(curve.curve, "table", values, tuple(KNOTS.tolist()), curve.data))
    balance = _excited(EnergyCounter.of(spec), name)
    total = sum(abs(share.work) for share in (*balance.branches, *balance.masses))
    assert abs(balance.missing) < 1e-6 * total
    assert balance.put_in == pytest.approx(balance.stored + balance.dissipated + balance.missing, abs=1e-12 * total)
    assert balance.error < 1e-3 * total
    assert min(share.dissipated + 10.0 * share.error for share in balance.branches) >= 0.0
    state(f"energy of {name}: {balance.put_in:.3g} J put in, {balance.missing:.1e} J missing")


def _excited(counter: EnergyCounter, name: str) -> EnergyBalance:
    time = DT * np.arange(800)
    fade = 1.0 - np.exp(-((time / 0.1) ** 3))
    nodes = counter.system.outputs
    middle = 0.016 if nodes == ("",) else 0.0
    drives = {
        node: drive_from_samples(DT, middle + 3e-3 * fade * np.sin(16.0 * np.pi * time + number), smooth=False)
        for number, node in enumerate(nodes)
    }
    return counter.balance(Excitation(drives, {}, {}, DT, time.size, name))


def _part(drive: Drive, count: int) -> Drive:
    return drive_from_path(drive.dt, drive.displacement[:count], drive.velocity[:count], drive.acceleration[:count])
