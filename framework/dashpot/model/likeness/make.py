"""What two branches have to have in common to be of one structure: law, forms of curves, and what is to be found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dashpot.model.lint.law import Law
from dashpot.model.network import Branch, Characteristic, Value

REACH, STEPS, TIME = 1e-2, 60, 0.1  # m, and s of the motion by which a law is asked whether it has two equal sides
EVEN = 1e-9


@dataclass(frozen=True, order=True)
class Make:
    """One element. ``searched`` names its numbers to be found, ``curves`` the form of each curve and its knots.

    ``tied`` is true where they are those of another branch, ``turned`` where it lies the other way round and that
    matters. ``offset`` is true where its deflection has a free offset.
    """

    word: str
    curves: tuple[str, ...]
    searched: tuple[str, ...]
    tied: bool = False
    turned: bool = False
    offset: bool = False

    def describe(self, fully: bool = False) -> str:
        """The element in words."""
        if not fully:
            return self.word
        tied = f"{', '.join(self.searched)} free" + (", as those of another branch" if self.tied else "")
        parts = [*self.curves, tied if self.searched else "nothing free"]
        parts += ["a free offset"] * self.offset + ["reversed"] * self.turned
        return f"{self.word} ({'; '.join(parts)})"


def make_of(branch: Branch, offset: Value | None, turned: bool) -> Make:
    """The make of a branch that lies as the file says, or reversed in a way that matters."""
    curves = branch.characteristics()
    searched = [key for key, value in branch.values.items() if value.searched]
    searched += [f"{key}.{value.over.way} over {value.over.word}" for key, value in branch.values.items() if value.over]
    searched += [key for key, curve in curves.items() if curve.data or any(value.searched for value in curve.values)]
    return Make(
        branch.element.word,
        tuple(sorted(f"{key} {_form(curve)}" for key, curve in curves.items() if curve.form != "constant")),
        tuple(sorted(searched)),
        bool(branch.shares and searched),
        turned,
        bool(offset and offset.searched),
    )


def _form(curve: Characteristic) -> str:
    if curve.data:
        return f"from {curve.data} data"
    count = len(curve.values)
    return f"as a table of {count}" if curve.form == "table" else f"as a polynomial of degree {count}"


def is_even(branch: Branch) -> bool:
    """Whether the opposite motion gives the opposite force."""
    angle = np.linspace(0.0, 6.0, STEPS + 1)[:, None]
    dt, sides = TIME / STEPS, REACH * np.array([1.0, -1.0])
    rate = 6.0 / TIME
    force = Law.of(branch).force(
        sides * np.sin(angle) * angle,
        sides * rate * (np.sin(angle) + angle * np.cos(angle)),
        sides * rate**2 * (2.0 * np.cos(angle) - angle * np.sin(angle)),
        dt,
    )
    return bool(np.max(np.abs(force.sum(axis=1))) <= EVEN * np.max(np.abs(force)))
