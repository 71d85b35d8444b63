"""Groups of the same elements side by side stand in one order, as elements do: springs and dampers in series, say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.fit.bench import TIME, network

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network
from dashpot.fit.bootstrap import bootstrap_intervals
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.order import interchangeable, ordered
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.scored import score_run
from dashpot.kernel.network import compile_network

SPRING = "{{element: spring, stiffness: {{start: {}}}}}"
DAMPER = "{{element: damper, damping: {{start: {}}}}}"
MAXWELL = "{{element: maxwell, stiffness: {{start: {}}}, relaxation_time: {{start: {}}}}}"
SLIDER = "{{element: dahl, stiffness: {{start: {}}}, limit: {{start: {}}}}}"
ZENER = f"{{{{series: {{{{k: {SPRING}, d: {DAMPER}}}}}}}}}"
SPRINGS = f"{{{{series: {{{{k: {SPRING}, l: {SPRING}}}}}}}}}"
BURGERS = f"{{{{series: {{{{k: {SPRING}, p: {{{{parallel: {{{{m: {MAXWELL}, n: {MAXWELL}}}}}}}}}}}}}}}}}"


def group(name: str, law: str, *starts: float) -> str:
    return f"{name}: {law.format(*starts)}\n"


def numbers(spec) -> dict[str, float]:
    return {slot.path: slot.value.number for slot in spec.slots()}


def swapped(spec, first: str = "a", second: str = "b"):
    """The network with the numbers of two members exchanged."""
    values = {slot.path: slot.value for slot in spec.slots()}
    found = {}
    for one, two in ((first, second), (second, first)):
        own = [path for path in values if path.startswith(f"{one}.")]
        found |= {path: replace(values[path], number=values[two + path[len(one) :]].number) for path in own}
    return spec.with_values(found)


@pytest.mark.parametrize(
    "declared",
    [
        group("a", ZENER, 1e4, 100) + group("b", ZENER, 2e4, 2000),
        group("a", ZENER, 2e4, 2000) + group("b", ZENER, 1e4, 100),
        group("a", SPRINGS, 1e4, 2e4) + group("b", SPRINGS, 2e4, 1e4),
        group("a", SPRINGS, 1e4, 2e4) + group("b", SPRINGS, 1e4, 1e4),
        group("a", BURGERS, 1e4, 1e4, 0.1, 1e4, 0.2) + group("b", BURGERS, 1e4, 1e4, 0.2, 1e4, 0.3),
    ],
)
def test_both_ends_of_a_search_are_told_alike_and_the_own_order_of_the_file_stays(declared):
    spec = network(declared)
    assert numbers(ordered(spec, spec)) == numbers(spec)
    assert ordered(spec, swapped(spec)) == ordered(spec, spec)


def test_springs_and_dampers_in_series_stand_by_relaxation_time():
    # the stiffer one is the faster one
    equal = network(group("a", ZENER, 1e4, 500) + group("b", ZENER, 1e4, 500))
    found = network(group("a", ZENER, 1e4, 900) + group("b", ZENER, 4e4, 1000))
    assert numbers(ordered(equal, found)) == numbers(swapped(found))


def test_what_lies_inside_of_a_group_is_put_in_order_first():
    spec = network(group("a", BURGERS, 1e4, 1e4, 0.1, 1e4, 0.2) + group("b", BURGERS, 1e4, 1e4, 0.2, 1e4, 0.3))
    assert [family.names for family in interchangeable(spec, spec)] == [
        ("a.p.m", "a.p.n"),
        ("b.p.m", "b.p.n"),
        ("a", "b"),
    ]
    mixed = swapped(swapped(spec), "a.p.m", "a.p.n")
    assert ordered(spec, mixed) == ordered(spec, spec)


def test_groups_in_parallel_inside_of_parallel_are_no_border():
    law = f"{{{{parallel: {{{{m: {MAXWELL}, f: {SLIDER}}}}}}}}}"
    spec = network(group("a", law, 1e4, 0.1, 1e5, 10) + group("b", law, 2e4, 0.2, 1e5, 20))
    assert [family.names for family in interchangeable(spec, spec)] == [("a.m", "b.m"), ("a.f", "b.f")]
    assert ordered(spec, swapped(spec, "a.f", "b.f")) == ordered(spec, spec)


@pytest.mark.parametrize(
    "branches",
    [
        # told apart by what they are made of, by a fixed number, by bounds, by standing in series
        group("a", ZENER, 1e4, 100) + group("b", SPRINGS, 1e4, 2e4),
        group("a", ZENER, 1e4, 100)
        + "b: {series: {k: {element: spring, stiffness: 2e4}, d: {element: damper, damping: {start: 1}}}}",
        group("a", ZENER, 1e4, 100)
        + "b: {series: {k: {element: spring, stiffness: {start: 2e4, bounds: [1e4, 1e5]}}, "
        + "d: {element: damper, damping: {start: 1}}}}",
        "s: {series: {" + group("a", MAXWELL, 1e4, 0.1).strip() + ", " + group("b", MAXWELL, 1e4, 0.2).strip() + "}}",
    ],
)
def test_groups_that_differ_are_not_exchanged(branches):
    spec = network(branches)
    assert interchangeable(spec, spec) == ()


RUBBER = "rubber: {element: spring, stiffness: {start: 1e5}}\n"
# stiffness and damping of each
TRUTH = {"a": (4e4, 320.0), "b": (6e4, 9e3)}


def maxwell_force(amplitude: float, rate: float, stiffness: float, damping: float) -> np.ndarray:
    """The closed form for a sine that begins at rest."""
    time, turn = damping / stiffness, rate * damping / stiffness
    steady = np.cos(rate * TIME) + turn * np.sin(rate * TIME)
    return amplitude * stiffness * turn / (1.0 + turn**2) * (steady - np.exp(-TIME / time))


def measured(seed: int) -> Dataset:
    """A spring and two Maxwells on sines of many rates, each run with others, with noise of 2 %."""
    rng = np.random.default_rng(seed)
    found = []
    for number in range(4):
        sines = [
            (2e-3 / (1 + k), 2.0 * np.pi * rate) for k, rate in enumerate((1 + 0.1 * number) * np.geomspace(0.7, 40, 8))
        ]
        x = sum(amplitude * np.sin(rate * TIME) for amplitude, rate in sines)
        force = 1.2e5 * x + sum(maxwell_force(*sine, *pair) for sine in sines for pair in TRUTH.values())
        force = force + 0.02 * np.std(force) * rng.standard_normal(TIME.size)
        name = f"run {number}"
        found.append(Run(name, "random", TIME, {"displacement": x, "force": force}, group=name))
    return Dataset("bench", tuple(found))


@pytest.mark.parametrize("seed", [0, 2, 3])
def test_fits_from_nearly_equal_starts_have_the_same_order_for_every_seed(seed):
    # with seeds 2 and 3 the search ends with the slow one in front
    spec = network(RUBBER + group("a", ZENER, 5e4, 500) + group("b", ZENER, 5e4, 600))
    found = fit_network(spec, measured(1), seed=seed, registry=load_registry())
    slots = {slot.path: slot.value for slot in found.fitted.slots()}
    for name, pair in TRUTH.items():
        for path, number in zip((f"{name}.k.stiffness", f"{name}.d.damping"), pair, strict=True):
            low, high = slots[path].interval
            assert low < number < high, path
            assert low < slots[path].number < high, path


def test_refits_of_a_bootstrap_stand_in_order():
    runs = [score_run(run) for run in measured(2).runs]
    declared = network(RUBBER + "".join(group(name, ZENER, *pair) for name, pair in TRUTH.items()))
    spec = with_ranges(declared, natural_sizes(runs))
    objective, coordinates = Objective(compile_network(spec), runs), search_coordinates(spec)
    exchanged = coordinates.of_values(np.array(list(numbers(swapped(spec)).values())))
    groups = [(run.kind, run.name) for run in runs]
    families = interchangeable(spec, spec)
    intervals = bootstrap_intervals(objective, coordinates, exchanged, groups, 6, 1, families=families)
    found = dict(zip(coordinates.paths, intervals, strict=True))
    assert found["a.d.damping"][1] < 1e3 < found["b.d.damping"][0]
