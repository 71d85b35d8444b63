"""Numbers that no data can tell, since the force has them as a sum only: told so without noise, too."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.fit.bench import ready, runs

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.decided import decide, doubt_of
from dashpot.fit.linear import linearise
from dashpot.kernel.api import simulate_runs
from dashpot.model.reading import parse_network

ELEMENTS = load_registry()
HEAD = "format: dashpot-network/1\nname: sums\n"

# the force of every network is the same for all numbers with the same sum (of compliances for springs in series)
NETWORKS = {
    "two springs": (
        "branches:\n"
        "  one: {element: spring, stiffness: <8e4 N/m>}\n"
        "  two: {element: spring, stiffness: <4e4 N/m>}\n"
        "  oil: {element: damper, damping: <300 N*s/m>}\n",
        {"one.stiffness", "two.stiffness"},
    ),
    "a mass and an inerter to the ground": (
        "nodes: {base: driven, wall: ground, hub: {mass: <3 kg>}}\n"
        "branches:\n"
        "  leg: {element: spring, stiffness: <6e4 N/m>, between: [base, hub]}\n"
        "  oil: {element: damper, damping: <50 N*s/m>, between: [hub, wall]}\n"
        "  more: {element: inerter, inertance: <1 kg>, between: [hub, wall]}\n"
        "  back: {element: spring, stiffness: <9e4 N/m>, between: [hub, wall]}\n",
        {"hub.mass", "more.inertance"},
    ),
    "two springs before friction": (
        "nodes: {base: driven, wall: ground, hub: free}\n"
        "branches:\n"
        "  one: {element: spring, stiffness: <2e5 N/m>, between: [base, hub]}\n"
        "  two: {element: spring, stiffness: <3e5 N/m>, between: [base, hub]}\n"
        "  rub: {element: coulomb, limit: <40 N>, creep_velocity: 1 mm/s, between: [hub, wall]}\n"
        "  back: {element: spring, stiffness: <9e4 N/m>, between: [base, wall]}\n",
        {"one.stiffness", "two.stiffness"},
    ),
    "friction between two springs": (
        "nodes: {base: driven, wall: ground, low: free, high: free}\n"
        "branches:\n"
        "  one: {element: spring, stiffness: <2e5 N/m>, between: [base, low]}\n"
        "  rub: {element: coulomb, limit: <40 N>, creep_velocity: 1 mm/s, between: [low, high]}\n"
        "  two: {element: spring, stiffness: <3e5 N/m>, between: [high, wall]}\n"
        "  back: {element: spring, stiffness: <9e4 N/m>, between: [base, wall]}\n",
        {"one.stiffness", "two.stiffness"},
    ),
}
STARTS = (1.4, 0.7, 1.2, 0.8, 1.3)  # times the true numbers, one after the other


def made(body, searched):
    """The network with its true numbers, or searched from somewhere else."""
    first, *rest = body.split("<")
    parts = [part.split(">", 1) for part in rest]
    if not searched:
        return parse_network(HEAD + first + "".join(number + after for (number, after) in parts), ELEMENTS.elements)
    started = zip(parts, STARTS, strict=False)
    moved = ["{start: " + _times(number, factor) + "}" + after for (number, after), factor in started]
    return parse_network(HEAD + first + "".join(moved), ELEMENTS.elements)


def _times(number, factor):
    value, unit = number.split(" ")
    return f"{float(value) * factor:.6g} {unit}"


def simulated(body, noise):
    time = 1e-3 * np.arange(2000)
    blank = []
    for amplitude in (1e-3, 2e-3, 3e-3, 1.5e-3):
        x = amplitude * np.sin(2.0 * np.pi * (0.3 * time + 3.75 * time**2)) * np.minimum(1.0, time / 0.3)
        name = f"a{amplitude}"
        blank.append(Run(name, "sweep", time, {"displacement": x, "force": 0.0 * x}, group=name))
    forces, rng = simulate_runs(made(body, False), Dataset("sums", tuple(blank))), np.random.default_rng(0)
    filled = [
        replace(run, channels={**run.channels, "force": forces[run.name] + noise * rng.standard_normal(time.size)})
        for run in blank
    ]
    return Dataset("sums", tuple(filled))


@pytest.mark.parametrize("noise", [0.0, 0.1])
@pytest.mark.parametrize("name", NETWORKS)
def test_what_shows_as_a_sum_only_has_its_whole_range_as_interval_whatever_the_noise(name, noise):
    body, summed = NETWORKS[name]
    fit = fit_network(made(body, True), simulated(body, noise), registry=ELEMENTS)
    truth = {slot.path: slot.value.number for slot in made(body, False).slots()}
    coordinates = search_coordinates(fit.fitted)
    assert summed < set(coordinates.paths)
    for place, slot in enumerate(slot for slot in fit.fitted.slots() if slot.value.searched):
        low, high = coordinates.low[place], coordinates.high[place]
        interval = np.array(slot.value.interval)
        if slot.path in summed:
            whole = np.exp([low, high]) if coordinates.log[place] else [low, high]
            assert interval == pytest.approx(whole)
        else:
            # without noise the error of the simulation is all that is left
            assert interval[1] - interval[0] < 0.1 * truth[slot.path]
            assert interval == pytest.approx(truth[slot.path], rel=0.1)
    assert set(fit.undetermined) == summed
    assert "these data do not determine" in fit.summary()


def test_a_jacobian_is_in_doubt_by_the_bend_of_the_force_within_a_step():
    # of a number searched by logarithm a proportional force bends as the exponential does: half a step squared,
    # of which steps half as long make half
    _, objective, coordinates = ready("rubber: {element: spring, stiffness: {start: 1e5}}", runs())
    linear = linearise(objective, coordinates, coordinates.start)
    doubt = doubt_of(linear, coordinates, coordinates.start)
    step = coordinates.unit[0] / linear.factors[0]
    assert np.sqrt(doubt[0, 0] / linear.normal[0, 0]) == pytest.approx(0.25 * step, rel=1e-3)


def test_columns_that_differ_by_less_than_they_err_are_one():
    rng, size = np.random.default_rng(1), 1000
    true = rng.standard_normal((2, size)) / np.sqrt(size)
    # the first two are the same, but for what makes both inexact
    errors = 1e-3 * rng.standard_normal((2, 3, size)) / np.sqrt(size)
    columns, again = (np.stack([true[0], true[0], true[1]]) + error for error in errors)
    values, vectors = np.linalg.eigh(columns @ columns.T)
    difference = columns - again
    decided, others = decide(values, vectors, difference @ difference.T, 1e-12)
    assert decided.tolist() == [False, True, True]
    assert np.abs(others[:, 0]) == pytest.approx([np.sqrt(0.5), np.sqrt(0.5), 0.0], abs=1e-2)
    assert others[2, 0] == 0.0
    assert decide(values, vectors, 0.0 * difference @ difference.T, 1e-12)[0].all()
