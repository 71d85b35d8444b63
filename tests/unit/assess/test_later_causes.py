"""What is asked of a later cause, and what its gain is where a held-out run has a fault of its own."""

from dataclasses import dataclass
from types import SimpleNamespace

import pytest

from dashpot.assess.court import ALL_OF_IT, LESS_FAULTS, SMALLEST_GAIN, SMALLEST_LATER_GAIN, Court
from dashpot.assess.gain import Gain

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


@dataclass(frozen=True)
class Mended:
    """A model that is known by the faults taken out of it."""

    mends: tuple[str, ...]


@pytest.mark.parametrize(("with_fault", "without", "told"), [
    (0.001, 0.05, Gain(0.05, (0.05, 0.05), LESS_FAULTS)),
    (0.001, 0.002, Gain(0.001, (0.001, 0.001))),
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
