"""A refit may turn a cause into its opposite: then it is not that cause."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.contract.registry import load_registry
from dashpot.model.reading import parse_network

CAUSES, ELEMENTS = load_registry().causes, load_registry().elements
STEP, DRIVEN = 1e-3, 8.0
PLAIN = "format: dashpot-network/1\nname: plain\nbranches:\n  spring: {element: spring, stiffness: 100 N/mm}\n"
ANGLE = 2.0 * np.pi * DRIVEN * STEP * np.arange(10_000)
VIEW = SimpleNamespace(
    stroke=0.02,
    speed=0.5,
    reach=(0.0, 0.03),
    dt=STEP,
    duration=10.0,
    runs=("run",),
    highest_frequency=DRIVEN,
    displacement=lambda run: 0.01 * np.sin(ANGLE),
    force=lambda run: 1e3 * np.sin(ANGLE),
    step=lambda run: STEP,
    settings=lambda run: {},
    velocity=lambda run: 0.01 * 2.0 * np.pi * DRIVEN * np.cos(ANGLE),
)


def suspect(word, form, view=VIEW):
    return next(one for one in CAUSES[word]().suspects(view, None) if one.form == form)


@pytest.mark.parametrize(("breakaway", "admitted"), [(30.0, True), (14.0, True), (13.0, False), (4.0, False)])
def test_friction_that_depends_on_velocity_falls_with_it(breakaway, admitted):
    found = {"limit": 10.0, "breakaway": breakaway, "stiffness": 1e5}
    assert suspect("velocity_dependent_friction", "stribeck").admits(found) is admitted


@pytest.mark.parametrize(
    ("factors", "rising", "falling"),
    [
        ((0.2, 0.3, 0.6, 0.8, 1.0), True, False),
        ((0.05, 0.05, 0.1, 0.95, 1.0), True, False),
        ((1.0, 0.9, 0.7, 0.5, 0.3), False, True),
        ((0.02, 0.28, 0.74, 1.17, 1.0), True, False),
        ((1.0, 1.2, 0.8, 0.3, 0.1), False, True),
        ((1.0, 1.2, 1.4, 1.0, 0.8), False, False),
        ((0.2, 0.6, 1.0, 0.5, 0.9), False, False),
        ((0.96, 0.97, 0.98, 0.99, 1.0), False, False),
    ],
)
def test_friction_that_depends_on_the_load_goes_mostly_one_way(factors, rising, falling):
    found = {f"scale[{number}]": factor for number, factor in enumerate(factors)}
    for element in ("dahl", "coulomb"):
        assert suspect("load_dependent_friction", f"{element} growing with deflection").admits(found) is rising
        assert suspect("load_dependent_friction", f"{element} falling with deflection").admits(found) is falling


@pytest.mark.parametrize(("factors", "admitted"), [((0.993, 0.993, 0.992), False), ((0.8, 0.9, 1.1), True)])
def test_a_branch_whose_factor_hardly_changes_does_not_depend_on_preload(factors, admitted):
    """One of four factors is 1 by definition."""
    found = {"stiffness": 1e4, "relaxation_time": 0.03} | {f"scale[{k}]": factor for k, factor in enumerate(factors)}
    branches = "{s: {element: spring, stiffness: 1 N/mm}}"
    network = parse_network(f"{{format: dashpot-network/1, name: a spring, branches: {branches}}}", ELEMENTS)
    suspects = list(CAUSES["preload_dependent_damping"]().suspects(VIEW, network))
    assert {one.form for one in suspects} == {"4 knots", "relaxation with 4 knots"}
    assert all(one.admits(found) is admitted for one in suspects)


def test_a_factor_on_a_dashpot_that_is_there_may_change_little():
    branches = "{s: {element: spring, stiffness: 1 N/mm}, d: {element: damper, damping: 1 N*s/mm}}"
    network = parse_network(f"{{format: dashpot-network/1, name: a tire, branches: {branches}}}", ELEMENTS)
    on_it = next(iter(CAUSES["preload_dependent_damping"]().suspects(VIEW, network)))
    assert on_it.form == "4 knots"
    assert on_it.admits({"scale[0]": 0.98, "scale[1]": 0.99, "scale[2]": 1.02})


@pytest.mark.parametrize(("longest", "admitted"), [(1e-3, False), (3e-3, True)])
def test_softening_with_amplitude_reaches_over_more_than_one_contact(longest, admitted):
    found = {"stiffness": 1e4, "shortest": 0.1e-3, "longest": longest}
    assert suspect("amplitude_softening", "iwan").admits(found) is admitted


@pytest.mark.parametrize(("longest", "admitted"), [(0.2e-3, True), (1.0e-3, True), (5.0e-3, False)])
def test_sliders_spread_over_decades_are_no_dry_contact(longest, admitted):
    found = {"limit": 20.0, "stiffness": 20.0 / 0.1e-3, "limit_2": 100.0, "stiffness_2": 100.0 / longest}
    assert suspect("friction", "prandtl").admits(found) is admitted


def test_the_slow_rise_of_a_contact_that_has_slipped_is_still_that_contact():
    found = {"limit": 70.0, "stiffness": 6e5, "limit_2": 45.0, "stiffness_2": 7e3}
    assert suspect("friction", "prandtl").admits(found)


@pytest.mark.parametrize(("third", "admitted"), [(1.0, True), (20.0, False)])
def test_a_slider_of_hardly_any_force_is_no_contact_of_its_own(third, admitted):
    """However short the travel after which it slips."""
    found = {"limit": 70.0, "stiffness": 6e5, "limit_2": 45.0, "stiffness_2": 4e5, "limit_3": third}
    found["stiffness_3"] = third / 4e-6
    assert suspect("friction", "prandtl").admits(found) is admitted


@pytest.mark.parametrize(
    ("exponent", "admitted"),
    [
        (0.5, True),
        (0.9, False),
        (1.1, False),
        (1.5, True),
        (1.7, False),
        (2.3, False),
        (3.0, True),
    ],
)
def test_a_power_that_was_driven_towards_one_or_two_is_viscous_or_quadratic_damping(exponent, admitted):
    assert suspect("power_law_damping", "power of velocity").admits({"exponent": exponent}) is admitted


def test_other_causes_admit_what_is_found():
    assert suspect("friction", "dahl").admits({"limit": 10.0})


# a stroke of 20 mm at no more than 0.5 m/s ends at about 8 Hz: a resonance lies between 0.4 Hz and twice as much
@pytest.mark.parametrize(
    ("word", "form"),
    [
        ("fluid_mass", "a mass behind a spring"),
        ("mass", "a mass hung on a spring"),
    ],
)
@pytest.mark.parametrize(
    ("frequency", "ratio", "turbulence", "admitted"),
    [
        (5.0, 0.1, 0.0, True),
        (15.0, 0.9, 0.0, True),
        (17.0, 0.1, 0.0, False),
        (0.5, 0.1, 0.0, True),
        (0.3, 0.1, 0.0, False),
        (5.0, 1.1, 0.0, False),
        (5.0, 0.1, 4.0, False),
    ],
)
def test_a_resonance_swings_within_reach_of_what_was_driven(word, form, frequency, ratio, turbulence, admitted):
    turning, mass = 2.0 * math.pi * frequency, 3.0
    found = {
        word: mass,
        "stiffness": mass * turning**2,
        "damping": 2.0 * ratio * mass * turning,
        "quadratic_damping": 2.0 * turbulence * mass * turning,
    }
    assert suspect("resonance", f"{form}, in turbulence").admits(found) is admitted


@pytest.mark.parametrize(("stroke", "driven", "admitted"), [(0.02, 1.0, True), (0.5, 1.0, False), (0.02, 0.1, False)])
def test_a_track_of_fluid_swings_if_it_does_in_the_calmest_run_that_drives_it(stroke, driven, admitted):
    """Turbulence of four times the critical damping in the largest run; a slow run tells nothing of 5 Hz."""
    shares = {"run": (1.0, 1.0), "calm": (stroke, driven)}
    motions = {
        "runs": tuple(shares),
        "displacement": lambda run: shares[run][0] * 0.01 * np.sin(shares[run][1] * ANGLE),
        "velocity": lambda run: math.prod(shares[run]) * VIEW.velocity("run"),
    }
    turning, mass = 2.0 * math.pi * 5.0, 3.0
    found = {"fluid_mass": mass, "stiffness": mass * turning**2, "damping": 0.2 * mass * turning}
    found["quadratic_damping"] = 8.0 * mass * turning / 0.25
    view = SimpleNamespace(**{**vars(VIEW), **motions})
    assert suspect("resonance", "a mass behind a spring, in turbulence", view).admits(found) is admitted


@pytest.mark.parametrize(("frequency", "admitted"), [(15.0, False), (17.0, True), (300.0, True)])
def test_a_mass_on_its_mounting_resonates_beyond_that(frequency, admitted):
    found = {"mass": 3.0, "stiffness": 3.0 * (2.0 * math.pi * frequency) ** 2, "damping": 1.0}
    assert suspect("moving_mass", "a mass on its mounting").admits(found) is admitted


@pytest.mark.parametrize("behind", ["loose_friction", "loose_kelvin_voigt"])
@pytest.mark.parametrize(("gaps", "admitted"), [((0.2e-3,), False), ((0.5e-3,), True), ((0.5e-3, 0.2e-3), False)])
def test_play_that_a_refit_leaves_at_its_least_is_no_clearance(gaps, admitted, behind):
    """The stroke is 20 mm, a hundredth of it the least play that is looked for."""
    found = {f"gap_{number}" if number > 1 else "gap": gap for number, gap in enumerate(gaps, 1)}
    to_and_fro = SimpleNamespace(**{**vars(VIEW), "reach": (-0.01, 0.03)})
    assert suspect("clearance", behind, to_and_fro).admits(found) is admitted


@pytest.mark.parametrize("form", ["clearance", "loose_kelvin_voigt"])
@pytest.mark.parametrize("zero", [0.0, 4e-3, -2e-3])
def test_play_is_looked_for_where_the_force_is_zero(form, zero):
    """And written with that place where it is not the zero of the deflection; where no run passes it, there is none."""
    motion = {"displacement": lambda run: VIEW.displacement(run) + zero, "reach": (zero - 0.01, zero + 0.01)}
    moved = SimpleNamespace(**{**vars(VIEW), **motion})
    found = suspect("clearance", form, moved)
    written = parse_network(found.extend(PLAIN, [(1e4, found.grid[0])]), ELEMENTS)
    places = [slot.value.number for slot in written.slots() if slot.path == "clearance.place"]
    assert places == ([pytest.approx(zero, abs=0.05e-3)] if zero else [])
    pressed = SimpleNamespace(**{**vars(VIEW), "force": lambda run: VIEW.force(run) + 2e3})
    with pytest.raises(StopIteration):
        suspect("clearance", form, pressed)


# half over the angular frequency at the end of the band, about 8 Hz, is 10 ms
@pytest.mark.parametrize(("fastest", "admitted"), [(8e-3, False), (12e-3, True)])
def test_what_relaxes_faster_than_the_runs_show_is_a_dashpot(fastest, admitted):
    found = {"stiffness": 1e4, "relaxation_time": 0.1, "stiffness_2": 1e5, "relaxation_time_2": fastest}
    assert suspect("relaxation", "maxwell").admits(found) is admitted


@pytest.mark.parametrize(("order", "admitted"), [(0.03, True), (0.5, True), (0.6, False)])
def test_a_springpot_that_is_more_dashpot_than_spring_is_no_relaxation(order, admitted):
    found = {"stiffness": 1e4, "order": order, "reference": 1.0, "lowest": 0.05, "decades": 3.0, "dwell": 30.0}
    assert suspect("relaxation", "springpot").admits(found) is admitted


@pytest.mark.parametrize(
    ("form", "key", "end", "limit"),
    [
        ("a knee in both directions", "digression", 1, 1.0 / 0.0075),
        ("a knee behind a spring", "knee", 0, 0.0075),
        ("a sharp blow-off behind a spring", "knee", 0, 0.0075),
    ],
)
def test_a_valve_opens_no_earlier_than_dry_friction_slides(form, key, end, limit):
    """1.5 % of the largest speed of 0.5 m/s are 7.5 mm/s: a refit does not take a knee below it."""
    valve = suspect("valve", form)
    text = valve.extend(PLAIN, [(100.0, valve.grid[0])])
    slots = {slot.path: slot.value for slot in parse_network(text, ELEMENTS).slots()}
    for side in ("compression", "rebound"):
        assert slots[f"valve.{side}_{key}"].bounds[end] == pytest.approx(limit, rel=1e-5)


@pytest.mark.parametrize(("damping", "admitted"), [(5.0, False), (100.0, True)])
def test_a_spring_that_warms_up_beside_hardly_any_dashpot_is_no_heating(damping, admitted):
    """At 8 Hz 0.25 and 5 N/mm beside 100 N/mm: 0.25 and 5 %."""
    found = {"damping": damping, "stiffness": 1e5}
    assert suspect("heating", "a dashpot and a spring that warm up").admits(found) is admitted
    assert suspect("heating", "a dashpot that warms up").admits({"damping": 1.0})
