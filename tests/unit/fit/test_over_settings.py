"""Numbers that depend on a setting of the run: in a simulation, in a Jacobian, in a whole fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.fit.bench import TIME, ready, rows_of

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.excitation import Excitation
from dashpot.data.run import Run
from dashpot.fit.api import fit_network
from dashpot.fit.scored import score_run
from dashpot.fit.thinned import thinned
from dashpot.kernel.api import simulate_runs
from dashpot.kernel.network import compile_network
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError

REGISTRY = load_registry()
PRESSURES = (1.0, 2.0, 3.0)
HEAD = "format: dashpot-network/1\nname: tire\nbranches:\n"
TRUTH = (
    HEAD
    + """\
  rubber: {element: spring, stiffness: 200 N/mm}
  air: {element: damper, damping: {fixed: 300 N*s/m, over: {setting: pressure, at: 2 bar, rate: 20 %/bar}}}
  friction:
    element: dahl
    stiffness: 300 N/mm
    limit: {fixed: 40 N, over: {setting: pressure, at: 2 bar, slope: 15 N/bar}}
  piston: {element: constant_force, force: {fixed: 0 N, over: {setting: pressure, at: 0 bar, slope: 100 N/bar}}}
"""
)
MODEL = (
    HEAD
    + """\
  rubber: {element: spring, stiffness: {start: 100 N/mm}}
  air: {element: damper, damping: {start: 100 N*s/m, over: {setting: pressure, at: 2 bar, rate: {start: 0 /bar}}}}
  friction:
    element: dahl
    stiffness: {start: 100 N/mm}
    limit: {start: 10 N, over: {setting: pressure, at: 2 bar, slope: {start: 0 N/bar}}}
  piston: {element: constant_force, force: {fixed: 0 N, over: {setting: pressure, at: 0 bar, slope: {start: 0 N/bar}}}}
"""
)


def run(name, pressure, amplitude, frequency, text=TRUTH, **settings):
    x = amplitude * np.sin(2.0 * np.pi * frequency * TIME) * np.minimum(1.0, TIME / 0.2)
    given = {"pressure": pressure * 1e5} | settings
    made = Run(name, "harmonic", TIME, {"displacement": x, "force": np.zeros_like(x)}, given, group=name)
    force = simulate_runs(parse_network(text, REGISTRY.elements), Dataset("d", (made,)))[name]
    noise = 0.1 * np.random.default_rng(len(name)).standard_normal(x.size)
    return replace(made, channels={"displacement": x, "force": force + noise})


DRIFTING = """\
measurement: {force: {offset: {fixed: 0 N, over: {setting: order, at: 0, slope: %s}}}}
"""


def test_a_zero_that_drifts_over_the_session_is_one_number_of_the_load_cell():
    """The third run of the dataset shows its force and three times the drift; a fit finds the drift with the rest."""
    runs = [replace(each, order=number) for number, each in enumerate(dataset().runs)]
    shifted = [replace(each, channels={**each.channels, "force": each.force - 3.0 * each.order}) for each in runs]
    seen = simulate_runs(parse_network(TRUTH + DRIFTING % "-3 N", REGISTRY.elements), Dataset("d", tuple(runs)))
    for each in shifted:
        assert seen[each.name] == pytest.approx(each.force, abs=0.6)  # six times the noise
    model = parse_network(MODEL + DRIFTING % "{start: 0 N}", REGISTRY.elements)
    result = fit_network(model, Dataset("d", tuple(shifted)), registry=REGISTRY)
    found, told = result.fitted, result.as_dict()["parameters"]
    numbers = {slot.path: slot.value.number for slot in found.slots()}
    assert numbers["measurement.force.offset.slope"] == pytest.approx(-3.0, abs=0.02)
    assert numbers["piston.force.slope"] == pytest.approx(100.0 / 1e5, rel=0.01)
    assert [path for path, each in told.items() if each.get("per") == "run"] == ["measurement.force.offset.slope"]
    assert "offset.slope = -3" in result.summary() and result.summary().count(" N per run") == 1


def test_outside_of_a_dataset_a_number_over_the_order_is_the_one_that_is_told():
    """A rig drives a specimen of no order: what is to be seen there is the fixed number."""
    of_order = TRUTH.replace("setting: pressure, at: 0 bar, slope: 100 N/bar", "setting: order, at: 2, slope: 9")
    ordered = compile_network(parse_network(of_order, REGISTRY.elements))
    driven = replace(Excitation.of_run(run("a", 2.0, 1e-3, 3.0)), settings={"pressure": 2e5})
    told = compile_network(parse_network(TRUTH.partition("  piston")[0], REGISTRY.elements))
    assert ordered.simulate(ordered.prepare(driven)) == pytest.approx(told.simulate(told.prepare(driven)))


def test_a_run_that_gives_its_own_zero_has_it_in_the_jacobian():
    """The residual of a Jacobian is that of the runs as they are simulated, each with its zero."""
    spring = "  rubber: {element: spring, stiffness: {start: 150 N/mm}}\n"
    zero = "measurement: {force: {offset: {setting: zero, value: 0 N}}}\n"
    made = [run(f"z{value:g}", 2.0, 2e-3, 3.0, HEAD + spring + zero, zero=value) for value in (0.0, 40.0, -25.0)]
    _, objective, _ = ready(spring, [score_run(each) for each in made], zero)
    residual, _ = rows_of(objective, objective.network.start, [0], [1.0])
    assert np.sqrt(np.mean(residual**2)) < 0.2  # the noise


def dataset():
    runs = [run(f"p{p:g}_{f:g}", p, a, f) for p in PRESSURES for a, f in ((3e-3, 2.0), (1e-3, 7.0))]
    return Dataset("d", tuple(runs))


def test_each_run_has_the_number_of_its_setting():
    for pressure in PRESSURES:
        plain = (
            HEAD
            + f"""\
  rubber: {{element: spring, stiffness: 200 N/mm}}
  air: {{element: damper, damping: {300.0 * np.exp(0.2 * (pressure - 2.0)):.17g} N*s/m}}
  friction: {{element: dahl, stiffness: 300 N/mm, limit: {40.0 + 15.0 * (pressure - 2.0):g} N}}
  piston: {{element: constant_force, force: {100.0 * pressure:g} N}}
"""
        )
        found, expected = (run("r", pressure, 2e-3, 5.0, text).force for text in (TRUTH, plain))
        assert found == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("current", "factor"), [(-1.0, 1.0), (0.0, 1.0), (0.5, 1.5), (1.5, 2.25), (7.0, 2.5)])
def test_factors_go_along_straight_lines_between_their_places(current, factor):
    text = HEAD + (
        "  oil: {element: damper, damping: {fixed: 100 N*s/m, over: {setting: current, at: [0, 1, 2], "
        "factor: [1, 2, 2.5]}}}\n"
    )
    plain = HEAD + f"  oil: {{element: damper, damping: {100.0 * factor} N*s/m}}\n"
    found, expected = (run("r", 1.0, 2e-3, 5.0, text, current=current).force for text in (text, plain))
    assert found == pytest.approx(expected, abs=1e-9)


def test_a_number_stays_inside_its_sensible_range():
    text = HEAD + "  oil: {element: damper, damping: {fixed: 100 N*s/m, over: {setting: t, at: 0, slope: -30 N*s/m}}}\n"
    force = run("r", 1.0, 2e-3, 5.0, text, t=50.0).force
    assert np.max(np.abs(force)) < 1.0


def along(celsius, name="r", law=lambda celsius: 300.0 - 4.0 * (celsius - 20.0), amplitude=2e-3, frequency=5.0):
    """A run of a spring and a damper whose damping has the temperature of each sample, by its own formula."""
    omega = 2.0 * np.pi * frequency
    x, v = amplitude * np.sin(omega * TIME), amplitude * omega * np.cos(omega * TIME)
    noise = 0.1 * np.random.default_rng(len(name)).standard_normal(x.size)
    channels = {"displacement": x, "force": 5e4 * x + law(celsius) * v + noise, "temperature": 273.15 + celsius}
    return Run(name, "harmonic", TIME, channels, {}, group=name)


WARM = HEAD + (
    "  rubber: {element: spring, stiffness: {start: 30 N/mm}}\n"
    "  oil: {element: damper, damping: {start: 100 N*s/m, over: {channel: temperature, at: 20 degC, "
    "slope: {start: 0 N*s/m/K}}}}\n"
)


def test_a_fit_finds_what_a_temperature_does_that_moves_within_runs_alone():
    """The means of all runs are the same: nothing but what happens within them can tell."""
    swings = [8.0 * np.sin(2.0 * np.pi * f * TIME / TIME[-1]) for f in (1.0, 2.0, 3.0)]
    runs = [
        along(30.0 + swing, f"r{k}", amplitude=a, frequency=f)
        for k, (swing, a, f) in enumerate(zip(swings, (2e-3, 1e-3, 3e-3), (5.0, 9.0, 3.0), strict=True))
    ]
    fit = fit_network(parse_network(WARM, REGISTRY.elements), Dataset("d", tuple(runs)), registry=REGISTRY)
    numbers = {slot.path: slot.value.number for slot in fit.fitted.slots()}
    assert numbers["oil.damping"] == pytest.approx(300.0, rel=1e-2)
    assert numbers["oil.damping.slope"] == pytest.approx(-4.0, rel=1e-2)
    assert fit.errors.train == pytest.approx(0.1, rel=0.1)
    assert "take its mean" not in fit.summary()


def test_runs_without_the_setting_are_named_before_anything_is_simulated():
    runs = list(dataset().runs)
    lacking = tuple(replace(each, settings={}) if number in (1, 4) else each for number, each in enumerate(runs))
    spec = parse_network(MODEL, REGISTRY.elements, "m.yaml")
    for work in (simulate_runs, lambda spec, data: fit_network(spec, data, registry=REGISTRY)):
        with pytest.raises(InputError) as caught:
            work(spec, Dataset("d", lacking))
        told = str(caught.value)
        assert "m.yaml:5:35: 'air.damping' depends on the setting 'pressure', which run 'p1_7' does not have" in told
        assert "run 'p3_2'" in told
        assert "p2_2" not in told
    bare = Excitation.of_run(lacking[1])
    with pytest.raises(InputError, match="run 'p1_7' does not have"):
        compile_network(spec).prepare(bare)


def as_a_whole(objective, values, which, shifts):
    lanes = np.repeat(values[None], 1 + len(which), axis=0)
    lanes[np.arange(1, 1 + len(which)), which] += shifts
    rows = objective.residuals(lanes)
    return rows[0], rows[1:] - rows[0]


def test_the_jacobian_knows_the_slopes():
    scored = [score_run(each) for each in dataset().runs]
    _, objective, coordinates = ready(MODEL.partition("branches:\n")[2], scored)
    values = coordinates.to_values(coordinates.start)[0]
    shifts = 1e-3 * np.maximum(np.abs(values[coordinates.which]), 1e-4)
    residual, changes = rows_of(objective, values, coordinates.which, shifts)
    whole, moved = as_a_whole(objective, values, coordinates.which, shifts)
    assert residual == pytest.approx(whole, abs=1e-9)
    assert changes == pytest.approx(moved, abs=1e-8)
    assert np.all(np.max(np.abs(changes), axis=1) > 0.0)


def test_branches_of_one_law_with_other_dependences_are_not_one_make():
    text = """
oil: {element: damper, damping: {start: 100 N*s/m, over: {setting: pressure, at: 2 bar, slope: {start: 20 N*s/m/bar}}}}
air: {element: damper, damping: {start: 50 N*s/m, over: {setting: pressure, at: 1 bar, slope: {start: 5 N*s/m/bar}}}}
"""
    _, objective, coordinates = ready(text, [score_run(each) for each in dataset().runs])
    values = objective.network.start
    shifts = 1e-2 * np.abs(values[coordinates.which])
    residual, changes = rows_of(objective, values, coordinates.which, shifts)
    whole, moved = as_a_whole(objective, values, coordinates.which, shifts)
    assert residual == pytest.approx(whole, abs=1e-9)
    assert changes == pytest.approx(moved, abs=1e-8)


def test_a_fit_finds_base_slope_and_rate():
    found = fit_network(parse_network(MODEL, REGISTRY.elements), dataset(), registry=REGISTRY)
    numbers = {slot.path: slot.value for slot in found.fitted.slots()}
    truth = {
        "rubber.stiffness": 2e5,
        "air.damping": 300.0,
        "air.damping.rate": 0.2e-5,
        "friction.limit": 40.0,
        "friction.limit.slope": 15e-5,
        "piston.force.slope": 100e-5,
    }
    for path, number in truth.items():
        assert numbers[path].number == pytest.approx(number, rel=0.02)
        low, high = numbers[path].interval
        assert low < numbers[path].number < high
    assert found.errors.train == pytest.approx(0.1, rel=0.1)
    again = parse_network(found.identified_text, REGISTRY.elements)
    assert {slot.path for slot in again.slots()} == set(numbers)


def test_a_network_with_nodes_knows_the_setting():
    text = """\
format: dashpot-network/1
name: two
nodes: {top: driven, middle: {mass: 1 kg}, base: ground}
branches:
  upper: {element: spring, stiffness: 100 N/mm, between: [base, middle]}
  lower:
    element: spring
    between: [middle, top]
    stiffness: {fixed: 50 N/mm, over: {setting: pressure, at: 2 bar, slope: 25 N/mm/bar}}
"""
    plain = text.replace("{fixed: 50 N/mm, over: {setting: pressure, at: 2 bar, slope: 25 N/mm/bar}}", "75 N/mm")
    found, expected = (run("r", 3.0, 1e-3, 3.0, each).force for each in (text, plain))
    assert found == pytest.approx(expected, abs=1e-9)


STEPPED = (
    HEAD
    + "  rubber: {element: spring, stiffness: {start: 150 N/mm}}\n"
    + "  air: {element: damper, damping: {start: 200 N*s/m, over: {setting: pressure, at: [1 bar, 2 bar, 3 bar], "
    + "factor: [1, {start: 1}, {start: 1}]}}}\n"
)


def test_the_terminal_tells_the_factors_and_no_points_of_a_curve():
    curve = "{deflection: [-4 mm, 0 mm, 4 mm], force: {start: [-600 N, 0 N, 600 N]}}"
    text = STEPPED.replace("{start: 150 N/mm}", curve)
    found = fit_network(parse_network(text, REGISTRY.elements), dataset(), registry=REGISTRY).summary()
    assert "air.damping.factor[1] = " in found and "air.damping.factor[2] = " in found
    assert "air.damping.factor[0]" not in found  # it is fixed
    assert "rubber.stiffness[" not in found


@pytest.mark.parametrize(("drift", "told"), [(2.0, False), (30.0, True)])
def test_a_channel_of_a_mass_that_moves_within_runs_is_told_with_the_fit(drift, told):
    """A mass has one value in a run. The means of the two training runs lie 10 K apart."""
    text = """\
format: dashpot-network/1
name: heavy
nodes:
  top: {hold: driven, mass: {start: 1 kg, over: {channel: temperature, at: 20 degC, slope: {start: 0 kg/K}}}}
  base: ground
branches:
  oil: {element: damper, between: [base, top], damping: {start: 90 N*s/m}}
"""
    runs = [
        along(celsius + drift * np.linspace(-0.5, 0.5, TIME.size), f"at{celsius:g}") for celsius in (20.0, 30.0, 40.0)
    ]
    fit = fit_network(parse_network(text, REGISTRY.elements), Dataset("d", tuple(runs)), registry=REGISTRY)
    wanted = "it moves by up to 27 K within a run, while the means lie 10 K apart"
    assert (wanted in fit.summary()) is told
    assert any(wanted in sentence for sentence in fit.as_dict()["identifiability"]["weak"]) is told


MOVING = {
    "alone": """
rubber: {element: spring, stiffness: {start: 50 N/mm, over: {channel: temperature, at: 20 degC, rate: {start: -1 %/K}}}}
slow:
  element: maxwell
  stiffness: {start: 30 N/mm}
  relaxation_time: {start: 20 ms, over: {channel: temperature, at: 20 degC, wlf: [{start: 9}, {start: 100 K}]}}
oil:
  element: damper
  damping:
    start: 100 N*s/m
    over: {channel: temperature, at: [22 degC, 30 degC, 36 degC], factor: [1, {start: 0.8}, {start: 0.5}]}
""",
    "in series": """
strut:
  series:
    coil: {element: spring, stiffness: {start: 50 N/mm}}
    oil:
      element: damper
      damping: {start: 1 N*s/mm, over: {channel: temperature, at: 300 K, slope: {start: -9 N*s/m/K}}}
""",
}
CELL = """\
measurement: {force: {offset: {start: 2 N, over: {channel: temperature, at: 30 degC, slope: {start: 0.1 N/K}}}}}
"""


@pytest.mark.parametrize("text", MOVING)
def test_the_jacobian_follows_the_channel(text):
    scored = [score_run(along(30.0 + 8.0 * np.sin(4.0 * TIME))), score_run(along(20.0 + 9.0 * TIME, "other"))]
    _, objective, coordinates = ready(MOVING[text], scored, CELL)
    values = coordinates.to_values(coordinates.start)[0]
    shifts = 1e-4 * np.maximum(np.abs(values[coordinates.which]), 1e-4)
    _, changes = rows_of(objective, values, coordinates.which, shifts)
    for change, slot, shift in zip(changes, coordinates.which, shifts, strict=True):
        ends = np.repeat(values[None], 2, axis=0)
        ends[:, slot] += 0.5 * shift * np.array([-1.0, 1.0])
        less, more = objective.residuals(ends)
        assert np.max(np.abs(more - less)) > 0.0
        assert change == pytest.approx(more - less, abs=2e-3 * np.max(np.abs(more - less)))


def test_thinned_runs_have_the_channel_at_the_samples_that_stay():
    slow = along(30.0 + 8.0 * np.sin(4.0 * TIME), frequency=8.0)
    [run] = thinned([score_run(slow)])
    step = round(run.drive.dt / 1e-3)
    assert step > 5
    assert (
        run.excitation.channels["temperature"].tolist()
        == slow.channels["temperature"][::step][: run.force.size].tolist()
    )
