"""A starting point from the measured motion of wheels: the network is fitted from the wheels on, without the tires.

Where the motion of a node is measured, what is behind it can be identified from that motion: nothing resonates, forces
are nearly linear in the numbers, and a simulation takes a tenth of the time. Noise of the motion makes the result a
little wrong, so that it is a starting point: equation error before output error (Ljung, System Identification, 1999,
section 10.5).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from dashpot.fit.coordinates import search_coordinates, with_point
from dashpot.fit.objective import Objective
from dashpot.fit.refine import refine
from dashpot.fit.scored import ScoredRun
from dashpot.fit.thinned import counted, thinned_objective
from dashpot.fit.without_tire import cut_off, wheels_behind
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec, Slot

STEPS = 12
COMPARED = 2  # parameter vectors: the network as it is, and as the wheels tell it


def begin_at_wheels(
    spec: NetworkSpec, objective: Objective, chosen: Callable[[Slot], bool], budget: int
) -> tuple[NetworkSpec, int]:
    """The network with the ``chosen`` parameters as the wheels tell them, and how many parameter vectors that cost.

    They are no more than the ``budget``.
    The network as it is where that has no lower loss, where it has no wheels, and where a run does not have the motion
    of every wheel.
    """
    wheels = wheels_behind(spec)
    runs = [_at_wheel(run, wheels) for run in objective.runs]
    scored = [run for run in runs if run is not None]
    if not wheels or len(scored) < len(runs):
        return spec, 0
    cut = cut_off(spec, wheels)
    coordinates = search_coordinates(cut, chosen)
    if not coordinates.paths or budget <= COMPARED:
        return spec, 0
    behind = Objective(compile_network(cut), scored, objective.jobs, weights=objective.shares.tolist())
    sparse = thinned_objective(behind) or behind
    found = refine(sparse, coordinates, coordinates.start, STEPS, budget=budget - COMPARED)
    told = {slot.path: slot.value for slot in with_point(cut, coordinates, found.point).slots()}
    begun = spec.with_values({path: told[path] for path in coordinates.paths})
    lanes = np.array([[slot.value.number for slot in each.slots()] for each in (spec, begun)])
    before, after = objective.losses(lanes)
    return (begun if after < before else spec), COMPARED + counted(found.evaluations, sparse, behind)


def _at_wheel(run: ScoredRun, wheels: dict[str, str]) -> ScoredRun | None:
    """The run as the wheel has it: its motion, and the force that the tire passes on."""
    motions = run.whole.motions if run.whole else {}
    if any(wheel not in motions for wheel in wheels.values()) or run.end not in wheels:
        return None
    return replace(run, drive=motions[wheels[run.end]], end=wheels[run.end])
