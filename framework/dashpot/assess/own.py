"""What the network could do itself, had its fit found the numbers: no cause is needed for that."""

from __future__ import annotations

from collections.abc import Iterator

from dashpot.assess.contest import Bench, Model, try_finding, with_numbers_of
from dashpot.assess.suspicion import Look
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError


def at_its_best(bench: Bench, look: Look) -> Model:
    """The model of a look, or a better one: astray numbers start anew, a branch as one that would be added.

    Of several branches of a kind one may have come to rest where it does nothing, far from where it is needed.
    """
    best = bench.revive(look.model, look.model.astray, look.noise)
    for start in _starts_like_an_addition(bench, look):
        other = bench.fit(look.model.declared, start, look.noise, look.model.mends, best.chi_square)
        best = min(best, other, key=lambda model: model.chi_square)
    return best


def _starts_like_an_addition(bench: Bench, look: Look) -> Iterator[NetworkSpec]:
    """For the first finding that adds branches of a kind that the network has: one of these with numbers of theirs."""
    own = {leaf.name: leaf.element.word for leaf in look.model.fitted.leaves()}
    for finding in (one for one in look.screen.findings if one.merit > look.screen.threshold):
        try:
            added = bench.added(look.model, finding)
        except InputError:
            continue
        alike = [(name, leaf.name) for leaf in added for name, word in own.items() if word == leaf.element.word]
        if alike:
            trial = try_finding(bench, look.model, finding, look.noise, look.screen.samples)
            yield from (with_numbers_of(look.model.fitted, trial.model.fitted, {old: new}) for old, new in alike)
            return
