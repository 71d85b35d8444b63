"""Every built-in cause on a small view: what its cure adds to the network is what its columns showed."""

import numpy as np
import pytest

from dashpot.contract.registry import load_registry
from dashpot.data.drive import drive_from_samples
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.eager import simulate_eagerly
from dashpot.kernel.network import compile_network
from dashpot.kernel.settings import with_settings
from dashpot.model.network import Branch, Characteristic, Group, NetworkSpec, Value
from dashpot.model.reading import parse_network
from dashpot_causes import compliant_damper

REGISTRY = load_registry()
NETWORK = """\
format: dashpot-network/1
name: plain
branches:
  stiffness: {element: spring, stiffness: 200 N/mm}
  damping: {element: damper, damping: 300 N*s/m}
"""
STEP, SAMPLES = 5e-3, 120
DAMPING = 300.0
SIZES = {
    "N/m": 2e4,
    "N": 50.0,
    "N*s/m": 100.0,
    "kg": 0.5,
    "s": 1e-4,
    "N*s^2/m^2": 1e3,
    "1": 1.0,
    "m/N": 1e-6,
    "": 20.0,
}


class SmallView:
    """Two sweeps of a plain network, its forces by the elements' own code."""

    def __init__(self):
        time = STEP * np.arange(SAMPLES)
        sweep = np.sin(2.0 * np.pi * (2.0 * time + 4.0 * time**2))
        paths = {"small": 10e-3 + 1e-3 * sweep, "large": -2e-3 + 5e-3 * sweep}
        self.drives = {run: drive_from_samples(STEP, path) for run, path in paths.items()}
        self.network = parse_network(NETWORK, REGISTRY.elements)
        self.runs = tuple(paths)
        self.reach, self.stroke, self.dt, self.duration = (-7e-3, 11e-3), 10e-3, STEP, STEP * SAMPLES
        self.highest_frequency = 2.0 + 8.0 * STEP * SAMPLES
        self.speed = max(float(np.abs(drive.velocity).max()) for drive in self.drives.values())

    def displacement(self, run):
        return self.drives[run].displacement

    def velocity(self, run):
        return self.drives[run].velocity

    def step(self, run):
        return STEP

    def settings(self, run):
        return {"small": {"pressure": 2e5, "preload": 0.01}, "large": {"pressure": 3e5, "preload": 0.0}}[run]

    def channels(self, run):
        return {}

    def unit_of(self, setting):
        return ""

    def force(self, run):
        return simulate_eagerly(self.network, self.drives[run])

    def moved(self, run, change):
        return simulate_eagerly(self.network, drive_from_samples(STEP, self.displacement(run) + change))

    def respond(self, run, element, values):
        laws = [alone(REGISTRY.elements[element], entry) for entry in values]
        lanes = np.array([[slot.value.number for slot in law.slots()] for law in laws])
        return simulate_eagerly(laws[0], self.drives[run], lanes)


def alone(law, entry):
    """A network of one branch with plain numbers."""
    declared = law.declares
    values = {key: Value(number, "") for key, number in entry.items() if key in declared.parameters}
    values |= {key: Value(p.default, "") for key, p in declared.parameters.items() if key not in entry}
    curves = {
        key: Characteristic(declared.curves[key], "constant", (Value(number, ""),))
        for key, number in entry.items()
        if key in declared.curves
    }
    return NetworkSpec("alone", Group("", "parallel", (Branch("alone", law, values, curves),)))


def observed(network, run):
    """What the rig shows of a network (n,) N, its measurement chain included."""
    drive = VIEW.drives[run]
    objective = Objective(compile_network(network), [ScoredRun(run, "sweep", drive, np.zeros(SAMPLES), 0)])
    return objective.forces(objective.network.start)[0][0]


VIEW = SmallView()
SUSPECTS = [
    pytest.param(suspect, id=f"{word}-{suspect.form}")
    for word, cause in sorted(REGISTRY.causes.items())
    for suspect in cause().suspects(VIEW, VIEW.network)
]


def of_its_own(suspect, number):
    """The size of a law that has another shape at another size: that for which the column at a place is made."""
    end = 2.0 * np.pi * VIEW.highest_frequency
    if suspect.form == "delay":
        return suspect.grid[number]
    if suspect.form == "a spring in series with a damper":
        return compliant_damper.LAGS[number] / end / DAMPING
    if suspect.form == "a spring that stiffens in series with a damper":
        return [*compliant_damper.LAGS[1::2], *compliant_damper.LAGS[1::2]][number] / end / DAMPING
    return None


def usual_atoms(suspect):
    """A usual size of a suspect at the middle of its grid, or at all of its places where they belong together."""
    middle = len(suspect.grid) // 2
    # a whole specimen on a spring answers in proportion only to a small compliance
    usual = SIZES[suspect.unit] * (0.02 if suspect.form == "compliance" else 1.0)
    size = of_its_own(suspect, middle) or usual
    if not suspect.joint:
        return [(size, suspect.grid[middle])]
    # one knot of many: a monotone cubic through all of them is not the sum of those through one each; where none
    # may be zero, the others keep a twentieth
    least = 0.05 * size if suspect.sign else 0.0
    return [(size if number == middle else least, place) for number, place in enumerate(suspect.grid)]


@pytest.mark.parametrize("suspect", SUSPECTS)
def test_columns_are_finite_and_one_for_each_place(suspect):
    for run in VIEW.runs:
        columns = np.atleast_2d(suspect.columns(VIEW, run))
        assert columns.shape == (len(suspect.grid), SAMPLES)
        assert np.isfinite(columns).all()


@pytest.mark.parametrize("suspect", SUSPECTS)
def test_the_cure_adds_what_the_columns_show(suspect):
    """The network with the patch less the one without, what its plain numbers would take up aside: to a fiftieth."""
    atoms = usual_atoms(suspect)
    extended = parse_network(suspect.extend(NETWORK, atoms), REGISTRY.elements)
    places = [suspect.grid.index(place) for _, place in atoms]
    for run in VIEW.runs:
        numbers = np.array([[slot.value.number for slot in extended.slots()]])
        lanes = with_settings(extended, numbers, VIEW.settings(run))
        if extended.measurement:
            added = observed(extended, run) - observed(VIEW.network, run)
        else:
            added = simulate_eagerly(extended, VIEW.drives[run], lanes)[0] - VIEW.force(run)
        shown = np.array([strength for strength, _ in atoms]) @ np.atleast_2d(suspect.columns(VIEW, run))[places]
        # what a constant or the plain numbers of the network would take up does not count
        tangents = np.array([np.ones(SAMPLES), VIEW.displacement(run), VIEW.velocity(run)])
        # at the first sample no branch has a memory yet, and a filter of a fifth of the sample time swings in
        first = 5 if extended.measurement else 1
        left, shown, added, tangents = (added - shown)[first:], shown[first:], added[first:], tangents[:, first:]
        left = left - np.linalg.lstsq(tangents.T, left, rcond=None)[0] @ tangents
        assert np.std(left) <= 0.02 * np.std(shown) + 1e-3 * np.std(added) + 1e-12


def test_every_cause_word_of_the_contract_is_there():
    words = """relaxation friction amplitude_softening viscous_damping power_law_damping quadratic_damping
        asymmetric_damping preload_dependent_damping stiffness_curve end_stop lift_off clearance resonance
        load_dependent_friction velocity_dependent_friction softening bedding_in creep moving_mass delay gain offset
        drift clipping fixture_compliance hum valve compliant_damper gas_spring setting_dependence heating
        fading_damping loose_mass"""
    assert set(words.split()) <= set(REGISTRY.causes)


def test_whatever_is_confused_with_something_names_a_cause_that_exists():
    assert all(set(cause.confused_with) <= set(REGISTRY.causes) for cause in REGISTRY.causes.values())


FAULTS = [
    pytest.param(fault, id=f"{word}-{fault.form}")
    for word, cause in sorted(REGISTRY.causes.items())
    for fault in cause().channel_faults(VIEW)
]


@pytest.mark.parametrize("fault", FAULTS)
def test_a_corrected_run_is_the_run_without_its_fault(fault):
    shapes = np.atleast_2d(fault.shapes(VIEW, "large"))
    strengths = 0.1 * np.linspace(1.0, 2.0, len(shapes)) * (1.0 if fault.unit == "1" else 30.0)
    sound = VIEW.force("large")
    found = fault.correct(strengths.tolist()).apply(sound + strengths @ shapes, STEP)
    assert found == pytest.approx(sound, abs=1e-9 * np.abs(sound).max())


def test_every_fault_of_the_contract_is_there():
    # a sample time of 5 ms leaves lines of 50 and 60 Hz
    known = {"gain-gain", "offset-offset", "drift-steady drift", "hum-50 Hz", "hum-60 Hz"}
    assert {param.id for param in FAULTS} == known
