"""Numbers that follow a measured channel sample by sample, against formulas and integrations of their own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from verification.systems import drive_of, written
from verification.truth.motion import smooth_motion

from dashpot import load_registry
from dashpot.data.excitation import Excitation, mean_of
from dashpot.kernel import system as kernel_system
from dashpot.kernel.api import solve
from dashpot.kernel.energy import energy_balance
from dashpot.kernel.export import exported
from dashpot.kernel.jit import jit_network
from dashpot.kernel.network import compile_network
from dashpot.kernel.stiffness import dynamic_stiffness
from dashpot.model.reading import parse_network

ELEMENTS = load_registry().elements
DT = 1e-3
TIME = DT * np.arange(2001)
MOTION = smooth_motion(np.random.default_rng(3), 0.0, 4e-3, lowest=1.0, highest=8.0)
KELVIN = 293.15  # 20 degC


def warming(at):
    """A temperature in K that rises by 30 K and swings."""
    return KELVIN + 15.0 * at + 3.0 * np.sin(5.0 * at)


def current(at):
    """A current in A that swings through the places of a table and beyond."""
    return 1.0 + 1.4 * np.sin(4.0 * at)


def run(settings=None, **channels):
    return Excitation({"": drive_of(MOTION, TIME)}, {}, settings or {}, DT, TIME.size, "run", channels=channels)


def network(branches, nodes="", more=""):
    return parse_network(written(nodes, branches) + more, ELEMENTS)


def force(branches, excitation, nodes="", tolerance=1e-3, more=""):
    found = solve(compile_network(network(branches, nodes, more)), excitation, tolerance=tolerance)
    return next(iter(found.force.values()))


X, V = MOTION.place(TIME), MOTION.speed(TIME)


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def test_a_spring_and_a_damper_have_the_numbers_of_every_sample():
    branches = """\
    rubber: {element: spring, stiffness: {fixed: 200 N/mm, over: {channel: warm, at: 20 degC, rate: -1 %/K}}}
    oil: {element: damper, damping: {fixed: 300 N*s/m, over: {channel: warm, at: 20 degC, slope: -4 N*s/m/K}}}
    """
    warm = warming(TIME)
    truth = 2e5 * np.exp(-0.01 * (warm - KELVIN)) * X + (300.0 - 4.0 * (warm - KELVIN)) * V
    assert force(branches, run(warm=warm)) == pytest.approx(truth, abs=1e-9 * np.ptp(truth))


@pytest.mark.parametrize(
    ("way", "factor"),
    [
        ("wlf: [8.86, 101.6 K]", lambda s: 10.0 ** (-8.86 * (s - 310.0) / (101.6 + s - 310.0))),
        ("arrhenius: 6000 K", lambda s: np.exp(6000.0 * (1.0 / s - 1.0 / 310.0))),
        ("rate: 2 %/K", lambda s: np.exp(0.02 * (s - 310.0))),
    ],
)
def test_every_law_over_a_temperature_is_followed(way, factor):
    branches = f"oil: {{element: damper, damping: {{fixed: 300 N*s/m, over: {{channel: warm, at: 310 K, {way}}}}}}}"
    truth = 300.0 * factor(warming(TIME)) * V
    assert force(branches, run(warm=warming(TIME))) == pytest.approx(truth, abs=1e-9 * np.ptp(truth))


def test_factors_are_followed_through_their_places_and_stay_beyond():
    branches = """\
    oil: {element: damper, damping: {fixed: 100 N*s/m, over: {channel: amps, at: [0 A, 1 A, 2 A], factor: [1, 2, 2.5]}}}
    """
    amps = current(TIME)
    assert amps.min() < -0.1 and amps.max() > 2.1
    truth = 100.0 * np.interp(amps, [0.0, 1.0, 2.0], [1.0, 2.0, 2.5]) * V
    assert force(branches, run(amps=amps)) == pytest.approx(truth, abs=1e-9 * np.ptp(truth))


def test_a_number_stays_inside_its_sensible_range_at_every_sample():
    branches = "oil: {element: damper, damping: {fixed: 50 N*s/m, over: {channel: amps, at: 1 A, slope: -60 N*s/m/A}}}"
    truth = np.maximum(50.0 - 60.0 * (current(TIME) - 1.0), 0.0) * V
    assert force(branches, run(amps=current(TIME))) == pytest.approx(truth, abs=0.011 * np.max(np.abs(V)))


def test_the_terms_of_a_polynomial_are_followed():
    branches = """\
    rubber:
      element: spring
      stiffness: {polynomial: [{fixed: 100 N/mm, over: {channel: warm, at: 20 degC, rate: -1 %/K}}, 0, 4e9 N/m^3]}
    """
    truth = 1e5 * np.exp(-0.01 * (warming(TIME) - KELVIN)) * X + 4e9 * X**3
    assert force(branches, run(warm=warming(TIME))) == pytest.approx(truth, abs=1e-9 * np.ptp(truth))


def test_friction_slides_at_the_limit_of_the_sample():
    """A slider stiff for the motion slides but for moments at its reversals."""
    branches = """\
    pad: {element: prandtl, stiffness: 1e9 N/m, limit: {fixed: 40 N, over: {channel: warm, at: 20 degC, rate: 1 %/K}}}
    """
    found = force(branches, run(warm=warming(TIME)))
    sliding = np.abs(V) > 0.1 * np.max(np.abs(V))
    limit = 40.0 * np.exp(0.01 * (warming(TIME) - KELVIN))
    assert found[sliding][20:] == pytest.approx((np.sign(V) * limit)[sliding][20:], rel=1e-3)


def maxwell(at, x, stiffness, damping):
    """The force of a spring in series with a damper whose damping is a function of time, from rest."""
    path = CubicSpline(at, x)

    def rate(t, f):
        return stiffness * path(t, 1) - f * stiffness / damping(t)

    return solve_ivp(rate, at[[0, -1]], [0.0], method="LSODA", t_eval=at, rtol=1e-10, atol=1e-9, max_step=0.01).y[0]


TIMES = "relaxation_time: {fixed: 20 ms, over: {channel: amps, at: 1 A, rate: 80 %/A}}"


def test_a_memory_goes_along_with_the_channel_and_gets_better_with_the_square_of_the_step():
    """The closed form of the kernel has a constant time in a step; the error falls by 4 where the step is halved."""
    errors = []
    fine = 5e-4 * np.arange(4001)
    truth = maxwell(fine, MOTION.place(fine) - MOTION.place(0.0), 1e5, lambda t: 2e3 * np.exp(0.8 * (current(t) - 1.0)))
    for dt in (8e-3, 4e-3, 2e-3):
        at = dt * np.arange(round(2.0 / dt) + 1)
        driven = Excitation({"": drive_of(MOTION, at)}, {}, {}, dt, at.size, channels={"amps": current(at)})
        found = force(f"slow: {{element: maxwell, stiffness: 100 N/mm, {TIMES}}}", driven)
        errors.append(rms(found[1:] - truth[:: round(dt / 5e-4)][1:]))
    assert errors[-1] < 2e-4 * rms(truth)
    assert errors[0] > 3.5 * errors[1] > 3.5**2 * errors[2]


SERIES = """\
strut:
  series:
    coil: {element: spring, stiffness: 100 N/mm}
    oil: {element: damper, damping: {fixed: 2000 N*s/m, over: {channel: amps, at: 1 A, rate: 80 %/A}}}
"""


def test_a_free_node_moves_with_the_damping_of_the_moment():
    """A spring in series with a damper, by a node of no mass between them."""
    truth = maxwell(TIME, X, 1e5, lambda t: 2e3 * np.exp(0.8 * (current(t) - 1.0)))
    found = force(SERIES, run(amps=current(TIME)), tolerance=1e-5)
    assert rms(found - truth) < 2e-4 * rms(truth)


def test_a_mass_on_a_spring_whose_stiffness_swings_is_hills_equation():
    """Steps of high order, too, go along with the channel."""
    nodes = "{top: driven, middle: {mass: 2 kg}, base: ground}"
    branches = """\
    upper: {element: spring, stiffness: 20 N/mm, between: [base, middle]}
    oil: {element: damper, damping: 40 N*s/m, between: [base, middle]}
    lower:
      element: spring
      stiffness: {fixed: 10 N/mm, over: {channel: amps, at: 1 A, slope: 4 N/mm/A}}
      between: [middle, top]
    """

    def lower(t):
        return 1e4 + 4e3 * (current(t) - 1.0)

    def rate(t, y):
        pull = lower(t) * (MOTION.place(t) - y[0])
        return [y[1], (pull - 2e4 * y[0] - 40.0 * y[1]) / 2.0]

    truth = solve_ivp(rate, TIME[[0, -1]], [0.0, 0.0], "DOP853", TIME, rtol=1e-11, atol=1e-13, max_step=5e-3).y[0]
    pull = lower(TIME) * (X - truth)
    excitation = replace(run(amps=current(TIME)), motions={"top": drive_of(MOTION, TIME)})
    found = force(branches, excitation, nodes, tolerance=1e-5)
    assert rms(found - pull) < 2e-4 * rms(pull)


@pytest.mark.parametrize("branches", [SERIES, f"slow: {{element: maxwell, stiffness: 100 N/mm, {TIMES}}}"])
def test_a_channel_that_rests_is_a_setting(branches):
    still = np.full(TIME.size, 1.7)
    of_setting = branches.replace("channel: amps", "setting: amps")
    expected = force(of_setting, run({"amps": 1.7}))
    assert force(branches, run(amps=still)) == pytest.approx(expected, abs=1e-9 * np.ptp(expected))
    # where there is no channel, what is told of it holds all the time
    assert force(branches, run({mean_of("amps"): 1.7})) == pytest.approx(expected, abs=1e-9 * np.ptp(expected))
    assert force(branches, run({"amps": 1.7})) == pytest.approx(expected, abs=1e-9 * np.ptp(expected))


def test_networks_that_differ_in_the_place_alone_are_two_programs():
    oil = "oil: {element: damper, damping: {fixed: 100 N*s/m, over: {channel: amps, at: %s A, slope: 20 N*s/m/A}}}"
    for at in (0.0, 1.0):
        truth = (100.0 + 20.0 * (current(TIME) - at)) * V
        assert force(oil % at, run(amps=current(TIME))) == pytest.approx(truth, abs=1e-9 * np.ptp(truth))


def test_a_long_record_is_the_same_in_pieces(monkeypatch):
    whole = force(SERIES, run(amps=current(TIME)))
    monkeypatch.setattr(kernel_system, "PIECE", 137)
    monkeypatch.setattr(kernel_system, "KEPT", 500)
    assert force(SERIES, run(amps=current(TIME))) == pytest.approx(whole, abs=1e-9 * np.ptp(whole))


def test_the_zero_and_the_gain_of_a_load_cell_follow_the_temperature():
    more = """\
measurement:
  force:
    gain: {fixed: 1, over: {channel: warm, at: 20 degC, slope: 0.002 /K}}
    offset: {fixed: 3 N, over: {channel: warm, at: 20 degC, slope: -0.5 N/K}}
"""
    away = warming(TIME) - KELVIN
    truth = (1.0 + 0.002 * away) * 2e5 * X + 3.0 - 0.5 * away
    found = force("rubber: {element: spring, stiffness: 200 N/mm}", run(warm=warming(TIME)), more=more)
    assert found == pytest.approx(truth, abs=1e-9 * np.ptp(truth))


def test_what_a_moving_spring_stores_is_not_told_but_what_a_moving_damper_loses_is():
    branches = """\
    rubber: {element: spring, stiffness: {fixed: 200 N/mm, over: {channel: warm, at: 20 degC, rate: -1 %/K}}}
    oil: {element: damper, damping: {fixed: 300 N*s/m, over: {channel: warm, at: 20 degC, slope: -4 N*s/m/K}}}
    """
    shares = {share.name: share for share in energy_balance(network(branches), run(warm=warming(TIME))).branches}
    assert shares["rubber"].stored is None
    lost = np.trapezoid((300.0 - 4.0 * (warming(TIME) - KELVIN)) * V**2, TIME)
    assert shares["oil"].dissipated == pytest.approx(lost, rel=1e-3)


def test_where_nothing_is_measured_a_number_rests():
    """In other programs and under a steady sine the channel has the value that is told of it."""
    oil = "oil: {element: damper, damping: {fixed: 100 N*s/m, over: {channel: amps, at: 0 A, slope: 20 N*s/m/A}}}"
    spec = network(oil)
    assert exported(spec, {"amps": 2.0}).values[0] == pytest.approx(140.0)
    solver = jit_network(spec, {"amps": 2.0})
    out = np.empty(TIME.size)
    solver.simulate(X, V, DT, solver.parameters, out)
    assert out[1:] == pytest.approx(140.0 * V[1:], abs=1e-6 * np.max(np.abs(V)))
    stiffness = dynamic_stiffness(spec, 5.0, 1e-3, settings={"amps": 2.0})
    assert stiffness == pytest.approx(2j * np.pi * 5.0 * 140.0, rel=1e-3)


@pytest.mark.parametrize("branches", [SERIES, f"slow: {{element: maxwell, stiffness: 100 N/mm, {TIMES}}}"])
def test_a_channel_of_another_length_is_refused(branches):
    with pytest.raises(ValueError, match=r"'amps': expected 2001 samples as the motion has, got \(2000,\)"):
        force(branches, run(amps=current(TIME[1:])))


def test_outside_of_any_run_a_number_is_the_one_at_its_place():
    """A bare motion, of which no settings are told."""
    for branches in (SERIES, f"slow: {{element: maxwell, stiffness: 100 N/mm, {TIMES}}}"):
        network_of_channel = compile_network(network(branches))
        bare = network_of_channel.simulate(network_of_channel.prepare(drive_of(MOTION, TIME)))
        plain = force(branches, run({"amps": 1.0}), tolerance=1e9)
        assert np.ravel(bare) == pytest.approx(plain, abs=1e-2 * np.ptp(plain))


SWITCHED = np.where((4.0 * TIME).astype(int) % 2, 2.5, 0.3)


def integrated(rate, states):
    """The states (n, states) from rest, sample by sample: a channel bends at each of them."""
    found = np.zeros((TIME.size, states))
    for k in range(1, TIME.size):
        step = solve_ivp(rate, TIME[k - 1 : k + 1], found[k - 1], "DOP853", rtol=1e-10, atol=1e-13)
        found[k] = step.y[:, -1]
    return found


@pytest.mark.parametrize(
    "oil",
    [
        "{element: damper, damping: {fixed: 100 N*s/m, over: {channel: amps, at: 0 A, slope: 200 N*s/m/A}}",
        "{element: maxwell, stiffness: 30 N/mm, "
        "relaxation_time: {fixed: 10 ms, over: {channel: amps, at: 1 A, rate: 80 %/A}}",
    ],
    ids=["without memory", "with memory"],
)
def test_a_mass_on_a_damper_that_is_switched_within_a_sample_is_as_exact_as_it_is_told_to_be(oil):
    nodes = "{top: driven, middle: {mass: 2 kg}, base: ground}"
    branches = f"""\
    upper: {{element: spring, stiffness: 20 N/mm, between: [base, middle]}}
    oil: {oil}, between: [base, middle]}}
    lower: {{element: spring, stiffness: 10 N/mm, between: [middle, top]}}
    """

    def rate(t, y):
        amps = np.interp(t, TIME, SWITCHED)
        if "maxwell" in oil:
            damped, relaxing = y[2], 3e4 * y[1] - y[2] / (0.01 * np.exp(0.8 * (amps - 1.0)))
        else:
            damped, relaxing = (100.0 + 200.0 * amps) * y[1], 0.0
        return [y[1], (1e4 * (MOTION.place(t) - y[0]) - 2e4 * y[0] - damped) / 2.0, relaxing]

    pull = 1e4 * (X - integrated(rate, 3)[:, 0])
    excitation = replace(run(amps=SWITCHED), motions={"top": drive_of(MOTION, TIME)})
    for tolerance in (1e-3, 1e-5):
        found = solve(compile_network(network(branches, nodes)), excitation, tolerance=tolerance)
        assert rms(found.force["top"] - pull) < found.error["top"] < tolerance * rms(pull)
        assert np.max(np.abs(found.force["top"] - pull)) < found.peak["top"]
