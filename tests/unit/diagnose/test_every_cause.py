"""Every cause is hidden as a law of its own, found, and written into files that say what is told."""

from __future__ import annotations

import pytest
from unit.diagnose.files import assert_files_hold, assert_is_in_files, diagnosed
from unit.diagnose.laws import CASES, FURTHER, faults
from unit.diagnose.rig import REGISTRY

EXCEPTIONS: dict[str, str] = {}  # causes without a law here, and why
ALWAYS = ("bedding_in", "compliant_damper", "drift", "lift_off", "setting_dependence", "valve", "viscous_damping")
TURNS = ("gain", "offset", "drift", "hum", "clipping", "delay", "moving_mass")  # faults of the rig beside a law
OF_SPECIMEN = [word for word in CASES if REGISTRY.causes[word].kind == "specimen"]
PAIRS = {law: TURNS[number % len(TURNS)] for number, law in enumerate(OF_SPECIMEN)}
# a specimen that changes over a session does not repeat a run of its beginning
PAIRS |= {"bedding_in": "hum", "heating": "delay", "session_change": "clipping", "softening": "moving_mass"}


def marked(names, always=()):
    """All of them slow but those that ``always`` run."""
    return [name if name in always else pytest.param(name, marks=pytest.mark.slow) for name in names]


def told_of(case, folder):
    """The folder of a diagnosis and what it tells, whose numbers are those of its files."""
    out = diagnosed(case.data(), folder, network=case.network, sheet=case.sheet)
    return out, assert_files_hold(folder, folder / "simulated")


def test_every_cause_has_a_law():
    built_in = {word for word, cause in REGISTRY.causes.items() if cause.__module__.startswith("dashpot_causes.")}
    assert {*CASES, *EXCEPTIONS} == built_in
    assert not CASES.keys() & EXCEPTIONS.keys()


@pytest.mark.parametrize("word", marked(CASES, ALWAYS))
def test_a_cause_is_in_files_that_say_what_is_told(word, tmp_path):
    out, told = told_of(CASES[word], tmp_path)
    assert_is_in_files(word, out, told)


@pytest.mark.slow
@pytest.mark.parametrize("name", FURTHER)
def test_other_data_show_a_cause_that_is_in_files_that_say_what_is_told(name, tmp_path):
    word, case = FURTHER[name]
    out, told = told_of(case, tmp_path)
    assert_is_in_files(word, out, told)


@pytest.mark.slow
@pytest.mark.parametrize(("law", "fault"), [pytest.param(*pair, id="+".join(pair)) for pair in PAIRS.items()])
def test_a_cause_and_a_fault_of_the_measurement_are_in_files_that_say_what_is_told(law, fault, tmp_path):
    out, told = told_of(faults(CASES[law])[fault], tmp_path)
    for word in (law, fault):
        assert_is_in_files(word, out, told)
