# %% [markdown]
# # A cause of your own
#
# A linear motor holds its slider at the teeth of its magnets: the force has a part that repeats with every pole pitch
# (cogging). No built-in cause has this law. Here is a plugin of one file that does, and a diagnosis that names it.
#
# ## The law
#
# An element states the force; the framework derives the rest ([an element of your own](own_element.md)). The magnets
# store work and give it back, between two samples too: the check that a law takes up work over a cycle does not apply.

# %%
import numpy as np

import dashpot as dp


class Cogging(dp.Element):
    """A force that repeats along the stroke: F = force sin(2 pi (x - place)/pitch)."""

    word = "cogging"
    passive = False
    force = dp.Parameter("N", "amplitude of the force", bounds=(1e-3, 1e6), symbol="F_c")
    pitch = dp.Parameter("m", "distance after which the force repeats", bounds=(1e-5, 1.0), symbol="p")
    place = dp.Parameter("m", "a deflection without this force", bounds=(-0.1, 0.1), scale="linear", symbol="x_0")

    def step(self, x, z, p, dt):
        return dp.Response(p.force * np.sin(2.0 * np.pi * (x.new - p.place) / p.pitch))


# %%
from dashpot.testing import check_element

check_element(Cogging)

# %% [markdown]
# ## The cause
#
# A cause has a name, says how it shows and with what it is confused, and offers a suspect: here the element with a
# force that is solved for, on a grid of pitches and places. A grid is cheap, since only its best points are refitted.
# The cause does not decide whether it is accepted; that is the same statistics for all causes.

# %%
from itertools import product

PITCHES = (0.1, 0.14, 0.2, 0.28, 0.4)  # over the stroke
PHASES = (0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875)  # over the pitch


class MissingCogging(dp.Cause):
    """A force that repeats along the stroke."""

    word, kind, about = "cogging", "specimen", "cogging"
    shows = "a force that repeats with the deflection, alike at every speed and in both directions"
    confused_with = {"stiffness_curve": "a longer stroke: cogging repeats, a curve does not"}

    def suspects(self, view, network):
        """Pitches from a tenth of the stroke to less than half of it, and where along the pitch the force is zero."""
        waves = [(share * view.stroke, phase * share * view.stroke) for share, phase in product(PITCHES, PHASES)]
        yield dp.added_branch(
            "cogging",
            "cogging",
            tuple(float(number) for number in range(len(waves))),
            lambda force, number: {"force": force, "pitch": waves[int(number)][0], "place": waves[int(number)][1]},
            {"force": "N", "pitch": "m", "place": "m"},
            unknowns=3,
        )


# %% [markdown]
# ## A measurement with a known answer
#
# A virtual rig measures a motor with a spring, a damper and cogging of 12 N every 1.3 mm, each run twice.

# %%
from dataclasses import replace
from pathlib import Path

installed = dp.load_registry()
registry = replace(
    installed,
    elements={**installed.elements, "cogging": Cogging},
    causes={**installed.causes, "cogging": MissingCogging},
)
motor = dp.declare(
    """
format: dashpot-network/1
name: motor
branches:
  spring: {element: spring, stiffness: 20 N/mm}
  damping: {element: damper, damping: 0.3 N*s/mm}
  hidden: {element: cogging, force: 12 N, pitch: 1.3 mm, place: 0.2 mm}
""",
    registry=registry,
)
Path("bench.yaml").write_text("""
format: dashpot-rig/1
name: bench
tests:
  - {rig: hydropulser, amplitudes: [1 mm, 2 mm], preloads: [3 mm, 5 mm], direction: up, duration: 3 s, sampling: 500 Hz}
measuring: {force_noise: 1 N, repeats: 2}
""")
data = dp.measure(motor, "bench.yaml", seed=7, registry=registry)

# %% [markdown]
# ## The diagnosis

# %%
simple = dp.declare(
    """
format: dashpot-network/1
name: simple
branches:
  spring: {element: spring, stiffness: {start: 15 N/mm}}
  damping: {element: damper, damping: {start: 0.2 N*s/mm}}
"""
)
diagnosis = dp.diagnose(simple, data, registry=registry)
print(diagnosis.headline)

# %%
diagnosis.table()

# %% [markdown]
# The extended network has the hidden branch; the parameters can be compared with those of the motor.

# %%
print(diagnosis.extended.text)

# %% [markdown]
# ## A plugin of one file
#
# Both classes in a file `motors.py`, with two functions below them, are a plugin. Once it is installed, every
# command knows the element, and every diagnosis considers the cause ([a whole plugin](../../how-to/own-plugin.md)):
#
# ```text
# @dp.hookimpl
# def dashpot_elements():
#     return [Cogging]
#
#
# @dp.hookimpl
# def dashpot_causes():
#     return [MissingCogging]
# ```
#
# with a `pyproject.toml` beside it that declares the entry point:
#
# ```toml
# [project]
# name = "motors"
# version = "1.0.0"
# dependencies = ["dashpot"]
#
# [project.entry-points.dashpot]
# motors = "motors"
# ```
