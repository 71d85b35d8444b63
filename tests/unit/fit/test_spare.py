"""Branches that a fit could do without, on data whose force is known in closed form."""

from __future__ import annotations

from dataclasses import replace
from textwrap import dedent

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import network

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network
from dashpot.fit.spare import REFIT_STEPS, OutOfReach
from dashpot.kernel.api import simulate_runs
from dashpot.model.reading import parse_network

REGISTRY = load_registry()
TIME = 1e-3 * np.arange(1500)
STIFFNESS, DAMPING, NOISE = 1.2e5, 300.0, 1.0
NEEDED = """
    rubber: {element: spring, stiffness: {start: 8e4}}
    oil: {element: damper, damping: {start: 200}}
"""
SPARE = {
    "dahl": "dahl, stiffness: {start: 1e5}, limit: {start: 20}",
    "maxwell": "maxwell, stiffness: {start: 2e4}, relaxation_time: {start: 20 ms}",
    "coulomb": "coulomb, limit: {start: 5}, creep_velocity: 1 mm/s",
    "inerter": "inerter, inertance: {start: 1 kg}",
}


def with_spare(*words):
    return NEEDED + "".join(f"    {word}: {{element: {SPARE[word]}}}\n" for word in words)


def measured(rng, more=lambda x, v, a: 0.0 * x, noise=NOISE):
    """Two sines in each of three runs; the force of a spring, a damper and of ``more``, with white noise."""
    runs = []
    for number, amplitude in enumerate((1e-3, 2e-3, 3e-3)):
        omegas, parts = 2.0 * np.pi * np.array([2.0 + number, 9.0 + 2.0 * number]), amplitude * np.array([0.7, 0.3])
        x, v, a = (
            sum(
                part * omega**order * np.sin(omega * TIME + 0.5 * np.pi * order)
                for part, omega in zip(parts, omegas, strict=True)
            )
            for order in range(3)
        )
        force = STIFFNESS * x + DAMPING * v + more(x, v, a) + noise * rng.standard_normal(TIME.size)
        channels = {"displacement": x, "velocity": v, "force": force}
        runs.append(Run(f"r{number}", "harmonic", TIME, channels, group=f"r{number}"))
    return Dataset("measured", tuple(runs))


def fitted(branches, data):
    return fit_network(network(branches), data, registry=REGISTRY)


def test_branches_that_a_specimen_does_not_have_are_told_in_all_but_a_few_of_many_measurements():
    rng = np.random.default_rng(seed_of("spare branches"))
    found = [fitted(with_spare(word), measured(rng)).spare for _ in range(6) for word in SPARE]
    # 95 % of 24 times; in less than one of 2000 sessions there are fewer than 18
    assert sum(len(spare) == 1 for spare in found) >= 18
    assert not {"rubber", "oil"} & {name for spare in found for name in spare}


def test_several_may_go_together_and_the_fit_says_so():
    found = fitted(with_spare("dahl", "maxwell"), measured(np.random.default_rng(0)))
    assert found.spare == ("dahl", "maxwell")
    sentence = "dahl and maxwell may go: without them, all else refitted, these data are explained as well"
    assert sentence in found.as_dict()["identifiability"]["may_go"]
    assert f"  {sentence}" in found.summary().splitlines()


@pytest.mark.parametrize("kilograms", [0.06, 0.2, 1.0])
def test_a_branch_that_shows_is_kept_however_small_it_is(kilograms):
    # the noise lets an inertance be known to 6 g or so: 60 g are ten standard errors
    rng = np.random.default_rng(seed_of("small branches"))
    found = fitted(with_spare("inerter"), measured(rng, lambda x, v, a: kilograms * a))
    assert found.errors_of_numbers[found.free.index("inerter.inertance")] < 0.2 * kilograms
    assert found.spare == ()


class DataAlone:
    """A refinement whose loss is that of the data."""

    def of_data(self, point, loss):
        return loss


@pytest.mark.parametrize("share, hopeless", [(0.9, True), (1.1, False)])
def test_a_refit_is_out_of_reach_if_as_many_steps_as_it_may_take_are_too_few(share, hopeless):
    total, most, gain = 100, 5000.0, 40.0
    squares = most + gain * REFIT_STEPS / share - gain * np.arange(4)
    squares[3] = most + gain * REFIT_STEPS / share - 0.5 * gain  # up again, which is further away than ever
    judge = OutOfReach(DataAlone(), total, most)
    told = [judge(np.zeros(1), float(np.sqrt(square / total))) for square in squares]
    assert told == [False, hopeless, hopeless, True]
    assert not judge(np.zeros(1), float(np.sqrt(0.99 * most / total)))  # it is there
    assert not judge(np.zeros(1), float(np.sqrt(0.995 * most / total)))


def test_of_two_that_do_the_same_one_is_told_to_go_and_not_twice():
    found = fitted(NEEDED + "    more: {element: damper, damping: {start: 100}}\n", measured(np.random.default_rng(1)))
    assert found.spare == ("more",)
    assert found.as_dict()["identifiability"]["may_go"] == [
        "more and oil do the same to these data: one in their place would do"
    ]


def test_of_two_that_do_nothing_both_are_told_to_go():
    twins = (
        "    one: {element: inerter, inertance: {start: 1 kg}}\n    two: {element: inerter, inertance: {start: 2 kg}}\n"
    )
    found = fitted(NEEDED + twins, measured(np.random.default_rng(2)))
    assert found.spare == ("one", "two")
    assert found.as_dict()["identifiability"]["may_go"] == [
        "one and two may go: without them, all else refitted, these data are explained as well"
    ]


def test_without_noise_what_shows_at_all_is_kept_and_the_rest_may_go():
    def quiet(kilograms):
        return measured(np.random.default_rng(3), lambda x, v, a: kilograms * a, noise=0.0)

    assert fitted(with_spare("maxwell"), quiet(0.0)).spare == ("maxwell",)
    assert fitted(with_spare("inerter"), quiet(1e-2)).spare == ()


@pytest.mark.parametrize("copy", ["", "  rub_behind: {same_as: rub, between: [hub, wall]}\n"])
def test_a_branch_between_inner_nodes_may_go_with_its_copies_and_one_that_holds_a_node_stays(copy):
    text = """
        nodes: {{base: driven, wall: ground, hub: {{mass: 3 kg}}}}
        branches:
          leg: {{element: spring, stiffness: {leg}, between: [base, hub]}}
          back: {{element: spring, stiffness: {back}, between: [hub, wall]}}
          oil: {{element: damper, damping: {oil}, between: [hub, wall]}}
    """
    head = "format: dashpot-network/1\nname: mass\n"
    true = parse_network(head + dedent(text.format(leg="6e4 N/m", back="9e4 N/m", oil="150 N*s/m")), REGISTRY.elements)
    rng = np.random.default_rng(4)
    blank = measured(rng, noise=0.0)
    forces = simulate_runs(true, blank)
    noisy = (forces[run.name] + NOISE * rng.standard_normal(TIME.size) for run in blank.runs)
    pairs = zip(blank.runs, noisy, strict=True)
    data = Dataset("mass", tuple(replace(run, channels=dict(run.channels, force=force)) for run, force in pairs))
    started = text.format(leg="{start: 4e4 N/m}", back="{start: 1e5 N/m}", oil="{start: 100 N*s/m}")
    more = "  rub: {element: dahl, stiffness: {start: 1e5 N/m}, limit: {start: 20 N}, between: [base, hub]}\n"
    found = fit_network(parse_network(head + dedent(started) + more + copy, REGISTRY.elements), data, registry=REGISTRY)
    assert found.spare == ("rub",)
