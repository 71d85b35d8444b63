"""What a cause writes into a network file is simulated by the command as it is scored: alone and in pairs."""

from itertools import combinations

import numpy as np
import pytest
from unit.causes.test_promises import NETWORK, REGISTRY, STEP, VIEW, usual_atoms

from dashpot.cli import main
from dashpot.data.dataset import read_dataset
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.term import Model, Term
from dashpot.diagnose.term import extended as extended_by
from dashpot.diagnose.term_forces import term_forces
from dashpot.fit.api import measure_errors, prepare
from dashpot.fit.coordinates import search_coordinates, with_point
from dashpot.fit.ranges import with_ranges
from dashpot.fit.scored import warm_up
from dashpot.model.reading import parse_network

NOISE = 20.0  # N
SUSPECTS = {
    f"{word}-{suspect.form}": suspect
    for word, cause in sorted(REGISTRY.causes.items())
    for suspect in cause().suspects(VIEW, VIEW.network)
}
ONE_OF_EACH = list({name.partition("-")[0]: name for name in SUSPECTS}.values())


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """Two measured runs at two pressures, as files; what is simulated does not have to fit them."""
    folder = tmp_path_factory.mktemp("data")
    rng = np.random.default_rng(4)
    lines = ["format: dashpot-dataset/1", "name: two", "defaults: {channels: {time: {column: t, unit: s},"]
    lines += ["  displacement: {column: x, unit: m}, force: {column: F, unit: N}}}", "runs:"]
    for run in VIEW.runs:
        path = VIEW.displacement(run)
        force = VIEW.force(run) + NOISE * rng.standard_normal(path.size)
        rows = np.column_stack([STEP * np.arange(path.size), path, force])
        np.savetxt(folder / f"{run}.csv", rows, "%.12g", ",", header="t,x,F", comments="")
        pressure = VIEW.settings(run)["pressure"]
        lines.append(f"  - {{name: {run}, file: {run}.csv, kind: random, settings: {{pressure: {pressure:g} Pa}}}}")
    (folder / "dataset.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder / "dataset.yaml"


def extended(text, name):
    """A network with a cause of a usual size."""
    return SUSPECTS[name].extend(text, usual_atoms(SUSPECTS[name]))


def assert_simulated_as_scored(text, data, folder):
    network = folder / "network.yaml"
    network.write_text(text, encoding="utf-8")
    dataset = read_dataset(data, {word: reader() for word, reader in REGISTRY.formats.items()})
    told = measure_errors(parse_network(text, REGISTRY.elements), prepare(dataset, 0)).per_run
    assert main(["simulate", str(network), "--data", str(data), "-o", str(folder / "out"), "--quiet"]) == 0
    for run in dataset.runs:
        force = np.genfromtxt(folder / "out" / f"{run.name}.csv", delimiter=",", skip_header=2)[:, 2]
        error = np.sqrt(np.mean((run.force - force)[warm_up(run) :] ** 2))
        assert error == pytest.approx(told[run.name], rel=1e-6)


@pytest.mark.parametrize("name", SUSPECTS)
def test_every_form_of_every_cause_is_simulated_as_it_is_scored(name, data, tmp_path):
    assert_simulated_as_scored(extended(NETWORK, name), data, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("names", list(combinations(ONE_OF_EACH, 2)), ids="+".join)
def test_every_pair_of_causes_is_simulated_as_it_is_scored(names, data, tmp_path):
    text = NETWORK
    for name in names:
        text = extended(text, name)
    assert_simulated_as_scored(text, data, tmp_path)


LATE = "measurement: {force: {gain: 1.1, delay: 3 ms, lag: 2 ms, offset: 9 N}}\n"
OF_THE_SPECIMEN = [name for name in SUSPECTS if REGISTRY.causes[name.partition("-")[0]].kind == "specimen"]


def modelled(text, terms, data):
    """A refitter on the data, and a network with some terms one after the other as its model."""
    base = declared = parse_network(text, REGISTRY.elements)
    owned = []
    for term in terms:
        declared, brought = extended_by(declared, term, REGISTRY.elements)
        owned.append(brought)
    dataset = read_dataset(data, {word: reader() for word, reader in REGISTRY.formats.items()})
    refitter = Refitter([*prepare(dataset, 0).scored.values()], REGISTRY.elements)
    ranged = with_ranges(declared, refitter.sizes)
    coordinates = search_coordinates(ranged)
    fitted = with_point(ranged, coordinates, coordinates.start)
    return refitter, Model(base, tuple(terms), declared, tuple(owned), fitted, coordinates, coordinates.start)


@pytest.mark.parametrize(
    ("name", "channel"), [*((name, "") for name in SUSPECTS), *((name, LATE) for name in OF_THE_SPECIMEN)]
)
def test_what_a_term_adds_is_what_the_network_without_it_lacks(name, channel, data):
    """Branches of their own are simulated alone, anything else by two networks: the same, within rounding."""
    term = Term(REGISTRY.causes[name.partition("-")[0]], SUSPECTS[name], tuple(usual_atoms(SUSPECTS[name])))
    refitter, model = modelled(NETWORK + channel, [term], data)
    whole, rest = refitter.forces(model.fitted), refitter.forces(model.base)
    (found,) = term_forces(refitter, model)
    assert set(found) == set(whole)
    for run, force in found.items():
        assert force == pytest.approx(whole[run] - rest[run], abs=1e-9 * np.abs(whole[run]).max())


def assert_what_each_adds_is_what_the_rest_lacks(refitter, model):
    whole = refitter.forces(model.fitted)
    for number, found in enumerate(term_forces(refitter, model)):
        rest = refitter.forces(refitter.without(model, [term for k, term in enumerate(model.terms) if k != number]))
        for run, force in found.items():
            assert force == pytest.approx(whole[run] - rest[run], abs=1e-9 * np.abs(whole[run]).max())


@pytest.mark.parametrize("name", ONE_OF_EACH)
@pytest.mark.parametrize("other", ["friction", "lift_off", "delay", "setting_dependence"])
def test_what_a_term_adds_beside_another_one(name, other, data):
    beside = next(one for one in ONE_OF_EACH if one.partition("-")[0] == other)
    terms = [
        Term(REGISTRY.causes[k.partition("-")[0]], SUSPECTS[k], tuple(usual_atoms(SUSPECTS[k]))) for k in (beside, name)
    ]
    refitter, model = modelled(NETWORK, terms, data)
    if not all(model.owned):
        pytest.skip("one is written in the place of the other")
    assert_what_each_adds_is_what_the_rest_lacks(refitter, model)


@pytest.mark.parametrize("numbers", [("friction.limit",), ("stiffness.stiffness", "friction.limit")])
def test_what_a_dependence_of_another_term_adds(numbers, data):
    """Where a branch goes, a dependence that moves its numbers and others as well is not there any more, either."""
    friction = next(one for one in SUSPECTS if one.startswith("friction-"))
    first = Term(REGISTRY.causes["friction"], SUSPECTS[friction], tuple(usual_atoms(SUSPECTS[friction])))
    network = extended_by(parse_network(NETWORK, REGISTRY.elements), first, REGISTRY.elements)[0]
    cause = REGISTRY.causes["setting_dependence"]
    suspect = next(
        one for one in cause().suspects(VIEW, network) if set(numbers) <= {str(place) for place in one.each_dependent}
    )
    at = [suspect.each_dependent.index(number) for number in numbers]
    second = Term(cause, suspect, tuple((0.3, suspect.grid[place]) for place in at))
    refitter, model = modelled(NETWORK, [first, second], data)
    assert_what_each_adds_is_what_the_rest_lacks(refitter, model)
