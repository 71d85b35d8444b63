"""Networks of two to four random elements with random numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dashpot import load_registry
from dashpot.data.drive import Drive
from dashpot.model.network import Branch, Group, NetworkSpec
from dashpot.testing import MOTIONS, draw_sizes, draw_specimens, random_drive

SAMPLES = 200


def draw_network(seed: int) -> tuple[NetworkSpec, Drive, np.ndarray]:
    """A network, a motion of its size and the values (slots,) of a lane."""
    rng = np.random.default_rng(seed)
    elements = list(load_registry().elements.values())
    sizes = draw_sizes(rng)
    branches, values = [], []
    for number in range(rng.integers(2, 5)):
        forms = draw_specimens(elements[rng.integers(len(elements))], rng, sizes, lanes=1)
        specimen = forms[rng.integers(len(forms))]
        branches.append(_named(specimen.branch, f"branch_{number}"))
        values.append(specimen.values[0])
    drive = random_drive(rng, list(MOTIONS)[rng.integers(len(MOTIONS))], sizes.length, sizes.time, SAMPLES)
    return NetworkSpec("random", Group("", "parallel", tuple(branches))), drive, np.concatenate(values)


def _named(branch: Branch, name: str) -> Branch:
    return replace(branch, name=name, family=name)
