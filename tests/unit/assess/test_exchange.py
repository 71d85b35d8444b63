"""A cause that gives way to another one beside a later cause; what was put in may let others give way in turn."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import pytest

from dashpot.assess.accepted import Accepted
from dashpot.assess.court import SHARE_OF_FORM, Effort
from dashpot.assess.revision import MOST_EXCHANGED, Revision, succeeds

EXPLAINED = 1e4


class Court:
    """Remembers what was exchanged; models and looks are of no matter here."""

    def __init__(self, looks=9):
        self.barred = []
        self.effort = Effort(most=looks)
        self.bench = SimpleNamespace(fit=lambda declared, fitted, noise, mends: mends[0].places)

    def rebuild(self, kept, model, first, noise):
        return [entry.word for entry in kept]

    def look(self, model, noise):
        return SimpleNamespace(model=model, noise=noise)

    def swap(self, entry, reason):
        self.barred.append(entry.word)


class Scripted(Revision):
    """``better`` says by (cause, others) what explains more, ``falls`` by how much it lowers chi square."""

    better, falls = {}, {}

    def fall_to(self, look):
        return EXPLAINED

    def better_than(self, entry, model, look, kept, least):
        word = self.better.get((entry.word, *model))
        return accepted(word) if word and self.falls.get(word, 20.0) > least else None


def accepted(word):
    suspect = SimpleNamespace(local=word in ("gain", "offset"))
    finding = SimpleNamespace(candidate=SimpleNamespace(suspect=suspect, name=(word, "")))
    trial = SimpleNamespace(model=word, gain=1.0 if word == "weak" else 2.0)
    return SimpleNamespace(word=word, trial=trial, finding=finding)


@pytest.fixture
def exchange(monkeypatch):
    def run(words, better, looks=9):
        monkeypatch.setattr(Scripted, "better", better)
        court = Court(looks)
        found, _ = Scripted(court, None, None).exchange([accepted(word) for word in words], court.look("last", None))
        return [entry.word for entry in found], court.barred

    return run


def test_a_search_that_is_spent_leaves_every_cause_in_its_place(exchange):
    better = {("friction", "drift"): "softening"}
    assert exchange(["friction", "drift"], better, looks=0) == (["friction", "drift"], [])


def test_an_earlier_cause_gives_way_in_its_place(exchange):
    assert exchange(["friction", "drift"], {("friction", "drift"): "softening"}) == (
        ["softening", "drift"],
        ["friction"],
    )


def test_what_explains_less_than_the_later_cause_comes_last(exchange):
    assert exchange(["friction", "drift"], {("friction", "drift"): "weak"}) == (["drift", "weak"], ["friction"])


def test_what_was_put_in_lets_the_later_one_give_way_too(exchange):
    better = {("softening", "resonance"): "relaxation", ("resonance", "relaxation"): "moving_mass"}
    assert exchange(["softening", "resonance"], better) == (["relaxation", "moving_mass"], ["softening", "resonance"])


def test_the_newest_cause_does_not_give_way(exchange):
    assert exchange(["friction", "drift"], {("drift", "friction"): "offset"}) == (["friction", "drift"], [])
    assert exchange(["friction"], {("friction",): "drift"}) == (["friction"], [])


@pytest.mark.parametrize("fall", [0.8 * SHARE_OF_FORM * EXPLAINED, 1.2 * SHARE_OF_FORM * EXPLAINED])
def test_one_of_two_of_a_kind_gives_way_only_for_more_than_a_form_may_err_by(exchange, monkeypatch, fall):
    monkeypatch.setattr(Scripted, "falls", {"friction": fall})
    found, _ = exchange(["softening", "softening"], {("softening", "softening"): "friction"})
    assert found == (["friction", "softening"] if fall > SHARE_OF_FORM * EXPLAINED else ["softening", "softening"])


def test_beside_many_causes_none_is_exchanged(exchange):
    words = [f"cause {number}" for number in range(MOST_EXCHANGED + 1)]
    assert exchange(words, {(words[0], *words[1:]): "other"}) == (words, [])


@dataclass(frozen=True)
class Fault:
    """A fault of single runs, by its runs."""

    places: tuple[str, ...]
    candidate = SimpleNamespace(suspect=SimpleNamespace(local=True))

    @property
    def atoms(self):
        return self.places

    def keeping(self, kept):
        return Fault(tuple(self.places[at] for at in kept))


class InParts(Revision):
    """What is ``missed`` when a run is left out, by the runs that stay."""

    missed = {}

    def better_than(self, entry, model, look, kept):
        word = self.missed.get(model)
        return accepted(word) if word else None


def parts(monkeypatch, places, missed):
    monkeypatch.setattr(InParts, "missed", missed)
    finding = Fault(places)
    mend = SimpleNamespace(finding=finding, keeping=lambda rest, kept: SimpleNamespace(places=rest.places))
    court = Court()
    look = court.look(SimpleNamespace(declared=None, fitted=None, mends=(mend,)), None)
    found, _ = InParts(court, None, None).part([Accepted(finding, None, 0.0, None, ())], look)
    return [getattr(entry, "word", None) or entry.finding.places for entry in found]


def test_in_one_run_only_a_fault_of_single_runs_takes_the_place(monkeypatch):
    places = ("first", "second")
    assert parts(monkeypatch, places, {("first",): "friction"}) == [places]
    assert parts(monkeypatch, places, {("first",): "gain"}) == [("first",), "gain"]


def test_a_fault_of_one_run_of_several_gives_way_to_another_cause(monkeypatch):
    assert parts(monkeypatch, ("first", "second", "third"), {("first", "third"): "gain"}) == [
        ("first", "third"),
        "gain",
    ]


def test_a_fault_that_nothing_explains_better_stays_whole(monkeypatch):
    assert parts(monkeypatch, ("first", "second"), {}) == [("first", "second")]
    assert parts(monkeypatch, ("first",), {(): "gain"}) == [("first",)]


@dataclass(frozen=True)
class Fitted:
    """A look, of which only how well its model fits counts."""

    model: SimpleNamespace
    noise = None
    screen = SimpleNamespace(samples=1000, threshold=0.0)


class Contested(Court):
    """Every finding comes down to the chi square in its name."""

    def glance(self, model, look):
        return replace(look, model=model)

    def try_out(self, finding, look):
        return trial(finding)

    def gain_of(self, before, after):
        return None

    def foresee(self, finding, look):
        return 0.0


class Single(Revision):
    """A single finding is looked at before the contest."""

    def others_than(self, entry, look, fall):
        return [named("friction", 150.0)]


def named(word, chi_square):
    suspect = SimpleNamespace(joint=False)
    return SimpleNamespace(
        chi_square=chi_square, atoms=(1.0,), candidate=SimpleNamespace(name=(word, ""), suspect=suspect)
    )


def trial(finding):
    return SimpleNamespace(finding=finding, failure="", model=fit_of(finding.chi_square))


def fit_of(chi_square, numbers=5):
    return SimpleNamespace(numbers=numbers, chi_square=chi_square)


# the logarithm of 1000 samples is 6.9: what a number costs
@pytest.mark.parametrize(("chi_square", "numbers", "does"), [
    (189.0, 5, True), (191.0, 5, False), (202.0, 4, True), (216.0, 4, True), (218.0, 4, False),
    (184.0, 6, False), (182.0, 6, True),
])  # fmt: skip
def test_what_takes_a_place_leads_or_ties_with_fewer_numbers(chi_square, numbers, does):
    assert succeeds(fit_of(chi_square, numbers), Fitted(fit_of(200.0))) is does


@pytest.mark.parametrize(
    ("winner", "instead"),
    [
        (("velocity_dependent_friction", 120.0), "velocity_dependent_friction"),
        (("velocity_dependent_friction", 195.0), "friction"),
        (("drift", 100.0), "drift"),
        (None, "friction"),
    ],
)
def test_the_best_of_all_takes_the_place_with_its_rivals(winner, instead):
    """What wins the contest has to lead; it may be the cause that was there, in more places."""
    found = named(*winner) if winner else None
    winners = [Accepted(found, trial(found), 0.0, None, ("a rival",))] if winner else []
    model = SimpleNamespace(numbers=5, chi_square=300.0)
    revision = Single(Contested(), None, lambda look, explained: winners)
    look = Fitted(SimpleNamespace(numbers=5, chi_square=200.0))
    entry = SimpleNamespace(finding=named("drift", 0.0))
    better = revision.better_than(entry, model, look, [])
    assert better.finding.candidate.name == (instead, "")
    assert better.rivals == (("a rival",) if winner and instead == winner[0] else ())


class Pruned(Court):
    """Without any of its causes a model misses by hardly more."""

    def rebuild(self, kept, model, first, noise):
        return fit_of(201.0, 4)

    def bar(self, entry, reason):
        self.barred.append((entry.word, reason))


@pytest.mark.parametrize("stands", [True, False])
def test_a_cause_is_superfluous_only_where_the_others_stay_what_they_say(monkeypatch, stands):
    """A relaxation that would have to become a dashpot does not make the dashpot superfluous."""
    monkeypatch.setattr(
        "dashpot.assess.revision.admitted", lambda trial, base, model, first=None: stands or model.numbers == 5
    )
    court, words = Pruned(), ("viscous_damping", "relaxation")
    entries = [SimpleNamespace(word=word, base=None, trial=None, finding=None) for word in words]
    look = Fitted(fit_of(200.0))
    kept, _ = Revision(court, fit_of(5000.0), None).prune(entries, look)
    assert [entry.word for entry in kept] == list(words[1:] if stands else words)
    assert bool(court.barred) is stands


@pytest.mark.parametrize(("winner", "kept", "given"), [
    ("drift", "offset", None),
    ("gain", "offset", "friction"),
    ("drift", "drift", "friction"),
])  # fmt: skip
def test_what_only_imitates_a_cause_does_not_take_its_place(winner, kept, given):
    """Friction fits a little better by its many numbers; before all others the cause that was there wins again."""
    found = named(winner, 199.0)
    winners = [Accepted(found, trial(found), 0.0, None, ())]
    revision = Single(Contested(), fit_of(900.0), lambda look, explained: winners)
    look = Fitted(SimpleNamespace(numbers=5, chi_square=200.0))
    others = [SimpleNamespace(finding=named(kept, 0.0))]
    better = revision.better_than(SimpleNamespace(finding=named("drift", 0.0)), fit_of(300.0), look, others)
    assert (better and better.finding.candidate.name[0]) == given
