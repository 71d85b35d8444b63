"""The shipped mounts, dampers and springs behave as their literature says: closed forms and own integrations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from verification.truth.static import elastic, factor

from dashpot import load_registry
from dashpot.data.drive import drive_from_path, drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.kernel.api import solve
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import read_network

COMPONENTS = (
    "rubber_bushing",
    "engine_mount",
    "strut_mount",
    "shock_absorber",
    "bump_stop",
    "leaf_spring",
    "tread_block",
)
PER_CYCLE = 200
RUBBER = 200e3  # N/m, of the straight curve of the engine mount


def component(name: str, **numbers: float) -> NetworkSpec:
    """A shipped network, some numbers changed: `branch__parameter` in SI."""
    spec = read_network(name, load_registry().elements)
    changed = {path.replace("__", "."): number for path, number in numbers.items()}
    slots = {slot.path: slot.value for slot in spec.slots()}
    return spec.with_values({path: replace(slots[path], number=number) for path, number in changed.items()})


def number(spec: NetworkSpec, path: str) -> float:
    return {slot.path: slot.value.number for slot in spec.slots()}[path]


def table(curve) -> tuple[np.ndarray, np.ndarray]:
    return np.array(curve.at), np.array([value.number for value in curve.values])


def force(spec: NetworkSpec, sample_time: float, x: np.ndarray, v: np.ndarray | None = None) -> np.ndarray:
    """The force in N along a motion in m; its rates come from a spline where they are not given."""
    smooth = drive_from_samples(sample_time, x, smooth=False)
    drive = smooth if v is None else drive_from_path(sample_time, x, v, smooth.acceleration)
    return next(iter(solve(compile_network(spec), Excitation({"": drive}, {}, {}, sample_time, x.size)).force.values()))


def sine(amplitude: float, frequency: float, cycles: int, middle: float = 0.0) -> tuple[float, np.ndarray, np.ndarray]:
    sample_time = 1.0 / frequency / PER_CYCLE
    turn = 2.0 * np.pi * np.arange(cycles * PER_CYCLE + 1) / PER_CYCLE
    return sample_time, middle + amplitude * np.sin(turn), 2.0 * np.pi * frequency * amplitude * np.cos(turn)


def last_cycle(spec: NetworkSpec, amplitude: float, frequency: float, middle: float = 0.0, cycles: int = 40):
    """Displacement and force of the last of some cycles."""
    sample_time, x, v = sine(amplitude, frequency, cycles, middle)
    return x[-PER_CYCLE - 1 :], force(spec, sample_time, x, v)[-PER_CYCLE - 1 :]


def dynamic_stiffness(
    spec: NetworkSpec, amplitude: float, frequency: float, middle: float = 0.0, cycles: int = 40
) -> complex:
    """K' + i K'' in N/m of the fundamental, of a sine that has settled."""
    x, found = last_cycle(spec, amplitude, frequency, middle, cycles)
    turn = np.exp(-2j * np.pi * np.arange(PER_CYCLE) / PER_CYCLE)
    return complex((found[:-1] @ turn) / ((x[:-1] - middle) @ turn))


def loss_angle(stiffness: complex) -> float:
    return float(np.degrees(np.angle(stiffness)))


def area(x: np.ndarray, found: np.ndarray) -> float:
    return float(np.trapezoid(found, x))


def there_and_back(low: float, high: float, speed: float, sample_time: float, strokes: int) -> np.ndarray:
    way = speed * sample_time
    up = np.arange(low, high, way)
    return np.concatenate([up if stroke % 2 == 0 else up[::-1] for stroke in range(strokes)])


@pytest.mark.parametrize("name", COMPONENTS)
def test_every_number_that_is_searched_has_bounds(name):
    spec = component(name)
    curves = spec.data_curves()
    searched = [slot for slot in spec.slots() if slot.value.searched and slot.path.partition("[")[0] not in curves]
    assert searched
    assert all(slot.value.bounds and slot.value.bounds[0] < slot.value.bounds[1] for slot in searched)


@pytest.mark.parametrize("name", COMPONENTS)
def test_every_component_can_be_measured_without_a_fit(name):
    x = there_and_back(0.0, 20e-3, 20e-3, 1e-3, 2)
    assert np.isfinite(force(component(name), 1e-3, x)).all()


def test_a_bushing_loses_what_its_sliders_and_its_power_law_lose():
    bushing, amplitude, frequency = component("rubber_bushing"), 0.6e-3, 3.0
    count, shortest, longest = 8, number(bushing, "filler.shortest"), number(bushing, "filler.longest")
    travels = np.geomspace(shortest, longest, count)
    sliders = 4.0 * number(bushing, "filler.stiffness") / count * travels * np.maximum(amplitude - travels, 0.0)
    order = number(bushing, "rubber.order")
    loss = number(bushing, "rubber.stiffness") * frequency**order * np.sin(order * np.pi / 2.0)
    expected = sliders.sum() + np.pi * amplitude**2 * loss
    assert area(*last_cycle(bushing, amplitude, frequency)) == pytest.approx(expected, rel=1e-2)


def test_a_bushing_softens_with_amplitude_at_a_loss_angle_that_hardly_depends_on_frequency():
    bushing = component("rubber_bushing")
    storage = [dynamic_stiffness(bushing, amplitude, 5.0).real for amplitude in (0.02e-3, 0.1e-3, 0.5e-3, 1e-3)]
    assert np.all(np.diff(storage) < 0.0) and 1.1 < storage[0] / storage[-1] < 1.5
    angles = [loss_angle(dynamic_stiffness(bushing, 0.2e-3, frequency)) for frequency in (1.0, 5.0, 25.0)]
    assert 3.0 < min(angles) and max(angles) < 8.0 and max(angles) < 1.5 * min(angles)


def fluid(spec: NetworkSpec, key: str) -> float:
    return number(spec, f"fluid.track.{key}")


def test_an_engine_mount_is_its_rubber_as_long_as_the_decoupler_is_free():
    mount, frequency = component("engine_mount"), 9.0
    rubber = RUBBER
    rubber += 2j * np.pi * frequency * number(mount, "rubber.loss.damping")
    assert dynamic_stiffness(mount, 0.95 * number(mount, "fluid.decoupler.gap"), frequency) == pytest.approx(rubber)


@pytest.mark.parametrize("frequency", [3.0, 7.0, 10.3, 18.0])
def test_an_engine_mount_without_decoupler_and_turbulence_is_the_linear_mount(frequency):
    mount = component(
        "engine_mount", fluid__decoupler__gap=1e-7, fluid__decoupler__stiffness=1e9, fluid__track__quadratic_damping=0.0
    )
    turning = 2.0 * np.pi * frequency
    walls, mass = fluid(mount, "stiffness"), fluid(mount, "fluid_mass")
    track = 1j * turning * fluid(mount, "damping") - mass * turning**2
    rubber = RUBBER + 1j * turning * number(mount, "rubber.loss.damping")
    expected = rubber + 1.0 / (1.0 / walls + 1.0 / track + 1e-9)
    assert dynamic_stiffness(mount, 2e-3, frequency) == pytest.approx(expected, rel=2e-3)


def test_an_engine_mount_has_its_notch_below_and_its_peak_near_the_resonance_of_the_track():
    mount = component("engine_mount")
    resonance = np.sqrt(fluid(mount, "stiffness") / fluid(mount, "fluid_mass")) / 2.0 / np.pi
    frequencies = np.arange(3.0, 16.1, 0.5)
    found = np.array([dynamic_stiffness(mount, 1e-3, frequency) for frequency in frequencies])
    notch, peak = frequencies[np.argmin(np.abs(found))], frequencies[np.argmax(np.abs(found))]
    steepest = frequencies[np.argmax(np.angle(found))]
    assert notch < steepest < peak and 0.35 * resonance < notch < 0.7 * resonance and abs(peak / resonance - 1.0) < 0.15
    static = RUBBER
    assert np.abs(found).min() < 0.85 * static and np.abs(found).max() > 2.5 * static
    assert 45.0 < np.degrees(np.angle(found)).max() < 90.0


def test_turbulence_lowers_the_peak_of_an_engine_mount_with_amplitude():
    mount = component("engine_mount")
    peaks = [max(abs(dynamic_stiffness(mount, amplitude, f)) for f in (9.0, 10.0, 11.0)) for amplitude in (1e-3, 3e-3)]
    assert peaks[1] < 0.9 * peaks[0]


def test_the_force_of_an_engine_mount_agrees_with_an_integration_of_its_equation_of_motion():
    mount, amplitude, frequency = component("engine_mount"), 0.8e-3, 8.0
    in_series = 1.0 / (1.0 / fluid(mount, "stiffness") + 1.0 / number(mount, "fluid.decoupler.stiffness"))
    gap, mass = number(mount, "fluid.decoupler.gap"), fluid(mount, "fluid_mass")
    sample_time, x, v = sine(amplitude, frequency, 8)
    time, turning = sample_time * np.arange(x.size), 2.0 * np.pi * frequency

    def pressed(t, place):
        left = amplitude * np.sin(turning * t) - place
        return in_series * (np.maximum(left - gap, 0.0) + np.minimum(left + gap, 0.0))

    def rates(t, state):
        place, speed = state
        resistance = fluid(mount, "damping") * speed + fluid(mount, "quadratic_damping") * abs(speed) * speed
        return [speed, (pressed(t, place) - resistance) / mass]

    truth = solve_ivp(rates, (0.0, time[-1]), [0.0, 0.0], t_eval=time, rtol=1e-9, atol=1e-12, max_step=1e-3)
    rubber = RUBBER * x + number(mount, "rubber.loss.damping") * v
    expected = rubber + pressed(time, truth.y[0])
    error = np.sqrt(np.mean((force(mount, sample_time, x, v) - expected) ** 2)) / expected.std()
    assert error < 2e-3


def test_a_strut_mount_stiffens_with_frequency_by_its_relaxation_alone():
    mount = component("strut_mount")
    found = [dynamic_stiffness(mount, 0.5e-3, frequency, 3e-3) for frequency in (1.0, 20.0)]

    def relaxation(frequency):
        turns = [2j * np.pi * frequency * number(mount, f"relaxation_{copy}.relaxation_time") for copy in (1, 2)]
        return sum(
            number(mount, f"relaxation_{copy}.stiffness") * turn / (1.0 + turn)
            for copy, turn in zip((1, 2), turns, strict=True)
        )

    # rate-independent friction and elasticity drop out of the difference
    assert found[1] - found[0] == pytest.approx(relaxation(20.0) - relaxation(1.0), rel=2e-3)
    assert 1.1 < abs(found[1]) / abs(found[0]) < 1.8
    assert all(2.0 < loss_angle(each) < 8.0 for each in found)


def valve_law(damper: NetworkSpec, side: str, speed: float) -> float:
    damping, knee, opened = (number(damper, f"valves.{side}{key}") for key in ("", "_knee", "_opened"))
    return opened * speed + (damping - opened) * speed / (1.0 + speed / knee)


@pytest.mark.parametrize("side, sign", [("compression", 1.0), ("rebound", -1.0)])
def test_a_shock_absorber_is_digressive_and_of_the_usual_size(side, sign):
    damper = component("shock_absorber")
    # at constant speed, where oil and seal have settled; the least and the largest force of dampers of cars
    usual = {
        "compression": {0.05: (60, 200), 0.13: (120, 350), 0.26: (200, 500), 0.52: (350, 800), 1.05: (550, 1300)},
        "rebound": {0.05: (100, 350), 0.13: (250, 700), 0.26: (450, 1100), 0.52: (800, 1700), 1.05: (1200, 2600)},
    }[side]
    found = {}
    for speed, (least, largest) in usual.items():
        x = sign * np.linspace(0.0, 40e-3, 401)
        whole = force(damper, 0.1e-3 / speed, x, np.full(401, sign * speed))[-1]
        gas = number(damper, "gas.force") * (1.0 - x[-1] / number(damper, "gas.length")) ** -1.3 - 31.0
        found[speed] = sign * (whole - gas) - number(damper, "friction.limit")
        assert found[speed] == pytest.approx(valve_law(damper, side, speed), rel=5e-3)
        assert least < found[speed] < largest
    assert found[1.05] / found[0.13] < 0.6 * 1.05 / 0.13


def flow(damper: NetworkSpec, pressed: float) -> float:
    """The velocity in m/s through the valves at a force in N: the root of the law, which is a quadratic equation."""
    side = "rebound" if pressed < 0.0 else "compression"
    damping, knee, opened = (number(damper, f"valves.{side}{key}") for key in ("", "_knee", "_opened"))
    linear = damping - abs(pressed) / knee
    root = np.sqrt(linear**2 + 4.0 * opened / knee * abs(pressed))
    return float(np.sign(pressed) * (root - linear) * knee / (2.0 * opened))


@pytest.mark.parametrize("frequency", [1.0, 15.0])
def test_the_oil_of_a_shock_absorber_lets_its_force_lag_behind_the_velocity(frequency):
    damper, speed = component("shock_absorber"), 0.3
    stiff, gas, column = (number(damper, path) for path in ("valves.stiffness", "gas.force", "gas.length"))
    slider, limit = number(damper, "friction.stiffness"), number(damper, "friction.limit")
    turning = 2.0 * np.pi * frequency
    sample_time, x, v = sine(speed / turning, frequency, 3)
    time = sample_time * np.arange(x.size)

    def rates(t, state):
        now = speed * np.cos(turning * t)
        return [stiff * (now - flow(damper, state[0])), slider * now * (1.0 - np.sign(now) * state[1] / limit)]

    truth = solve_ivp(rates, (0.0, time[-1]), [0.0, 0.0], "LSODA", time, rtol=1e-8, atol=1e-6, max_step=sample_time)
    expected = truth.y.sum(axis=0) + gas * (1.0 - x / column) ** -1.3 - 31.0
    settled = slice(PER_CYCLE, None)
    error = (force(damper, sample_time, x, v) - expected)[settled]
    assert np.sqrt(np.mean(error**2)) < 5e-3 * expected[settled].std()
    # where the velocity is zero the loop of force over velocity is open, the wider the faster the turn
    standing = abs(truth.y[0, PER_CYCLE + PER_CYCLE // 4]) / np.ptp(truth.y[0, settled])
    assert standing < 0.01 if frequency == 1.0 else standing > 0.03


def test_a_bump_stop_follows_its_curve_and_its_friction_and_is_not_pulled():
    stop = component("bump_stop", relaxation__stiffness=1.0)
    x = there_and_back(-5e-3, 45e-3, 5e-3, 1e-2, 2)
    found = force(stop, 1e-2, x)
    assert np.abs(found[x < 0.0]).max() < 0.021 * number(stop, "friction.limit")
    outward, limit, yielding = x.size // 2, number(stop, "friction.limit"), 1e-3
    knots = {20e-3: (550.0, 1.0), 40e-3: (2500.0, 3.0)}
    for place, (curve, share) in knots.items():
        at = int(np.argmin(np.abs(x[:outward] - place)))
        back = outward + int(np.argmin(np.abs(x[outward:] - place)))
        assert found[at] == pytest.approx(curve + share * limit, rel=5e-3)
        if x[outward - 1] - place > 8.0 * yielding:
            assert found[back] == pytest.approx(curve - share * limit, rel=5e-3)


def test_a_bump_stop_stiffens_tenfold_and_loses_a_part_of_the_work():
    stop = component("bump_stop")
    slope = [dynamic_stiffness(stop, 0.5e-3, 1.0, middle).real for middle in (5e-3, 46e-3)]
    assert slope[1] > 10.0 * slope[0]
    x = there_and_back(0.0, 45e-3, 5e-3, 1e-2, 2)
    found = force(stop, 1e-2, x)
    put_in = np.trapezoid(found[: x.size // 2], x[: x.size // 2])
    assert 0.05 < area(x, found) / put_in < 0.4


def test_a_leaf_spring_goes_over_from_envelope_to_envelope_as_fancher_says():
    spring = component("leaf_spring")
    leaves, friction = {branch.name: branch for branch in spring.leaves()}.values()
    limit = number(spring, "friction.limit")
    beta = limit / number(spring, "friction.stiffness")
    x = np.concatenate(
        [
            there_and_back(60e-3, 140e-3, 10e-3, 2e-3, 3),
            np.arange(140e-3, 134e-3, -20e-6),
            np.arange(134e-3, 138e-3, 20e-6),
        ]
    )
    mean = elastic(*table(leaves.curves["stiffness"]), x)
    # in steady motion a force that follows an envelope of slope k is short of it by k beta
    width = factor(*table(friction.scale), x) * limit + np.gradient(mean, x[1] - x[0]) * np.sign(np.gradient(x)) * beta
    expected = [mean[0]]
    for at in range(1, x.size):
        envelope = mean[at] + np.sign(x[at] - x[at - 1]) * width[at]
        expected.append(envelope + (expected[-1] - envelope) * np.exp(-abs(x[at] - x[at - 1]) / beta))
    error = np.abs(force(spring, 2e-3, x) - np.array(expected))[x.size // 4 :]
    # the half width grows: its rise over a way of beta, some 20 N, is what both laws differ by
    assert error.max() < 0.04 * limit
    assert 1e-3 < beta < 3e-3 and 0.03 < limit / 6e3 < 0.15


def test_a_tread_block_sticks_as_a_spring_in_series_and_slides_with_the_friction_of_the_road():
    block = component("tread_block")
    order, stiffness = number(block, "block.rubber.loss.order"), number(block, "block.rubber.loss.stiffness")
    rubber = number(block, "block.rubber.shear.stiffness") + stiffness * (10.0 * 1j) ** order
    stuck = 1.0 / (1.0 / rubber + 1.0 / number(block, "block.road.stiffness"))
    # a force of 1 N on a slider of 140 N: its slope has fallen by less than a hundredth
    assert dynamic_stiffness(block, 0.015e-3, 10.0) == pytest.approx(stuck, rel=1e-2)
    for speed, expected in ((1e-4, number(block, "block.road.breakaway")), (1.0, number(block, "block.road.limit"))):
        x = np.linspace(0.0, 60e-3, 3001)
        found = force(block, 20e-6 / speed, x, np.full(3001, speed))
        assert found[-1] == pytest.approx(expected, rel=1e-2)
