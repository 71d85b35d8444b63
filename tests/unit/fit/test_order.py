"""Interchangeable branches stand in one order in fits, intervals and refits, whichever end a search came to."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter
from unit.fit.bench import DT, TIME, network

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network
from dashpot.fit.bootstrap import bootstrap_intervals
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.order import in_order, interchangeable, ordered
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.scored import score_run
from dashpot.kernel.network import compile_network

MAXWELL = "{{element: maxwell, stiffness: {{start: {}}}, relaxation_time: {{start: {}}}}}"
SLIDER = "{{element: dahl, stiffness: {{start: {}}}, limit: {{start: {}}}}}"


def pair(first: tuple[float, float], second: tuple[float, float], law: str = MAXWELL) -> str:
    return f"a: {law.format(*first)}\nb: {law.format(*second)}"


def numbers(spec) -> dict[str, float]:
    return {slot.path: slot.value.number for slot in spec.slots()}


def swapped(spec):
    """The network with the numbers of `a` and `b` exchanged."""
    other = {"a": "b", "b": "a"}
    values = {slot.path: slot.value for slot in spec.slots()}
    return spec.with_values(
        {
            path: replace(value, number=values[other[path[0]] + path[1:]].number)
            for path, value in values.items()
            if path[0] in other
        }
    )


@pytest.mark.parametrize(
    "declared",
    [
        pair((1e4, 0.01), (2e4, 0.1)),
        pair((1e4, 0.1), (2e4, 0.01)),
        pair((1e5, 20), (1e4, 10), SLIDER),
        pair((1e4, 10), (1e5, 20), SLIDER),
    ],
)
def test_both_ends_of_a_search_are_told_alike(declared):
    spec = network(declared)
    assert ordered(spec, swapped(spec)) == ordered(spec, spec)
    keys = [
        number["relaxation_time"] if "relaxation_time" in number else number["limit"] / number["stiffness"]
        for number in ({path[2:]: value for path, value in numbers(spec).items() if path[0] == name} for name in "ab")
    ]
    assert numbers(ordered(spec, spec)) == numbers(spec), "the file's own order stays"
    assert (keys[0] > keys[1]) == all(family.falling for family in interchangeable(spec, spec))


@pytest.mark.parametrize(
    "branches",
    [
        # told apart by bounds, by a fixed number, by the law, by standing in series, by a twin
        # elsewhere, or without a key
        "a: {element: maxwell, stiffness: {start: 1e4}, relaxation_time: {start: 0.1, bounds: [0.01, 1]}}\n"
        "b: {element: maxwell, stiffness: {start: 1e4}, relaxation_time: {start: 1, bounds: [0.1, 10]}}",
        "a: {element: maxwell, stiffness: 1e4, relaxation_time: {start: 0.1}}\n"
        "b: {element: maxwell, stiffness: 2e4, relaxation_time: {start: 0.2}}",
        f"a: {MAXWELL.format(1e4, 0.1)}\nb: {SLIDER.format(1e4, 10)}",
        "a: {element: damper, damping: {start: 1}}\nb: {element: damper, damping: {start: 2}}",
    ],
)
def test_branches_that_differ_are_not_exchanged(branches):
    spec = network(branches)
    assert interchangeable(spec, spec) == ()
    assert ordered(spec, spec) == spec


def test_lanes_are_put_in_order_one_by_one():
    spec = network(f"rubber: {{element: spring, stiffness: {{start: 1e5}}}}\n{pair((1e4, 0.01), (2e4, 0.1))}")
    paths = [slot.path for slot in spec.slots()]
    lanes = np.array([[1.0, 5.0, 0.3, 7.0, 0.2], [2.0, 5.0, 0.1, 7.0, 0.2]])
    assert paths == ["rubber.stiffness", "a.stiffness", "a.relaxation_time", "b.stiffness", "b.relaxation_time"]
    found = in_order(interchangeable(spec, spec), lanes)
    assert found.tolist() == [[1.0, 7.0, 0.2, 5.0, 0.3], [2.0, 5.0, 0.1, 7.0, 0.2]]


TRUTH = {"a": (3e4, 4e-3), "b": (6e4, 6e-2)}


def measured(seed: int) -> Dataset:
    """Two Maxwells and a spring on a random motion, by their own recursion for straight steps, with noise."""
    rng = np.random.default_rng(seed)
    found = []
    for name in ("one", "two", "three"):
        x = 1e-3 * lfilter([0.02], [1.0, -1.9, 0.92], rng.standard_normal(TIME.size))
        fine = np.interp(np.arange(0.0, TIME[-1], DT / 20), TIME, x)
        force = 1e5 * x
        for stiffness, time in TRUTH.values():
            fading = np.exp(-DT / 20 / time)
            gain = stiffness * time / (DT / 20) * (1.0 - fading)
            own = lfilter([1.0], [1.0, -fading], gain * np.diff(fine, prepend=fine[0]))
            force[: own[::20].size] += own[::20]
        channels = {"displacement": x, "force": force + 0.02 * np.std(force) * rng.standard_normal(x.size)}
        found.append(Run(name, "random", TIME, channels, group=name))
    return Dataset("bench", tuple(found))


def test_fits_from_exchanged_starts_tell_the_same_within_their_intervals():
    data, registry = measured(5), load_registry()
    branches = "rubber: {element: spring, stiffness: {start: 8e4}}\n"
    near = network(branches + pair((2e4, 1e-3), (5e4, 0.2)))
    found = fit_network(near, data, registry=registry)
    other = fit_network(network(branches + pair((5e4, 0.11), (2e4, 0.2))), data, registry=registry)
    for path, number in numbers(found.fitted).items():
        assert numbers(other.fitted)[path] == pytest.approx(number, rel=1e-3)
    truth = {"rubber.stiffness": 1e5}
    truth |= {
        f"{name}.{key}": number
        for name, pair_ in TRUTH.items()
        for key, number in zip(("stiffness", "relaxation_time"), pair_, strict=True)
    }
    for slot in found.fitted.slots():
        low, high = slot.value.interval
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        assert abs(truth[slot.path] - middle) < 2.5 * half, slot.path


def test_refits_of_a_bootstrap_stand_in_order():
    data = measured(6)
    runs = [score_run(run) for run in data.runs]
    spec = with_ranges(
        network("rubber: {element: spring, stiffness: {start: 1e5}}\n" + pair(*TRUTH.values())), natural_sizes(runs)
    )
    objective, coordinates = Objective(compile_network(spec), runs), search_coordinates(spec)
    exchanged = coordinates.of_values(np.array([slot.value.number for slot in swapped(spec).slots()]))
    groups = [(run.kind, run.name) for run in runs]
    families = interchangeable(spec, spec)
    found, other = (
        dict(
            zip(
                coordinates.paths,
                bootstrap_intervals(objective, coordinates, point, groups, 6, 1, families=families),
                strict=True,
            )
        )
        for point in (coordinates.start, exchanged)
    )
    for path, interval in found.items():
        assert other[path] == pytest.approx(interval, rel=1e-2)
    assert found["a.relaxation_time"][1] < found["b.relaxation_time"][0]
