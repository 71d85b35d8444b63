"""What causes write stands within the ranges of the elements for small and large, slow and fast specimens."""

import numpy as np
import pytest
from unit.causes.test_promises import REGISTRY, SIZES, STEP, SmallView

from dashpot.data.drive import drive_from_samples
from dashpot.kernel.eager import simulate_eagerly
from dashpot.model.reading import parse_network

# length, time and force over those of the usual view: 10 mm, 7 Hz and 2 kN
SCALES = {
    "a seal": (0.1, 1.0, 1e-3),
    "a small one in a slow test": (1e-2, 100.0, 1e-2),
    "a stiff mount at high frequency": (1e-2, 0.3, 1.0),
    "a bearing of a bridge in a slow test": (30.0, 300.0, 1e3),
    "a mooring line": (300.0, 10.0, 1e3),
}
POWERS = {  # of length, time and force in a unit
    "N/m": (-1, 0, 1),
    "N": (0, 0, 1),
    "N*s/m": (-1, 1, 1),
    "kg": (-1, 2, 1),
    "s": (0, 1, 0),
    "N*s^2/m^2": (-2, 2, 1),
    "1": (0, 0, 0),
    "m/N": (1, 0, -1),
    "": (0, 0, 1),
}


class ScaledView(SmallView):
    """The two sweeps of the small view by another specimen."""

    def __init__(self, length, time, force):
        super().__init__()
        self.text = f"""\
format: dashpot-network/1
name: plain
branches:
  stiffness: {{element: spring, stiffness: {200e3 * force / length} N/m}}
  damping: {{element: damper, damping: {300.0 * force * time / length} N*s/m}}
"""
        self.network = parse_network(self.text, REGISTRY.elements)
        self.drives = {
            run: drive_from_samples(STEP * time, length * drive.displacement) for run, drive in self.drives.items()
        }
        self.reach = (self.reach[0] * length, self.reach[1] * length)
        self.stroke, self.speed = self.stroke * length, self.speed * length / time
        self.dt, self.duration = STEP * time, self.duration * time
        self.highest_frequency /= time

    def step(self, run):
        return self.dt

    def moved(self, run, change):
        return simulate_eagerly(self.network, drive_from_samples(self.dt, self.displacement(run) + change))


@pytest.mark.parametrize("word", sorted(REGISTRY.causes))
@pytest.mark.parametrize("scale", SCALES)
def test_every_form_can_be_written(word, scale):
    scales = SCALES[scale]
    view = ScaledView(*scales)
    for suspect in REGISTRY.causes[word]().suspects(view, view.network):
        size = SIZES[suspect.unit] * np.prod(np.power(scales, POWERS[suspect.unit], dtype=float))
        middle = suspect.grid[len(suspect.grid) // 2]
        atoms = [(size, place) for place in suspect.grid] if suspect.joint else [(size, middle)]
        parse_network(suspect.extend(view.text, atoms), REGISTRY.elements)


@pytest.mark.parametrize("form", ["delay", "low-pass of first order"])
def test_a_delay_is_looked_for_as_long_as_the_test_is_slow(form):
    """A logger of a slow rig can be late by half a second, which no fast one is."""
    usual, slow = (ScaledView(1.0, time, 1.0) for time in (1.0, 100.0))
    found = [
        next(one for one in REGISTRY.causes["delay"]().suspects(view, view.network) if one.form == form)
        for view in (usual, slow)
    ]
    assert np.array(found[1].grid) == pytest.approx(100.0 * np.array(found[0].grid))
    late = 0.5
    strength = late if form == "delay" else 1.0
    text = found[1].extend(slow.text, [(strength, late)])
    value = next(slot.value for slot in parse_network(text, REGISTRY.elements).slots() if slot.value.searched)
    assert value.number == pytest.approx(late)
    assert value.bounds[1] > late
