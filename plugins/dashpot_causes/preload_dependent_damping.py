"""Damping and relaxation that change with deflection."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, branch_lines, free_name
from dashpot.model.network import Branch, NetworkSpec
from dashpot.model.patch import add_branch, add_to_branch, branch_names
from dashpot.text.quantity import pretty, pretty_all
from dashpot_causes.along_curves import damped
from dashpot_causes.factors import SMALLEST_FACTOR, at_all_places, factors_of
from dashpot_causes.stiffness_curve import hats

Array = NDArray[np.float64]
UNITS = {"stiffness": "N/m", "relaxation_time": "s"}
KNOTS = 4
TIMES = 9
SHORTEST, LONGEST = 2.0, 0.3  # relaxation times: of a sample, of a run
BOUNDS = "bounds: [0.02, 50]"
CHANGES = 0.9  # least over largest factor of a branch of its own: what changes by less does not depend on preload


class PreloadDependentDamping(Cause):
    """A force in proportion to velocity, or one that relaxes, with a factor over deflection; a damping in proportion
    to the slope of a stiffness curve.
    """

    word = "preload_dependent_damping"
    kind = "specimen"
    about = "damping that changes with preload"
    shows = "loss stiffness changes with preload; a second harmonic in phase with velocity"
    confused_with = {
        "delay": "a second amplitude at each preload; or a known steel spring: a delay stays",
        "stiffness_curve": "the phase of the second harmonic: damping shows in sin, stiffness in cos",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A factor over deflection, through few knots, on the dashpots and Maxwell branches, or on new ones."""
        knots = tuple(np.linspace(*view.reach, KNOTS))
        branches = [member for member in network.root.members if isinstance(member, Branch)]
        plain = [branch for branch in branches if branch.scale is None]
        dampers = [(branch.name, damping) for branch in plain if (damping := _straight(branch))]
        damper = _OnBranch(*dampers[0], _extend) if dampers else _extend
        sign: Literal[0, 1] = 0 if any(branch.element.word == "damper" for branch in branches) else 1
        yield _suspect(
            f"{KNOTS} knots",
            knots,
            ("damping at a knot", "N*s/m"),
            _damping,
            damper,
            sign=sign,
            admits=anyhow if dampers else changes,
        )
        relaxing = [branch for branch in plain if branch.element.word == "maxwell"]
        for family in dict.fromkeys(branch.family or branch.name for branch in relaxing):
            there = _Relaxing([_numbers(branch) for branch in relaxing if family in (branch.family, branch.name)])
            yield _suspect(
                f"{KNOTS} knots on '{family}'",
                knots,
                ("change of the factor at a knot", "1"),
                there,
                _OnBranch(family, 1.0, there.extend),
            )
        for time in np.geomspace(SHORTEST * view.dt, LONGEST * view.duration, TIMES):
            found = _Relaxing([{"stiffness": 1.0, "relaxation_time": float(time)}])
            yield _suspect(
                f"relaxation with {KNOTS} knots",
                knots,
                ("stiffness at a knot", "N/m"),
                found,
                found.extend,
                sign=1,
                unknowns=1,
                admits=changes,
                of_motion=True,
            )
        yield from damped(view, network, CHANGES)


def anyhow(numbers: Mapping[str, float]) -> bool:
    """A factor on a branch that is there is always a change."""
    return True


def changes(numbers: Mapping[str, float]) -> bool:
    """Whether the factor of a branch changes over deflection by enough to be a cause."""
    factors = [1.0, *(factor for word, factor in numbers.items() if word.startswith("scale["))]
    return min(factors) < CHANGES * max(factors)


def _suspect(
    form: str,
    knots: tuple[float, ...],
    strength: tuple[str, str],
    force: Callable[[View, str], Array],
    extend: Callable[[str, Sequence[Atom]], str],
    sign: Literal[0, 1] = 0,
    unknowns: int = 0,
    admits: Callable[[Mapping[str, float]], bool] = anyhow,
    of_motion: bool = False,
) -> Suspect:
    """The suspect that the ``force(view, run)`` of a branch has a factor over deflection.

    ``strength`` is what a strength of one is, and its SI unit.
    """

    def columns(view: View, run: str) -> Array:
        return hats(knots, view.displacement(run)) * force(view, run)

    def extended(text: str, atoms: Sequence[Atom]) -> str:
        return extend(text, at_all_places(knots, atoms))

    return Suspect(
        form,
        knots,
        columns,
        extended,
        joint=True,
        sign=sign,
        unknowns=unknowns,
        quantity=strength[0],
        unit=strength[1],
        admits=admits,
        of_motion=of_motion,
    )


def _damping(view: View, run: str) -> Array:
    return view.velocity(run)


def _straight(branch: Branch) -> float:
    """The damping of a straight dashpot, of another branch zero."""
    curve = branch.curves.get("damping") if branch.element.word == "damper" else None
    return curve.values[0].number if curve and curve.form == "constant" else 0.0


def _numbers(branch: Branch) -> dict[str, float]:
    return {key: branch.values[key].number for key in UNITS}


@dataclass(frozen=True)
class _Relaxing:
    branches: Sequence[Mapping[str, float]]

    def __call__(self, view: View, run: str) -> Array:
        return view.respond(run, "maxwell", self.branches).sum(axis=0)

    def extend(self, text: str, atoms: Sequence[Atom]) -> str:
        strengths, factors, reference = _rising_from_zero(atoms)
        values = {**self.branches[0], "stiffness": self.branches[0]["stiffness"] * strengths[reference]}
        lines = branch_lines(free_name(text, "preload_dependent_damping"), "maxwell", values, UNITS)
        return add_branch(text, "\n".join([lines, *(f"  {line}" for line in _scale_lines(atoms, factors, reference))]))


@dataclass(frozen=True)
class _OnBranch:
    """Writes a factor on a branch, of which one is ``unit``; where the branch is gone, ``instead`` writes another."""

    branch: str
    unit: float
    instead: Callable[[str, Sequence[Atom]], str]

    def __call__(self, text: str, atoms: Sequence[Atom]) -> str:
        if self.branch not in branch_names(text):
            return self.instead(text, atoms)
        factors, reference = factors_of([strength for strength, _ in atoms], self.unit)
        return add_to_branch(text, self.branch, "\n".join(_scale_lines(atoms, factors, reference)))


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    strengths, factors, reference = _rising_from_zero(atoms)
    lines = [
        f"{free_name(text, 'preload_dependent_damping')}:",
        "  element: damper",
        f"  damping: {{start: {pretty(strengths[reference], 'N*s/m', 6)}}}",
        *(f"  {line}" for line in _scale_lines(atoms, factors, reference)),
    ]
    return add_branch(text, "\n".join(lines))


def _rising_from_zero(atoms: Sequence[Atom]) -> tuple[Array, Array, int]:
    """Strengths without one below zero, the factors that they stand for, and the largest one's place."""
    strengths = np.array([strength for strength, _ in atoms])
    strengths = strengths - min(0.0, strengths.min()) + 1e-3 * np.ptp(strengths) + 1e-9
    reference = int(np.argmax(strengths))
    return strengths, np.maximum(strengths / strengths[reference], SMALLEST_FACTOR), reference


def _scale_lines(atoms: Sequence[Atom], factors: Array, reference: int) -> list[str]:
    texts = ["1" if k == reference else f"{{start: {factor:.5g}, {BOUNDS}}}" for k, factor in enumerate(factors)]
    at = ", ".join(pretty_all([place for _, place in atoms], "m", 6))
    return ["scale:", f"  deflection: [{at}]", f"  factor: [{', '.join(texts)}]"]
