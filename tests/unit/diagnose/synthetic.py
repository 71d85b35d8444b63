"""Looks made of random columns: residual, own numbers of no term, and a bank of candidates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import SimpleNamespace

import numpy as np
from unit.diagnose.rig import Made

from dashpot.contract.cause import Suspect
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.columns import Layout
from dashpot.diagnose.folds import Folds
from dashpot.diagnose.front import front_of
from dashpot.diagnose.look import Look
from dashpot.diagnose.odds import Odds

GROUPS, LENGTH = 6, 200


def candidates_of(words: Sequence[str], places: int, kind: str = "specimen", **suspect) -> tuple[Candidate, ...]:
    """Candidates with so many places each, their columns one behind the other."""
    found = []
    for number, word in enumerate(words):
        cause = type("Made", (Made,), {"word": word, "kind": kind})
        form = Suspect("form", tuple(np.arange(1.0, places + 1.0)), None, None, **suspect)
        found.append(Candidate(cause, form, slice(number * places, (number + 1) * places)))
    return tuple(found)


def look_of(rows: Mapping[str, np.ndarray], candidates: Sequence[Candidate]) -> Look:
    """A look at a model without numbers; ``rows`` (1 + bank, n) by group hold the residual, then the bank."""
    grams = [each @ each.T for each in rows.values()]
    bank, exact = len(grams[0]) - 1, np.array([gram[:1, :1] for gram in grams])
    base = SimpleNamespace(slots=lambda: ())
    model = SimpleNamespace(terms=(), base=base, coordinates=SimpleNamespace(paths=()), owned=(), point=np.zeros(0))
    samples = np.array([float(each.shape[1]) for each in rows.values()])
    nothing, folds = np.zeros(0, dtype=int), Folds(tuple(rows), len(rows), {})
    front = front_of(grams, sum(grams), np.zeros(0), 0, Layout(0, 0, bank), model, candidates)
    return Look(
        model,
        None,
        None,
        tuple(candidates),
        Layout(0, 0, bank),
        front,
        exact,
        samples,
        folds,
        np.ones(1 + bank),
        (),
        None,
        nothing,
        nothing,
        Odds(bank),
    )


def random_rows(bank: int, strengths: Mapping[int, float], seed: int = 0) -> dict[str, np.ndarray]:
    """Columns of unit deviation in six groups; the residual is noise and some of them, by strength."""
    rng = np.random.default_rng(seed)
    found = {}
    for group in range(GROUPS):
        columns = rng.standard_normal((bank, LENGTH))
        residual = rng.standard_normal(LENGTH) + sum(size * columns[at] for at, size in strengths.items())
        found[f"g{group}"] = np.vstack([residual, columns])
    return found
