"""Every element with all of its numbers following a channel, against its own lines with the numbers of each step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from verification.systems import drive_of
from verification.truth.motion import smooth_motion

from dashpot import load_registry
from dashpot.data.excitation import Excitation
from dashpot.kernel.columns import see_samples, see_turns
from dashpot.kernel.compiler.trace import RATES, trace_branch
from dashpot.kernel.eager import EagerBranch
from dashpot.kernel.network import compile_network
from dashpot.model.element import Motion
from dashpot.model.network import Over, Value
from dashpot.testing.specimen import draw_sizes, draw_specimens

ELEMENTS = load_registry().elements
DT, SAMPLES = 2e-3, 250
TIME = DT * np.arange(SAMPLES)
SIGNAL = np.sin(9.0 * TIME) + 0.3 * np.sin(40.0 * TIME)
RATE = 0.4


def bounds_of(element, key):
    declared = element.declares
    law = declared.parameters[key] if key in declared.parameters else declared.curves[key]
    return law.bounds


def following(spec):
    """The network with every number along the channel, inside its bounds."""
    [branch] = spec.leaves()
    over = Over("signal", "rate", (0.0,), (Value(RATE, "1"),), channel=True)

    def moved(key, value):
        return replace(value, over=over, sensible=bounds_of(branch.element, key))

    values = {key: moved(key, value) for key, value in branch.values.items()}
    curves = {
        key: replace(curve, values=tuple(moved(key, value) for value in curve.values))
        for key, curve in branch.curves.items()
    }
    return replace(spec, root=replace(spec.root, members=(replace(branch, values=values, curves=curves),)))


def numbers_at(spec, values, signal):
    """By path, as they are where the channel is ``signal``."""
    found = {}
    [branch] = spec.leaves()
    for slot, number in zip(spec.slots(), values, strict=True):
        key = slot.path.removeprefix(f"{branch.name}.").partition("[")[0]
        found[slot.path] = np.clip(number * np.exp(RATE * signal), *bounds_of(branch.element, key))
    return found


def stepped(spec, values, drive, sight):
    """The force (n,): at each sample that of the element's own step, with a memory that went halfway."""
    [branch] = spec.leaves()
    samples, turns = see_samples(drive), see_turns(drive)
    halfway = np.append(SIGNAL[0], 0.5 * (SIGNAL[1:] + SIGNAL[:-1]))
    memory = SIGNAL if sight == "monotone" else halfway
    states, force, turn = EagerBranch(branch, numbers_at(spec, values, 0.0)).rest(1), np.zeros(SAMPLES), 0

    def law(signal):
        return EagerBranch(branch, {path: np.array([n]) for path, n in numbers_at(spec, values, signal).items()})

    def motion(seen, number):
        keys = {key: f"{sight}.{key}" for key in ("old", "new", *RATES)}
        return Motion(*(np.asarray(seen[name])[number] if name in seen else np.nan for name in keys.values()))

    with np.errstate(all="ignore"):
        for k in range(SAMPLES):
            while sight == "monotone" and turn < drive.turn_step.size and drive.turn_step[turn] == k:
                states = law(SIGNAL[k]).respond(motion(turns, turn), states, DT).states
                turn += 1
            x = motion(samples, k)
            force[k] = np.ravel(law(SIGNAL[k]).respond(x, states, DT).force)[0]
            states = law(memory[k]).respond(x, states, DT).states
    return force


@pytest.mark.parametrize("word", sorted(ELEMENTS))
def test_an_element_has_the_numbers_of_each_step(word):
    rng = np.random.default_rng(sum(map(ord, word)))
    sizes = draw_sizes(rng)
    drive = drive_of(smooth_motion(rng, 0.0, 2.0 * sizes.length, lowest=2.0, highest=12.0), TIME)
    specimen = draw_specimens(ELEMENTS[word], rng, sizes, lanes=1)[0]
    network = compile_network(following(specimen.spec))
    base = dict(zip([slot.path for slot in specimen.spec.slots()], specimen.values[0], strict=True))
    lane = np.array([base.get(path, RATE) for path in network.paths])
    excitation = replace(Excitation.of_drive(drive), channels={"signal": SIGNAL})
    found = network.simulate(network.prepare(excitation), lane)
    truth = stepped(specimen.spec, specimen.values[0], drive, trace_branch(network.spec.leaves()[0]).sight)
    assert np.isfinite(truth).all()
    assert found == pytest.approx(truth, abs=1e-8 * np.max(np.abs(truth)) + 1e-12)
