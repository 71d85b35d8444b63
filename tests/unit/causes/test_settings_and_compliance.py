"""Causes that change a branch that is there: a damper on a spring, a number that depends on a setting."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline
from unit.causes.test_promises import NETWORK, REGISTRY, STEP, VIEW, SmallView

from dashpot.data.excitation import Excitation
from dashpot.diagnose.term import Term, first_model
from dashpot.diagnose.view import view_of
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.eager import simulate_eagerly
from dashpot.kernel.network import compile_network
from dashpot.model.patch import add_branch, replace_branch
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError

DAMPERS = {
    "damper": "damping: 300 N*s/m",
    "quadratic_damper": "damping: 2000 N*s^2/m^2",
    "power_law_damper": "force: 60 N, exponent: 0.6",
    "asymmetric_damper": "compression: 200 N*s/m, rebound: 500 N*s/m, rebound_digression: 8 s/m",
}


def damped(word):
    return NETWORK.replace("{element: damper, damping: 300 N*s/m}", f"{{element: {word}, {DAMPERS[word]}}}")


def compliance(text, view=VIEW):
    return list(REGISTRY.causes["compliant_damper"]().suspects(view, parse_network(text, REGISTRY.elements)))


@pytest.mark.parametrize("word", DAMPERS)
def test_a_damper_of_the_network_is_put_on_a_spring(word):
    """The column is the derivative of the force after the compliance; the cure is the branch behind that spring."""
    text = damped(word)
    suspect = compliance(text)[0]
    small = 2e-7 if word == "damper" else 1e-6
    network = parse_network(suspect.extend(text, [(small, 0.0)]), REGISTRY.elements)
    assert [branch.name for branch in network.leaves()] == ["stiffness", "damping"]
    drive = VIEW.drives["large"]
    change = simulate_eagerly(network, drive) - simulate_eagerly(parse_network(text, REGISTRY.elements), drive)
    shown = small * suspect.columns(VIEW, "large")[0]
    # the curve of a small power is so steep at rest that no compliance is a small one there
    assert np.corrcoef(change[5:], shown[5:])[0, 1] > (0.9 if word == "power_law_damper" else 0.97)
    assert np.dot(change[5:], shown[5:]) / np.dot(shown[5:], shown[5:]) == pytest.approx(1.0, abs=0.25)


@pytest.mark.parametrize(
    "entry",
    [
        "{element: damper, damping: {velocity: [-1 m/s, 1 m/s], force: [-1 kN, 1 kN]}}",
        "{element: damper, damping: 300 N*s/m, scale: {deflection: [0 mm, 1 mm], factor: [1, 2]}}",
        "{element: coulomb, limit: 30 N, creep_velocity: 1 mm/s}",
    ],
)
def test_what_is_no_simple_dashpot_is_left_alone(entry):
    assert compliance(NETWORK.replace("{element: damper, damping: 300 N*s/m}", entry)) == []


def test_the_spring_of_a_linear_damper_may_stiffen():
    """Started where a linear spring would be pressed by the fastest motion, at a quarter of the lag of the band."""
    _, suspect = compliance(NETWORK)
    lag = 0.25 / (2.0 * np.pi * VIEW.highest_frequency)
    network = parse_network(suspect.extend(NETWORK, [(lag / 300.0, 1.0)]), REGISTRY.elements)
    found = {slot.path: slot.value.number for slot in network.slots()}
    assert network.leaves()[1].element.word == "stiffening_maxwell"
    assert found["damping.stiffness"] == pytest.approx(300.0 / lag, rel=1e-5)
    assert found["damping.relaxation_time"] == pytest.approx(lag, rel=1e-5)
    assert found["damping.travel"] == pytest.approx(lag * VIEW.speed, rel=1e-5)


SPRUNG = "{element: maxwell, stiffness: 200 N/mm, relaxation_time: 3 ms}"


def test_the_spring_of_a_dashpot_that_has_one_may_stiffen():
    """The column is the derivative of the force after one by the travel at which the spring is blocked."""
    text = NETWORK.replace("{element: damper, damping: 300 N*s/m}", SPRUNG)
    [suspect] = compliance(text)
    network = parse_network(suspect.extend(text, [(2.0, 0.0)]), REGISTRY.elements)
    assert {slot.path: slot.value.number for slot in network.slots()}["damping.travel"] == pytest.approx(0.5)
    drive = VIEW.drives["large"]
    plain, far = (parse_network(suspect.extend(text, [(inverse, 0.0)]), REGISTRY.elements) for inverse in (1.0, 3.0))
    change = simulate_eagerly(far, drive) - simulate_eagerly(plain, drive)
    shown = 2.0 * suspect.columns(VIEW, "large")[0]
    assert change == pytest.approx(shown, abs=0.03 * np.abs(shown).max())


def test_what_relaxes_within_the_band_is_no_dashpot_on_a_spring():
    slow = 0.6 / (2.0 * np.pi * VIEW.highest_frequency)
    entry = SPRUNG.replace("3 ms", f"{slow} s")
    assert compliance(NETWORK.replace("{element: damper, damping: 300 N*s/m}", entry)) == []


@pytest.mark.parametrize(("there", "other"), [("delay", "low-pass of first order"), ("lag", "delay")])
def test_a_delay_and_a_low_pass_take_the_place_of_each_other(there, other):
    text = f"{NETWORK}measurement: {{force: {{gain: 1.01, {there}: {{start: 2 ms}}}}}}\n"
    [suspect] = REGISTRY.causes["delay"]().suspects(VIEW, parse_network(text, REGISTRY.elements))
    assert suspect.form == other
    network = parse_network(suspect.extend(text, [(3e-3, suspect.grid[0])]), REGISTRY.elements)
    assert set(network.measurement) == {"force.gain", "force.delay" if there == "lag" else "force.lag"}


def test_a_delay_shifts_the_force_by_its_own_size():
    """Against the force a little earlier: held before the run, after it along its tangent, within its range."""
    form = next(one for one in REGISTRY.causes["delay"]().suspects(VIEW, VIEW.network) if one.form == "delay")
    force, time = VIEW.force("large"), STEP * np.arange(120)
    for delay, column in zip(form.grid, form.columns(VIEW, "large"), strict=True):
        path, then = make_interp_spline(time, force, k=5), time - delay
        tangent = path(time[-1]) + path(time[-1], 1) * (then - time[-1])
        tangent = np.clip(tangent, force.min(), force.max())
        shifted = np.where(then > time[-1], tangent, path(np.clip(then, 0.0, time[-1])))
        assert delay * column == pytest.approx(shifted - force, abs=2e-2 * np.ptp(force))


def test_a_branch_that_takes_the_place_of_another_counts_by_what_it_adds():
    """A damper has one number, on a spring it has two: one more, as of any term with a strength."""
    base = parse_network(
        NETWORK.replace("300 N*s/m", "{start: 300 N*s/m, bounds: [3 N*s/m, 3 kN*s/m]}"), REGISTRY.elements
    )
    on_spring = replace_branch(
        base.text,
        "damping",
        "{element: maxwell, stiffness: {start: 1 kN/mm, bounds: [1 N/mm, 9 kN/mm]}, "
        "relaxation_time: {start: 1 ms, bounds: [0.1 ms, 9 ms]}}",
    )
    added = add_branch(base.text, "more:\n  element: damper\n  damping: {start: 1 N*s/m, bounds: [0.1 N*s/m, 9 N*s/m]}")
    for text, owned in ((on_spring, ("damping.stiffness", "damping.relaxation_time")), (added, ("more.damping",))):
        term = Term(REGISTRY.causes["setting_dependence"], dependence()[0], ())
        first = first_model(base, parse_network(text, REGISTRY.elements))
        model = replace(first, base=base, terms=(term,), owned=(owned,))
        assert model.count(0) == 1


def dependence(text=NETWORK, view=VIEW):
    return list(REGISTRY.causes["setting_dependence"]().suspects(view, parse_network(text, REGISTRY.elements)))


def test_numbers_and_a_force_over_each_setting_of_the_specimen():
    numbers, force = dependence()
    assert (numbers.form, force.form) == ("a number over pressure", "a force over pressure")
    assert len(numbers.grid) == 2


def test_the_dependence_is_written_with_the_slope_that_was_seen():
    numbers, force = dependence()
    spec = parse_network(force.extend(numbers.extend(NETWORK, [(0.5, 0.0)]), [(40.0, 0.0)]), REGISTRY.elements)
    found = {slot.path: slot.value for slot in spec.slots()}
    assert found["stiffness.stiffness.slope"].number == pytest.approx(0.5 * 200e3 / 1e5)
    assert found["setting_force.force.slope"].number == pytest.approx(40.0 / 1e5)
    assert found["stiffness.stiffness"].over.at == (250e3,)
    assert found["stiffness.stiffness.slope"].searched
    assert not found["setting_force.force"].searched


def test_columns_sort_by_the_setting():
    numbers, force = dependence()
    for run, side in (("small", -0.5), ("large", 0.5)):
        assert force.columns(VIEW, run) == pytest.approx(np.full((1, 120), side))
        assert numbers.columns(VIEW, run)[0] == pytest.approx(side * 200e3 * VIEW.displacement(run), rel=1e-6)


def test_the_mean_of_a_channel_is_a_setting_too():
    class Warm(SmallView):
        def settings(self, run):
            return {"mean of temperature": {"small": 293.0, "large": 313.0}[run], "amplitude": 1e-3}

    numbers, _ = dependence(view=Warm())
    spec = parse_network(numbers.extend(NETWORK, [(-0.2, 1.0)]), REGISTRY.elements)
    over = {slot.path: slot.value for slot in spec.slots()}["damping.damping"].over
    assert (over.word, over.channel, over.at) == ("temperature", True, (303.0,))


def test_a_dependence_is_written_in_the_unit_in_which_the_runs_tell_the_setting():
    class InBar(Pumped):
        def unit_of(self, setting):
            return {"pressure": "bar"}[setting]

    numbers, _, stiffness, _, force = dependence(view=InBar())
    text = force.extend(numbers.extend(NETWORK, [(0.5, 0.0)]), [(40.0, 0.0)])
    assert text.count("at: 2.333333333 bar") == 2
    slopes = {slot.path: slot.value for slot in parse_network(text, REGISTRY.elements).slots()}
    assert slopes["stiffness.stiffness.slope"].unit == "N/m/Pa"
    assert slopes["stiffness.stiffness.slope"].number == pytest.approx(0.5 * 200e3 / 3e5)
    assert slopes["setting_force.force.slope"].unit == "N/Pa"
    assert "at: [1 bar, 2 bar, 4 bar]" in stiffness.extend(NETWORK, [(-0.3, 1e5), (0.01, 2e5), (0.5, 4e5)])


class Pumped(SmallView):
    """Three pressures, the middle one of them not in the middle."""

    pressures: ClassVar = {"small": 1e5, "large": 2e5, "again": 4e5}

    def __init__(self):
        super().__init__()
        self.runs = tuple(self.pressures)

    def displacement(self, run):
        return super().displacement(self._motion(run))

    def velocity(self, run):
        return super().velocity(self._motion(run))

    def respond(self, run, element, values):
        return super().respond(self._motion(run), element, values)

    def settings(self, run):
        return {"pressure": self.pressures[run]}

    def _motion(self, run):
        return "small" if run == "again" else run


def test_three_values_of_a_setting_make_a_table():
    """At each of its values the column is that of the number alone; the file has a factor there."""
    _, _, stiffness, damping, _ = dependence(view=Pumped())
    assert (damping.form, damping.grid) == ("damping.damping in a table over pressure", (1e5, 2e5, 4e5))
    for place, run in enumerate(Pumped.pressures):
        shown = damping.columns(Pumped(), run)
        assert shown[place] == pytest.approx(300.0 * Pumped().velocity(run), rel=1e-6)
        assert not np.delete(shown, place, axis=0).any()
    spec = parse_network(stiffness.extend(NETWORK, [(-0.3, 1e5), (0.01, 2e5), (0.5, 4e5)]), REGISTRY.elements)
    over = {slot.path: slot.value for slot in spec.slots()}["stiffness.stiffness"].over
    assert (over.at, [value.number for value in over.numbers]) == ((1e5, 2e5, 4e5), [0.7, 1.0, 1.5])
    assert [value.searched for value in over.numbers] == [True, False, True]


@pytest.mark.parametrize("change", [0.5, -0.8, -3.0])
def test_an_exponential_begins_as_the_line_and_ends_as_far_apart(change):
    """Its columns are those of the line. Two values of a setting tell one from the other by nothing."""
    straight, exponential, *_ = dependence(view=Pumped())
    assert (exponential.form, exponential.of) == ("a number over pressure, exponentially", straight.of)
    for run in Pumped.pressures:
        assert exponential.columns(Pumped(), run) == pytest.approx(straight.columns(Pumped(), run))
    spec = parse_network(exponential.extend(NETWORK, [(change, 1.0)]), REGISTRY.elements)
    found = {slot.path: slot.value for slot in spec.slots()}
    rate, span = found["damping.damping.rate"], 4e5 - 1e5
    assert 2.0 * np.sinh(0.5 * rate.number * span) == pytest.approx(change)
    assert rate.searched and found["damping.damping"].over.at == pytest.approx((7e5 / 3.0,))
    assert not [form for form in dependence() if "exponentially" in form.form]


def test_many_values_of_a_setting_share_a_few_places():
    class Drifting(Pumped):
        pressures: ClassVar = {f"{k}": 1e5 + 1e4 * k for k in range(11)}

        def _motion(self, run):
            return "small"

    _, _, stiffness, *_ = dependence(view=Drifting())
    assert stiffness.grid == pytest.approx([1.0e5, 1.2e5, 1.5e5, 1.8e5, 2.0e5])  # at each of them there is a run
    assert sum(stiffness.columns(Drifting(), "3")) == pytest.approx(200e3 * VIEW.displacement("small"), rel=1e-6)


def test_settings_that_do_not_change_or_are_not_known_give_nothing():
    class Same(SmallView):
        def settings(self, run):
            return {"pressure": 2e5, "amplitude": {"small": 1e-3, "large": 2e-3}[run]}

    class Silent(SmallView):
        def settings(self, run):
            return {}

    assert dependence(view=Same()) == []
    assert dependence(view=Silent()) == []


def test_a_number_that_depends_already_may_depend_on_something_else_in_its_place():
    """Not beside it: that cannot be written."""
    over = "{fixed: 300 N*s/m, over: {setting: pressure, at: 0, slope: 1}}"
    text = NETWORK.replace("damping: 300 N*s/m", f"damping: {over}")
    numbers, _ = dependence(text)
    assert len(numbers.grid) == 2
    with pytest.raises(InputError, match="without 'over'"):
        numbers.extend(text, [(0.5, 1.0)])
    assert "over" in numbers.extend(NETWORK, [(0.5, 1.0)])


def test_what_a_number_does_is_the_derivative_of_the_force_where_the_run_has_it():
    """300 N*s/m and 1 N*s/m for each Pa: a dashpot at the pressure of each run, by the size that the file tells."""
    over = "{fixed: 300 N*s/m, over: {setting: pressure, at: 0, slope: 1}}"
    numbers, _ = dependence(NETWORK.replace("damping: 300 N*s/m", f"damping: {over}"))
    plain, _ = dependence()
    for run in VIEW.runs:
        assert numbers.columns(VIEW, run)[1] == pytest.approx(plain.columns(VIEW, run)[1], rel=1e-6)


WARMING = 293.15 + 25.0 * np.linspace(0.0, 1.0, 120) ** 2


class Warming(SmallView):
    """The large sweep warms the specimen up, the small one cools it down; the force is that of a real view."""

    def __init__(self, text):
        super().__init__()
        self.signals = {"small": {"temperature": WARMING[::-1]}, "large": {"temperature": WARMING}}
        runs = {
            name: ScoredRun(name, "sweep", drive, np.zeros(120), 0, whole=self.excitation(name))
            for name, drive in self.drives.items()
        }
        self.real = view_of(parse_network(text, REGISTRY.elements), list(runs.values()), REGISTRY.elements)

    def excitation(self, run):
        return replace(Excitation.of_drive(self.drives[run]), channels=self.signals[run])

    def settings(self, run):
        return self.real.settings(run)

    def channels(self, run):
        return self.real.channels(run)

    def respond(self, run, element, values):
        return self.real.respond(run, element, values)


RELAXING = NETWORK + "  slow: {element: maxwell, stiffness: 90 N/mm, relaxation_time: 20 ms}\n"
FOLLOWING = NETWORK + (
    "  slow: {element: maxwell, relaxation_time: 20 ms, stiffness: {fixed: 90 N/mm, over: "
    "{channel: temperature, at: 20 degC, rate: -3 %/K}}}\n"
)


@pytest.mark.parametrize("text", [RELAXING, FOLLOWING], ids=["constant", "moving already"])
def test_over_a_channel_the_cure_adds_what_the_columns_show_with_all_memory(text):
    """Central differences of the written networks, each simulated along the channel."""
    view = Warming(text)
    straight, exponential, *_ = forms = dependence(text, view)
    tables = [form for form in forms if "in a table" in form.form]
    assert straight.form == "a number over the channel temperature"
    assert len(straight.grid) == len(tables) == 4
    assert [form.form for form in forms[-1:]] == ["a force over the channel temperature"]
    small = 1e-4

    def along(extend, atoms, run):
        network = compile_network(parse_network(extend(text, atoms), REGISTRY.elements))
        return network.simulate(network.prepare(view.excitation(run)))

    for run in view.runs:
        for number, place in enumerate(straight.grid):
            if "over" in text and straight.of[number].startswith("slow.stiffness"):
                continue  # it depends already: nothing is written beside that
            for form in (straight, exponential):
                more, less = (along(form.extend, [(side * small, place)], run) for side in (1.0, -1.0))
                shown = form.columns(view, run)[number]
                assert (more - less) / (2.0 * small) == pytest.approx(shown, abs=2e-3 * np.max(np.abs(shown)))
        time = next(form for form in tables if form.form.startswith("slow.relaxation_time"))
        columns = time.columns(view, run)
        for number in range(len(time.grid)):
            ends = [[(side * small * (k == number), at) for k, at in enumerate(time.grid)] for side in (1.0, -1.0)]
            more, less = (along(_all_factors, each, run) for each in ends)
            # a factor bends at its place, somewhere within a step of the memory
            near = 5e-3 * np.max(np.abs(columns))
            assert (more - less) / (2.0 * small) == pytest.approx(columns[number], abs=near)


def _all_factors(text, atoms):
    """A table with all factors as they are asked for: the one that is written has five digits of them."""
    at = ", ".join(f"{place!r}" for _, place in atoms)
    factors = ", ".join(f"{1.0 + strength!r}" for strength, _ in atoms)
    over = f"{{fixed: 20 ms, over: {{channel: temperature, at: [{at}], factor: [{factors}]}}}}"
    return text.replace("relaxation_time: 20 ms", f"relaxation_time: {over}")
