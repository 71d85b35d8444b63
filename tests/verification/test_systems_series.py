"""Elements of every kind of non-linearity behind a rubber mount: Newton's method finds them, smaller steps agree."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from verification.systems import excitation, rms, system, times
from verification.truth.motion import smooth_motion

from dashpot import load_registry
from dashpot.kernel.solution import Status
from dashpot.kernel.system import TOLERANCE

LANES = 24
ELEMENTS = {
    "springpot": "stiffness: 100 N/mm, order: 0.2",
    "iwan": "stiffness: 100 N/mm, shortest: 0.05 mm, longest: 1 mm",
    "stribeck": "stiffness: 200 N/mm, limit: 40 N, breakaway: 60 N, stribeck_velocity: 50 mm/s",
    "bouc_wen": "stiffness: 100 N/mm, limit: 100 N, shape: 0.7, exponent: 1.5",
    "clearance": "stiffness: 150 N/mm, gap: 0.3 mm",
    "backlash": "stiffness: 150 N/mm, gap: 0.3 mm",
    "loose_friction": "limit: 60 N, stiffness: 150 N/mm, gap: 0.3 mm",
    "asymmetric_damper": "compression: 500 N*s/m, rebound: 1500 N*s/m, compression_digression: 3 s/m",
    "hydro": "fluid_mass: 5 kg, stiffness: 200 N/mm, damping: 500 N*s/m",
}
QUICK = ("springpot", "stribeck", "clearance", "backlash")
MOUNT_STIFFNESS = 80e3
MOUNT = "mount: {parallel: {k: {element: spring, stiffness: 80 N/mm}, d: {element: damper, damping: 100 N*s/m}}}"


def draws(network, rng):
    """Random numbers within their bounds."""
    values = network.start * np.exp(rng.uniform(-0.5, 0.5, (LANES, network.start.size)))
    for column, slot in zip(values.T, network.spec.slots(), strict=True):
        low, high = slot.value.sensible
        np.clip(column, low, high, out=column)
    return values


@pytest.mark.parametrize(
    "word", [pytest.param(word, marks=() if word in QUICK else pytest.mark.slow) for word in ELEMENTS]
)
def test_an_element_behind_a_mount_is_solved_and_converges(word, state):
    assert word in load_registry().elements
    seed = seed_of("test_systems_series")
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    network = system("", f"leg: {{series: {{{MOUNT}, it: {{element: {word}, {ELEMENTS[word]}}}}}}}", "")
    motion, values = smooth_motion(rng, 0.0, 3e-3), draws(network, rng)
    run = excitation(times(0.3), {network.outputs[0]: motion})
    found = {pairs: network.solve(network.prepare(run, pairs), values) for pairs in (1, 4, 16)}
    for answer in found.values():
        assert set(answer.status) == {Status.GOOD}
    finest = found[16].force[:, 0]
    size = rms(finest)
    coarse, fine = (rms(found[pairs].force[:, 0] - finest) for pairs in (1, 4))
    state(
        f"{word} behind a mount at 1 ms: {np.median(coarse / size):.1e} of the RMS force, at 1/4 ms "
        f"{np.median(fine / size):.1e}; estimate {np.median(found[1].error[:, 0] / size):.1e}"
    )
    assert np.median(coarse / size) < 2e-3
    # two halvings of a method of second order, and a third left over for corners; Newton's method stops before zero
    unsolved = MOUNT_STIFFNESS * TOLERANCE * np.ptp(run.motions[network.outputs[0]].displacement)
    assert np.median(fine) < max(np.median(coarse) / 5.0, unsolved)
    assert np.median(coarse / found[1].error[:, 0]) < 2.0
