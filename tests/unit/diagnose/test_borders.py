"""A term whose numbers leave the borders of its name."""

from types import SimpleNamespace

import pytest

from dashpot.diagnose.pursue import Pursuer
from dashpot.fit.refine import Outcome


class Term(SimpleNamespace):
    """A term that is what it is called beside the ``company`` that it needs."""

    __hash__ = object.__hash__

    def __init__(self, name, company=()):
        super().__init__(name=name, suspect=SimpleNamespace(admits=lambda present: set(company) <= set(present)))


class Refits:
    """Refits that tell each term which terms are there."""

    def writable(self, model, terms):
        """All of them."""
        return tuple(terms)

    def refit(self, model, terms, noise):
        """The model with these terms."""
        names = [term.name for term in terms]
        return SimpleNamespace(
            terms=tuple(terms), outcome=Outcome.CONVERGED, keeps_all=True, numbers_of=lambda number: names
        )


def names(former, new):
    """What stays of a structure of former terms and a new one."""
    pursuer, look = (
        Pursuer(Refits(), (), None, 0.0, 0),
        SimpleNamespace(model=SimpleNamespace(terms=former), noise=None),
    )
    terms = [*former, new]
    found = pursuer._within_borders(look, terms, Refits().refit(None, terms, None))
    return found and [term.name for term in found.terms]


def test_a_structure_within_its_borders_stays():
    assert names([Term("friction")], Term("mass")) == ["friction", "mass"]


def test_a_former_term_that_is_no_longer_what_it_is_called_goes():
    assert names([Term("resonance", ["viscous"]), Term("friction")], Term("mass")) == ["friction", "mass"]


def test_what_was_right_beside_it_alone_goes_with_it():
    assert names([Term("resonance", ["viscous"]), Term("friction", ["resonance"])], Term("mass")) == ["mass"]


@pytest.mark.parametrize("company", [["viscous"], ["resonance"]], ids=["at once", "without the former one"])
def test_a_new_term_beyond_its_borders_refuses_the_structure(company):
    assert names([Term("resonance", ["viscous"])], Term("mass", company)) is None
