"""What the data can tell about numbers, against what is known in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from unit.fit.bench import DT, KELVIN_VOIGT, TIME, network, ready, run, runs

from dashpot import load_registry
from dashpot.compare.comparison import comparison_of
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network
from dashpot.fit.identifiability import Direction, identifiability, number_in_words
from dashpot.fit.noise_of_runs import white
from dashpot.fit.objective import Objective
from dashpot.report.fit import fit_page


def told(branches, scored, noise=20.0):
    _, objective, coordinates = ready(branches, scored)
    return identifiability(objective, coordinates, coordinates.start, white({run.name: noise for run in scored}, DT))


def test_the_deviations_are_those_of_weighted_linear_regression():
    known = told(KELVIN_VOIGT, runs(), noise=20.0)
    x, v, weight = (
        np.concatenate(parts)
        for parts in zip(
            *(
                (
                    each.drive.displacement[each.first :],
                    each.drive.velocity[each.first :],
                    np.full(each.samples, 1.0 / each.samples),
                )
                for each in runs()
            ),
            strict=True,
        )
    )
    columns = np.column_stack([1e5 * x, 1000.0 * v])  # changes of the force with the logarithms of the start values
    bread = np.linalg.inv(columns.T @ (weight[:, None] * columns))
    covariance = 400.0 * bread @ (columns.T @ (weight[:, None] ** 2 * columns)) @ bread
    assert list(known.deviations.values()) == pytest.approx(np.sqrt(np.diag(covariance)), rel=1e-4)
    values = np.linalg.eigvalsh(covariance)
    assert known.condition == pytest.approx(values[1] / values[0], rel=1e-4)
    assert known.firm == ["rubber.stiffness", "oil.damping"] and known.sentences == []


def test_a_relaxation_far_above_the_band_trades_stiffness_against_time():
    # for w T << 1 the branch is a dashpot of k T: only the product shows
    branches = "slow: {element: maxwell, stiffness: {start: 1e5}, relaxation_time: {start: 0.1 ms}}"
    scored = [run("low", 2e-3, 3.0, lambda x, v, a: 10.0 * v)]
    known = told(branches, scored, noise=0.1)
    [sentence] = known.sentences
    assert "stiffness of slow and relaxation time of slow trade off" in sentence or (
        "relaxation time of slow and stiffness of slow trade off" in sentence
    )
    assert "+10 %" in sentence and "-10 %" in sentence
    [direction] = known.loose
    assert direction.lost


def test_what_is_not_felt_is_named():
    far = KELVIN_VOIGT + (
        "    far: {element: spring, stiffness: {deflection: [90 mm, 91 mm, 92 mm], "
        "force: [0, 0, {start: 1, bounds: [0, 9]}]}}"
    )
    known = told(far, runs())
    assert known.idle == ("far.stiffness[2]",)
    assert known.sentences == ["stiffness[2] of far has no influence on these data"]


def test_what_cannot_be_moved_is_named_and_the_others_are_known(monkeypatch):
    whole = told(KELVIN_VOIGT, runs())

    plain = Objective.linearise

    def linearise(self, values, moves, reduce):
        def lost(number, rows):
            rows[1 + list(whole.deviations).index("oil.damping"), 7:] = np.nan
            return reduce(number, rows)

        return plain(self, values, moves, lost)

    monkeypatch.setattr(Objective, "linearise", linearise)
    known = told(KELVIN_VOIGT, runs())
    assert known.unsolved == ("oil.damping",) and known.idle == ()
    assert "damping of oil could not be moved: the network is not solved around its value" in known.sentences
    assert list(known.deviations) == ["rubber.stiffness"]
    assert 0.0 < known.deviations["rubber.stiffness"] <= whole.deviations["rubber.stiffness"]


def test_twice_the_noise_is_twice_the_deviation():
    one, two = (told(KELVIN_VOIGT, runs(), noise=noise) for noise in (10.0, 20.0))
    assert np.array(list(two.deviations.values())) == pytest.approx(2.0 * np.array(list(one.deviations.values())))


@pytest.mark.parametrize(
    "deviation, said", [(0.2, "weakly determined, known to +-20 %"), (1.5, "not determined"), (0.8, "a factor of 2.2")]
)
def test_a_direction_of_one_number_says_how_well_it_is_known(deviation, said):
    assert said in Direction(deviation, (("oil.damping", 1.0), ("rubber.stiffness", 0.01))).words


def test_paths_are_read_out_as_words():
    assert number_in_words("maxwell_1.relaxation_time") == "relaxation time of maxwell_1"
    assert number_in_words("contact.dry.limit") == "limit of contact.dry"


def dataset(law, noise=5.0) -> Dataset:
    """Three sines of other amplitude and frequency, with the force of a law and noise."""
    found = []
    for number, (amplitude, frequency) in enumerate(((2e-3, 2.0), (1e-3, 6.0), (5e-4, 11.0))):
        omega, rng = 2.0 * np.pi * frequency, np.random.default_rng(number)
        x, v = amplitude * np.sin(omega * TIME), amplitude * omega * np.cos(omega * TIME)
        force = law(x, v) + noise * rng.standard_normal(TIME.size)
        found.append(Run(f"r{number}", "harmonic", TIME, {"displacement": x, "force": force}, group=f"r{number}"))
    return Dataset("bench", tuple(found))


def fitted(branches: str, law=lambda x, v: 2e5 * x + 300.0 * v):
    registry = load_registry()
    return fit_network(network(branches), dataset(law), registry=registry)


def test_a_fit_tells_what_its_data_cannot_tell():
    # it relaxes in minutes, the records last 1.5 s: the branch is a spring, its time shows nowhere
    found = fitted("""
        oil: {element: damper, damping: {start: 200}}
        slow: {element: maxwell, stiffness: {start: 1e5}, relaxation_time: {start: 900 s, bounds: [100 s, 9 ks]}}
    """)
    assert found.known.undetermined == ["slow.relaxation_time"]
    assert found.summary().splitlines()[-1] == ("converged, but these data do not determine relaxation time of slow")
    told = found.as_dict()["identifiability"]
    assert told["undetermined"] == ["slow.relaxation_time"] and told["condition"] > 1e4
    assert told["weak"] == ["relaxation time of slow is not determined"] and told["may_go"] == []
    page = str(fit_page(found.as_dict(), comparison_of(found).as_dict(), comparison_of(found).evidence()))
    assert "relaxation time of slow is not determined" in page and "not identifiable from these data" in page


def test_two_branches_that_do_the_same_are_told_and_one_may_go():
    found = fitted("""
        rubber: {element: spring, stiffness: {start: 1e5}}
        a: {element: damper, damping: {start: 100}}
        b: {element: damper, damping: {start: 250}}
    """)
    told = found.as_dict()["identifiability"]
    assert set(told["undetermined"]) == {"a.damping", "b.damping"}
    assert told["may_go"] == ["a and b do the same to these data: one in their place would do"]
    assert "  a and b do the same to these data: one in their place would do" in found.summary().splitlines()


def test_a_branch_without_influence_may_go():
    found = fitted("""
        rubber: {element: spring, stiffness: {start: 1e5}}
        oil: {element: damper, damping: {start: 100}}
        stop: {element: end_stop, compression: 90 mm, rebound: -90 mm, stiffness: {start: 1e6}}
    """)
    assert found.as_dict()["identifiability"]["may_go"] == ["stop has no influence on these data and may go"]


def test_what_data_tell_is_told_as_nothing_to_say():
    found = fitted("rubber: {element: spring, stiffness: {start: 1e5}}\noil: {element: damper, damping: {start: 100}}")
    told = found.as_dict()["identifiability"]
    assert told["undetermined"] == told["weak"] == told["may_go"] == []
    assert found.summary().splitlines()[-1] == "converged"
