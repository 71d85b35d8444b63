"""Followers of the drive and events: seldom work is done seldom, and nothing else changes."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.kernel.networks import network

from dashpot.data.drive import Drive
from dashpot.expr.node import symbol, walk
from dashpot.kernel.columns import see_samples, see_turns
from dashpot.kernel.compiler.events import find_followers, follow, split_events
from dashpot.kernel.compiler.tiers import Program, sort_tiers
from dashpot.kernel.compiler.trace import trace_network
from dashpot.kernel.eager import simulate_eagerly
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element, Parameter, Response, State
from dashpot.model.network import Branch, Group, NetworkSpec, Value
from dashpot.testing import MOTIONS, random_drive

OLD, NEW, MEMORY, FLAG = symbol("monotone.old"), symbol("monotone.new"), symbol("it|memory"), symbol("it|side")
PRANDTL = "it: {repeat: 3, element: prandtl, stiffness: 5, limit: 5}"


def program(branches: str) -> Program:
    return sort_tiers(trace_network(network(branches)))


def operations(roots) -> list[str]:
    return [node.operation for node in walk(roots)]


def test_a_state_that_reads_the_drive_alone_follows_it():
    laws = {
        "it|side": np.where(NEW < OLD, -1.0, 1.0),
        "it|memory": NEW * symbol("it.p"),
        "it|sum": symbol("it|sum") + NEW,
    }
    assert list(find_followers(laws)) == ["it|side"]


def test_a_follower_is_zero_at_rest_and_then_what_the_law_said_before():
    # two turning points in the step to sample 4
    drive = Drive(
        0.1,
        np.array([1.0, 3.0, 3.5, 2.0, 2.1]),
        np.zeros(5),
        np.zeros(5),
        np.array([2, 4, 4]),
        np.array([4.0, 2.4, 1.9]),
    )
    side = {"it|side": np.where(NEW < OLD, -1.0, 1.0)}
    samples, turns = follow(side, drive, see_samples(drive), see_turns(drive))
    assert samples["it|side"].tolist() == [0.0, 1.0, 1.0, -1.0, -1.0]
    assert turns["it|side"].tolist() == [1.0, -1.0, 1.0]


def test_an_event_becomes_a_correction():
    law = np.where(FLAG != NEW, np.log(MEMORY), MEMORY) - NEW
    (spared,), (correction,) = split_events([law], {"monotone.new", "it|side"})
    assert spared is MEMORY - NEW
    assert correction.state == "it|memory" and correction.then is np.log(MEMORY)


@pytest.mark.parametrize(
    "law",
    [
        np.where(symbol("it.p") > NEW, np.log(MEMORY), MEMORY),  # a lane decides
        np.where(NEW > OLD, 2.0 * MEMORY, MEMORY),  # nothing is saved
        np.where(NEW > OLD, np.log(MEMORY), MEMORY) + MEMORY,  # the old value is needed besides
        np.where(NEW > OLD, np.log(MEMORY), 2.0 * MEMORY),  # not the state itself
    ],
)
def test_what_is_no_event_stays_as_it_is(law):
    spared, corrections = split_events([law], {"monotone.new", "monotone.old"})
    assert spared == [law] and not corrections


def test_prandtl_elements_take_logarithms_after_turns_only_and_share_their_event():
    found = program(PRANDTL)
    assert sorted(found.followers) == ["it_1|side", "it_2|side", "it_3|side"]
    assert len(found.events) == 1
    assert sorted(found.corrections) == ["it_1|reach", "it_2|reach", "it_3|reach"]
    assert "log" not in operations(found.roots) and operations(found.roots).count("wrightomega") == 3
    assert operations(found.corrections.values()).count("log") == 3


class Jolted(Element):
    """Memories that jump at two kinds of events; the third one is read by others and must not be corrected early."""

    word = "jolted"
    size = Parameter("1", "size", bounds=(0.1, 10.0))
    first = State("1", "memory")
    second = State("1", "memory")
    third = State("1", "memory")
    quick = State("1", "whether the last step was quick")

    def step(self, x, z, p, dt):
        quick = np.where(np.abs(x.velocity_new) > 0.3, 1.0, 0.0)
        first = np.where(quick != z.quick, np.log(2.0 + np.abs(z.first + z.third)), z.first) + p.size * x.travel
        second = np.where(quick > z.quick, np.exp(-np.abs(z.second)), z.second) * 0.9 + x.travel
        third = np.where(quick < z.quick, np.exp(-np.abs(z.third)), z.third) * 0.9 + x.travel
        return Response(p.size * first + second, first=first, second=second, third=third, quick=quick)


@pytest.mark.parametrize("kind", MOTIONS)
def test_events_of_several_laws_do_not_mix(kind):
    jolted = Branch("jolted", Jolted, {"size": Value(2.0, "1")}, {})
    sliding = network("it: {element: prandtl, stiffness: 5, limit: 0.2}").leaves()[0]
    spec = NetworkSpec("n", Group("", "parallel", (sliding, jolted)))
    compiled = compile_network(spec)
    assert sorted(compiled.program.corrections) == ["it|reach", "jolted|first", "jolted|second"]
    assert len(compiled.program.events) == 3
    drive = random_drive(np.random.default_rng(seed_of("test_events")), kind, 1.0, 1.0, 300)
    expected = simulate_eagerly(spec, drive)
    assert compiled.simulate(compiled.prepare(drive)) == pytest.approx(expected, abs=1e-12 * np.ptp(expected))


def test_a_law_without_events_has_none():
    found = program("it: {element: dahl, stiffness: 5, limit: 5}")
    assert not found.followers and not found.events and not found.corrections
