"""A term whose numbers leave the borders of its name, or that nothing shows any more."""

from types import SimpleNamespace

import pytest

from dashpot.diagnose.trials import Trials
from dashpot.fit.refine import Outcome


class Term(SimpleNamespace):
    """A term that is what it is called, is told and is shown beside the ``company`` that it needs for each."""

    __hash__ = object.__hash__

    def __init__(self, name, company=(), told=(), shown=()):
        super().__init__(name=name, told=set(told), shown=set(shown))
        self.admits = lambda present: set(company) <= set(present)


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


class Seen(Trials):
    """Looks that know what each term needs."""

    def scores_of(self, look, model):
        """The terms."""
        return model

    def lacking(self, seen):
        names = {term.name for term in seen.terms}
        return {one for one in seen.terms if not one.told <= names}, {
            one for one in seen.terms if not one.shown <= names
        }


def kept(former, new):
    """What stays of a structure of former terms and a new one, and what of it lacks evidence."""
    look = SimpleNamespace(model=SimpleNamespace(terms=former), noise=None)
    found = Seen(Refits(), None)._tenable(look, Refits().refit(None, [*former, new], None), {new})
    return found and ([term.name for term in found[0].terms], {term.name for term in found[1]})


def names(former, new):
    """What stays of a structure of former terms and a new one."""
    found = kept(former, new)
    return found and found[0]


def test_a_structure_within_its_borders_stays():
    assert names([Term("friction")], Term("mass")) == ["friction", "mass"]


def test_a_former_term_that_is_no_longer_what_it_is_called_goes():
    assert names([Term("resonance", ["viscous"]), Term("friction")], Term("mass")) == ["friction", "mass"]


def test_what_was_right_beside_it_alone_goes_with_it():
    assert names([Term("resonance", ["viscous"]), Term("friction", ["resonance"])], Term("mass")) == ["mass"]


@pytest.mark.parametrize("company", [["viscous"], ["resonance"]], ids=["at once", "without the former one"])
def test_a_new_term_beyond_its_borders_refuses_the_structure(company):
    assert names([Term("resonance", ["viscous"])], Term("mass", company)) is None


@pytest.mark.parametrize("lacking", [{"told": ["viscous"]}, {"shown": ["viscous"]}], ids=["not told", "not shown"])
def test_a_former_fault_of_the_rig_that_has_lost_its_evidence_goes(lacking):
    assert names([Term("mass", **lacking), Term("friction")], Term("delay")) == ["friction", "delay"]


def test_a_new_fault_without_evidence_stays_and_is_said_to_lack_it():
    assert kept([Term("friction")], Term("delay", shown=["viscous"])) == (["friction", "delay"], {"delay"})


def test_a_new_fault_that_is_not_told_refuses_the_structure():
    assert names([Term("friction")], Term("delay", told=["viscous"])) is None
