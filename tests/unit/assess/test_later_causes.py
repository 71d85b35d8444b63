"""What is asked of a later cause, and what its gain is where a held-out run has a fault of its own."""

from dataclasses import dataclass
from types import SimpleNamespace

import pytest

from dashpot.assess import reasons
from dashpot.assess.court import ALL_OF_IT, LESS_FAULTS, SMALLEST_GAIN, SMALLEST_LATER_GAIN, Court
from dashpot.assess.gain import HELD_OUT, Gain
from dashpot.assess.pursuit import Pursuer

WITHIN = "explains no more than the accepted causes may be wrong by in their form"
COURT = Court(None, (), (), 0)


@pytest.mark.parametrize(("share", "explained", "least"), [
    (0.9 * ALL_OF_IT, 4e4, 6.0e-3),
    (1.1 * ALL_OF_IT, 4e4, SMALLEST_GAIN),
    (1.1 * ALL_OF_IT, 1e5, 3.5e-3),
])  # fmt: skip
def test_less_is_asked_of_a_suspect_that_explains_nearly_all_that_is_left(share, explained, least):
    """Forms may be wrong by 3 % of a fall of chi square; what one suspect explains alone counts from 0.7 % of it on."""
    look = SimpleNamespace(model=SimpleNamespace(chi_square=1e5), screen=SimpleNamespace(together=1000.0))
    found = COURT.least_later_gain(SimpleNamespace(gain=1000.0 * share), look, explained)
    assert found == pytest.approx(least, rel=0.01)


def test_no_more_is_ever_asked_than_one_per_cent():
    look = SimpleNamespace(model=SimpleNamespace(chi_square=1e5), screen=SimpleNamespace(together=1000.0))
    assert COURT.least_later_gain(SimpleNamespace(gain=10.0), look, 1e8) == SMALLEST_LATER_GAIN


@pytest.mark.parametrize(
    ("gain", "together", "form"), [(2990.0, 3000.0, ""), (2900.0, 3000.0, WITHIN), (500.0, 400.0, WITHIN)]
)
def test_what_a_single_law_explains_to_the_noise_is_no_error_of_a_form(gain, together, form):
    """A strong cause may be wrong by 5000 in its form; what is left of a form is shared out among many suspects."""
    after = SimpleNamespace(chi_square=1e5 - gain)
    finding = SimpleNamespace(candidate=SimpleNamespace(cause=SimpleNamespace(word="friction")))
    trial = SimpleNamespace(failure="", merit=gain - 20.0, gain=gain, model=after, finding=finding)
    screen = SimpleNamespace(threshold=10.0, together=together)
    look = SimpleNamespace(screen=screen, model=SimpleNamespace(chi_square=1e5))
    assert COURT.objection(trial, None, 0.03, look, 1e6) == form


@pytest.mark.parametrize(("low", "runs", "said"), [(0.06, HELD_OUT, ""), (0.04, HELD_OUT, WITHIN), (0.06, "", WITHIN)])
def test_what_makes_held_out_runs_better_by_more_than_forms_err_is_no_error_of_a_form(low, runs, said):
    """0.5 % of the fitted error beside a cause that may be wrong by as much, but clearly more of those never seen."""
    after = SimpleNamespace(chi_square=1e5 - 1000.0)
    finding = SimpleNamespace(candidate=SimpleNamespace(cause=SimpleNamespace(word="relaxation")), gain=1000.0)
    trial = SimpleNamespace(failure="", merit=980.0, gain=1000.0, model=after, finding=finding)
    screen = SimpleNamespace(threshold=10.0, together=1200.0)
    look = SimpleNamespace(screen=screen, model=SimpleNamespace(chi_square=1e5))
    assert COURT.objection(trial, Gain(0.1, (low, 0.15), runs), 0.005, look, 3e5) == said


@pytest.mark.parametrize(("chi_square", "room"), [(1.0005e5, False), (1.01e5, True), (0.9e5, True)])
def test_where_nothing_of_interest_is_left_there_is_no_room_for_another_cause(chi_square, room):
    """All suspects together leave 1e5, to first order; a model below that shows that nothing is known of it."""
    look = SimpleNamespace(floor=1e5)
    assert COURT.leaves_room(SimpleNamespace(chi_square=chi_square), look) is room


@dataclass(frozen=True)
class Mended:
    """A model that is known by the faults taken out of it."""

    mends: tuple[str, ...]


@pytest.mark.parametrize(("with_fault", "without", "told"), [
    (0.001, 0.05, Gain(0.05, (0.05, 0.05), LESS_FAULTS)),
    (0.001, 0.0014, Gain(0.001, (0.001, 0.001))),
    (0.02, 0.05, Gain(0.02, (0.02, 0.02))),
])  # fmt: skip
def test_the_fault_of_a_held_out_run_does_not_hide_a_gain(monkeypatch, with_fault, without, told):
    def gain_of(self, before, after):
        value = without if "gain of one held-out run" in before.mends and after.mends == before.mends else with_fault
        return Gain(value, (value, value))

    monkeypatch.setattr(Court, "gain_of", gain_of)
    fault = SimpleNamespace(trial=SimpleNamespace(model=Mended(("gain of one held-out run",))))
    assert COURT.gain_beside([fault], Mended(()), Mended(())) == told
    assert COURT.gain_beside([], Mended(()), Mended(())).value == with_fault


@dataclass(frozen=True)
class Seen:
    """A look that is known by its model."""

    model: str


@pytest.mark.parametrize(("local", "beside", "said"), [
    (False, 0.05, ""),
    (False, 0.001, reasons.NOT_SUPPORTED),
    (True, 0.05, reasons.NOT_SUPPORTED),
])  # fmt: skip
def test_a_cause_is_not_refused_for_the_faults_of_held_out_runs_alone(monkeypatch, local, beside, said):
    """They are looked for beside the cause, and taken out of the runs before and after it."""
    asked = []

    def faults_of_held_out(self, look, last, explained, known=()):
        asked.append((look.model, last, explained))
        return ["a fault"]

    monkeypatch.setattr(Pursuer, "faults_of_held_out", faults_of_held_out)
    refused = Gain(-0.2, (-0.3, -0.1))
    gains = {("a fault", "before", "after"): Gain(beside, (beside, beside), LESS_FAULTS)}
    court = SimpleNamespace(relevance=SMALLEST_GAIN, examine=lambda *asked: (refused, reasons.NOT_SUPPORTED),
                            gain_beside=lambda faults, before, after: gains[*faults, before, after])  # fmt: skip
    suspect = SimpleNamespace(local=local)
    trial = SimpleNamespace(
        finding=SimpleNamespace(candidate=SimpleNamespace(suspect=suspect)), model="after", gain=7.0
    )
    gain, reason = Pursuer(court, None).examine(trial, Seen("before"), 100.0)
    assert reason == said
    assert gain is (refused if said else gains["a fault", "before", "after"])
    assert asked == ([] if local else [("after", "after", 107.0)])


@pytest.mark.parametrize(("fall", "gain", "said"), [
    (0.005, -0.002, reasons.FURTHER_NOT_SUPPORTED),
    (0.005, 0.002, ""),
    (0.02, -0.002, ""),
])  # fmt: skip
def test_a_weak_further_cause_has_to_make_held_out_runs_better(monkeypatch, fall, gain, said):
    """A strong one may come in first: it may be the other one that spoils these runs."""
    monkeypatch.setattr(Court, "holds", lambda self, before, after, gain: True)
    after = 1e6 * (1.0 - fall) ** 2
    trial = SimpleNamespace(failure="", merit=1e6 - after, gain=1e6 - after, model=SimpleNamespace(chi_square=after),
                            finding=SimpleNamespace(gain=1e6 - after))  # fmt: skip
    look = SimpleNamespace(model=SimpleNamespace(chi_square=1e6), screen=SimpleNamespace(threshold=10.0, together=0.0))
    assert COURT.objection(trial, Gain(gain, (gain, gain)), fall, look, 2e4) == said
