"""Fits to rows of tables; truth: complex stiffness in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import iv
from seeds import seed_of
from unit.fit.bench import rows_of
from unit.steady_rows import row

from dashpot import load_registry
from dashpot.compare.signals import signal_evidence
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.data.steady import harmonic_of
from dashpot.fit.api import fit_network
from dashpot.fit.objective import Objective
from dashpot.fit.scored import score_run, weighted
from dashpot.kernel.network import compile_network
from dashpot.model.reading import parse_network

REGISTRY = load_registry()
HEAD = "format: dashpot-network/1\nname: mount\nbranches:\n"
STIFFNESS, SECOND, TIME, DAMPING = 2e5, 6e4, 0.02, 100.0
MODEL = """\
  rubber: {element: spring, stiffness: {start: 1e5}}
  slow: {element: maxwell, stiffness: {start: 2e4}, relaxation_time: {start: 5e-3}}
  oil: {element: damper, damping: {start: 30}}
"""


def network(branches: str):
    return parse_network(HEAD + branches, REGISTRY.elements)


def solid(frequency: float, time: float = TIME) -> complex:
    """A spring, a Maxwell branch and a damper."""
    rate = 2j * np.pi * frequency
    return STIFFNESS + SECOND * rate * time / (1.0 + rate * time) + rate * DAMPING


def simulated(branches: str, run: Run) -> complex:
    compiled = compile_network(network(branches))
    (force,) = Objective(compiled, [score_run(run)]).forces(compiled.start)
    return complex(harmonic_of(force[0])) / run.settings["amplitude"]


@pytest.mark.parametrize("reach", [0.5, 1.5, 6.0])
def test_the_response_of_friction_is_its_describing_function(reach):
    """Dahl friction over amplitudes of ``reach`` times its travel: Bessel functions, see the physics of Dahl's law."""
    limit, amplitude = 50.0, 1e-3
    branch = f"  it: {{element: dahl, stiffness: {limit * reach / amplitude}, limit: {limit}}}\n"
    found = simulated(branch, row("a", 10.0, amplitude, 0j))
    storage = 2.0 * limit * iv(1, reach) / (amplitude * np.cosh(reach))
    loss = 4.0 * limit / (np.pi * amplitude) * (1.0 - np.tanh(reach) / reach)
    assert found == pytest.approx(storage + 1j * loss, rel=2e-3)


@pytest.mark.parametrize("frequency", [0.5, 7.0, 40.0])
def test_the_response_of_a_solid_is_its_complex_stiffness(frequency):
    text = (
        f"  a: {{element: spring, stiffness: {STIFFNESS}}}\n  b: {{element: damper, damping: {DAMPING}}}\n"
        f"  c: {{element: maxwell, stiffness: {SECOND}, relaxation_time: {TIME}}}\n"
    )
    assert simulated(text, row("a", frequency, 1e-3, 0j, 5e-3)) == pytest.approx(solid(frequency), rel=1e-4)


def test_a_hydro_mount_rings_down_before_it_is_looked_at():
    mass, bulge, damping = 50.0, 2e5, 1.6e3
    text = f"  it: {{element: hydro, stiffness: {bulge}, fluid_mass: {mass}, damping: {damping}}}\n"
    for frequency in (8.0, 12.0, 50.0):
        rate = 2.0 * np.pi * frequency
        inner = -mass * rate**2 + 1j * rate * damping
        truth = bulge * inner / (bulge + inner)
        assert simulated(text, row("a", frequency, 1e-3, 0j)) == pytest.approx(truth, rel=1e-3)


def test_a_fit_finds_the_numbers_of_a_table():
    rng = np.random.default_rng(seed_of("rows"))
    runs = [
        row(f"r{k}", frequency, 1e-3, solid(frequency) * (1.0 + 0.002 * rng.standard_normal()), scatter=400.0)
        for k, frequency in enumerate((1.0, 2.0, 4.0, 8.0, 12.0, 16.0, 24.0, 32.0))
    ]
    fit = fit_network(network(MODEL), Dataset("table", tuple(runs)), registry=REGISTRY)
    found = {slot.path: slot.value for slot in fit.fitted.slots()}
    truth = {"rubber.stiffness": STIFFNESS, "slow.stiffness": SECOND, "slow.relaxation_time": TIME}
    for path, number in {**truth, "oil.damping": DAMPING}.items():
        assert found[path].number == pytest.approx(number, rel=0.08)
    assert (fit.noise_floor.source, fit.noise_floor.value) == ("stated", pytest.approx(0.4))
    assert fit.errors.train < 0.8


def test_a_row_errs_by_what_its_fundamental_errs_by_whatever_the_mean_and_the_harmonics():
    text = "  a: {element: spring, stiffness: {polynomial: [2e5, 3e6, 4e8]}}\n"
    amplitude, preload = 1e-3, 4e-3
    run = row("a", 10.0, amplitude, 2e5 + 1e4j, preload)
    slope = 2e5 + 2 * 3e6 * preload + 3 * 4e8 * preload**2 + 0.75 * 4e8 * amplitude**2
    compiled = compile_network(network(text))
    (error,) = Objective(compiled, [score_run(run)]).rmse(compiled.start)
    assert error == pytest.approx(amplitude * abs(slope - (2e5 + 1e4j)) / np.sqrt(2.0), rel=1e-4)


def test_the_jacobian_of_rows_is_that_of_their_losses():
    runs = weighted([row("a", 5.0, 1e-3, solid(5.0)), row("b", 20.0, 1e-3, solid(20.0))])
    spec = network(MODEL)
    objective = Objective(compile_network(spec), runs)
    start = np.array(compile_network(spec).start).ravel()
    residual, changes = rows_of(objective, start, [2], [1e-6])
    moved = start.copy()
    moved[2] += 1e-6
    assert objective.residuals(moved)[0] - residual == pytest.approx(changes[0], abs=1e-7)
    assert objective.losses(start)[0] == pytest.approx(np.sqrt(np.mean(residual**2)))


def test_rows_of_a_small_scatter_count_more():
    runs = [
        row("a", 5.0, 1e-3, solid(5.0), scatter=100.0),
        row("b", 5.0, 1e-3, solid(5.0), scatter=200.0),
        row("c", 5.0, 1e-3, solid(5.0)),
    ]
    assert [run.weight for run in weighted(runs)] == pytest.approx([1.6, 0.4, 1.0])


def test_time_and_frequency_data_mix():
    time = 1e-3 * np.arange(2000)
    x = 2e-3 * np.sin(2.0 * np.pi * 5.0 * time)
    force = STIFFNESS * x + DAMPING * 2e-3 * 10.0 * np.pi * np.cos(10.0 * np.pi * time)
    channels = {"displacement": x, "force": force}
    records = [Run(name, "harmonic", time, channels, group=name) for name in ("t0", "t1")]
    rate = 2j * np.pi * np.array([1.0, 10.0, 30.0])
    rows = [row(f"r{k}", 30.0, 1e-3, STIFFNESS + rate[2] * DAMPING) for k in range(3)]
    model = "  a: {element: spring, stiffness: {start: 1e5}}\n  b: {element: damper, damping: {start: 30}}\n"
    fit = fit_network(network(model), Dataset("both", (*records, *rows)), registry=REGISTRY)
    assert [slot.value.number for slot in fit.fitted.slots()] == pytest.approx([STIFFNESS, DAMPING], rel=1e-3)


def test_a_report_shows_the_rows_as_points_of_dynamic_stiffness():
    (run,) = (row("a", 20.0, 1e-3, 2e5 + 5e4j, 4e-3),)
    (point,) = signal_evidence((run,), {"half": {"a": 0.5 * run.force}})["dynamic_stiffness"]
    assert point["frequency"] == pytest.approx(20.0, rel=1e-3) and point["amplitude"] == pytest.approx(1e-3, rel=1e-3)
    assert point["measured"]["stiffness"] == pytest.approx(abs(2e5 + 5e4j), rel=1e-3)
    assert point["measured"]["loss_angle"] == pytest.approx(np.angle(2e5 + 5e4j), rel=1e-2)
    assert point["simulated"]["half"]["stiffness"] == pytest.approx(0.5 * abs(2e5 + 5e4j), rel=1e-3)


def test_a_curve_that_tables_alone_tell_has_their_slopes():
    rows = [row(f"r{k}", 2.0, 0.5e-3, 2e5 + 2 * 4e6 * place + 0j, place) for k, place in enumerate(np.arange(5) * 2e-3)]
    model = "  a: {element: spring, stiffness: {from: quasi_static}}\n"
    fit = fit_network(network(model), Dataset("slopes", tuple(rows)), registry=REGISTRY)
    assert fit.errors.all < 0.02 * 0.5e-3 * 2e5
    table = fit.fitted.curves()["a.stiffness"]
    at, force = np.array(table.at), np.array([value.number for value in table.values])
    assert np.diff(force) == pytest.approx(np.diff(2e5 * at + 4e6 * at**2), rel=0.06)


def test_a_table_at_one_preload_tells_a_straight_line():
    rows = [row(f"r{k}", 2.0, amplitude, 2e5 + 0j, 3e-3) for k, amplitude in enumerate((1e-4, 1e-3))]
    model = "  a: {element: spring, stiffness: {from: quasi_static}}\n"
    fit = fit_network(network(model), Dataset("one", tuple(rows)), registry=REGISTRY)
    table = fit.fitted.curves()["a.stiffness"]
    assert table.at == pytest.approx((2e-3, 4e-3))
    low, high = (value.number for value in table.values)
    assert (high - low) / 2e-3 == pytest.approx(2e5, rel=1e-3)


@pytest.mark.parametrize(
    ("law", "numbers", "start"),
    [
        ("wlf", (8.0, 80.0), "[{start: 15}, {start: 50 K}]"),
        ("arrhenius", (9000.0,), "{start: 3000 K}"),
    ],
)
def test_a_shift_with_temperature_is_found(law, numbers, start):
    place = 296.15

    def shifted(warm: float) -> float:
        if law == "wlf":
            return TIME * 10.0 ** (-numbers[0] * (warm - place) / (numbers[1] + warm - place))
        return TIME * np.exp(numbers[0] * (1.0 / warm - 1.0 / place))

    places = [(warm, rate) for warm in (286.15, 291.15, 296.15, 306.15, 316.15) for rate in (1.0, 4.0, 16.0)]
    stiffness = [solid(rate, shifted(warm)) - 2j * np.pi * rate * DAMPING for warm, rate in places]
    rows = [
        row(f"r{warm}-{rate}", rate, 1e-3, each, temperature=warm)
        for (warm, rate), each in zip(places, stiffness, strict=True)
    ]
    over = f"over: {{setting: temperature, at: 23 degC, {law}: {start}}}"
    maxwell = f"{{element: maxwell, stiffness: {{start: 3e4}}, relaxation_time: {{start: 5e-3, {over}}}}}"
    model = f"  a: {{element: spring, stiffness: {{start: 1e5}}}}\n  b: {maxwell}\n"
    fit = fit_network(network(model), Dataset("warm", tuple(rows)), registry=REGISTRY)
    found = [slot.value.number for slot in fit.fitted.slots() if law in slot.path]
    assert found == pytest.approx(list(numbers), rel=0.02)


SHIFT, PLACE = (8.0, 80.0), 296.15
SHARED = """\
  a: {element: spring, stiffness: {start: 1e5}}
  b:
    element: maxwell
    stiffness: {start: 3e4}
    relaxation_time: {start: 5e-2, over: {setting: temperature, at: 23 degC, wlf: [{start: 15}, {start: 50 K}]}}
  c:
    element: maxwell
    stiffness: {start: 3e4}
    relaxation_time:
      start: 5e-3
      over:
        setting: temperature
        at: 23 degC
        wlf:
          - expression: b.relaxation_time.wlf[0]
          - expression: b.relaxation_time.wlf[1]
"""
BRANCHES = ((6e4, 2e-2), (4e4, 2e-3))


def shifted(warm: float) -> float:
    return 10.0 ** (-SHIFT[0] * (warm - PLACE) / (SHIFT[1] + warm - PLACE))


def shifted_rows() -> list[Run]:
    found = []
    for warm in (286.15, 291.15, 296.15, 306.15, 316.15):
        for frequency in (1.0, 4.0, 16.0, 40.0):
            rate = 2j * np.pi * frequency * shifted(warm)
            stiffness = STIFFNESS + sum(size * rate * time / (1.0 + rate * time) for size, time in BRANCHES)
            found.append(row(f"r{len(found)}", frequency, 1e-3, stiffness, temperature=warm))
    return found


def shifted_records() -> list[Run]:
    """Sines from rest: in each branch F = k A w T / (1 + w^2 T^2) (cos wt + w T sin wt - exp(-t/T))."""
    time, found = 2e-4 * np.arange(5000), []
    for warm in (286.15, 296.15, 306.15, 316.15):
        for frequency in (2.0, 12.0):
            turn = 2.0 * np.pi * frequency * time
            force = STIFFNESS * 1e-3 * np.sin(turn)
            for size, base in BRANCHES:
                fading = base * shifted(warm)
                share = 2.0 * np.pi * frequency * fading
                wave = np.cos(turn) + share * np.sin(turn) - np.exp(-time / fading)
                force = force + size * 1e-3 * share / (1.0 + share**2) * wave
            channels = {"displacement": 1e-3 * np.sin(turn), "force": force}
            settings = {"temperature": warm, "warm_up": 0.1}
            name = f"t{len(found)}"
            found.append(Run(name, "harmonic", time, channels, settings, group=name))
    return found


@pytest.mark.parametrize("measured", [shifted_rows, shifted_records])
def test_branches_that_share_a_shift_with_temperature_are_found_with_it(measured):
    fit = fit_network(network(SHARED), Dataset("warm", tuple(measured())), registry=REGISTRY)
    found = {slot.path: slot.value.number for slot in fit.fitted.slots()}
    assert [found[f"b.relaxation_time.wlf[{k}]"] for k in (0, 1)] == pytest.approx(list(SHIFT), rel=0.03)
    assert [found[f"c.relaxation_time.wlf[{k}]"] for k in (0, 1)] == [
        found[f"b.relaxation_time.wlf[{k}]"] for k in (0, 1)
    ]
    pairs = sorted((found[f"{name}.stiffness"], found[f"{name}.relaxation_time"]) for name in "bc")
    assert np.array(pairs) == pytest.approx(np.array(sorted(BRANCHES)), rel=0.03)
