"""The rules of acceptance on outcomes made up for the purpose, and how runs are cut; no measurement is needed."""

from __future__ import annotations

import numpy as np
import pytest
from real import judge, seal
from real.catalogue import SETS
from real.sets import without
from real.trial import Outcome


def made(verdict="explained", specimen=(), rig=(), base="kelvin_voigt", **changes):
    causes = [{"cause": word, "class": "specimen", "standing": "accepted"} for word in specimen]
    causes += [{"cause": word, "class": "measurement", "standing": "accepted"} for word in rig]
    given = {"told": {}, "files": {}, "faults": [], "explainable": 10.0, **changes}
    return Outcome("one", base, 0, False, verdict, causes, floor=None, seconds=1.0, megabytes=1.0, failed=None, **given)


def test_an_error_that_no_file_has_is_told():
    told = {"after.train": 2.0, "after.held_out": 3.0}
    assert judge.unlike(made(told=told, files=told)) == {}
    assert judge.unlike(made(told=told, files={**told, "after.train": 2.0 + 1e-5})) == {"after.train": (2.0, 2.00001)}
    assert judge.unlike(made(told=told, files={"after.train": 2.0})) == {"after.held_out": (3.0, None)}


def test_a_rig_is_accused_by_causes_and_by_triage_unless_its_owners_know():
    one = made(specimen=["friction"], rig=["delay", "offset"], faults=[{"kind": "lost_samples"}])
    assert judge.accused(one, ["offset"]) == ["delay", "lost_samples"]


def test_a_fault_in_a_file_accuses_the_rig_however_unsure_it_is():
    one = made(resembled=[{"cause": "clipping", "class": "measurement", "standing": "resembles"}])
    assert judge.accused(one) == ["clipping"]


@pytest.mark.parametrize(
    ("verdict", "error", "good"),
    [("explained", 11.0, True), ("explained", 11.1, False), ("unexplained", 30.0, True), ("ambiguous", 30.0, False)],
)
def test_a_file_is_near_or_the_verdict_admits(verdict, error, good):
    assert judge.near_or_admitted(made(verdict, files={"after.held_out": error})) is good


def test_being_near_and_admitting_are_told_apart():
    far, near = (made("unexplained", files={"after.held_out": error}) for error in (30.0, 10.0))
    assert [judge.near(one) for one in (far, near)] == [False, True]
    assert [judge.admitted(one) for one in (far, near, made("explained"))] == [True, True, False]


def test_without_a_held_out_figure_nothing_is_near():
    assert not judge.near_or_admitted(made())


def test_repetitions_agree_with_what_most_of_them_name():
    said = [made(specimen=names) for names in (["friction", "valve"], ["valve", "friction"], ["friction"])]
    assert judge.same_names([*said, made("failed")]) == {("one", "kelvin_voigt"): (2, 4)}


def test_a_dependence_is_the_same_where_something_follows_the_same_setting():
    def saying(title, base="kelvin_voigt"):
        cause = {"cause": "setting_dependence", "class": "specimen", "standing": "accepted"}
        one = made(base=base)
        one.causes.append({**cause, "title": f"dependence of {title}"})
        return one

    said = [saying("damping on current"), saying("friction on current"), saying("damping on pressure")]
    assert judge.same_names(said) == {("one", "kelvin_voigt"): (2, 3)}
    assert judge.same_beyond_bases([*said, saying("maxwell on current", "tire_model_1")]) == {"one": (3, 4)}


def test_what_is_only_probable_may_change():
    one, two = made(specimen=["friction", "valve"]), made(specimen=["friction"])
    assert judge.same_names([one, two]) == {("one", "kelvin_voigt"): (1, 2)}
    one.causes[1]["standing"] = "probable"
    assert judge.same_names([one, two]) == {("one", "kelvin_voigt"): (2, 2)}


def test_groups_that_never_name_anything_are_counted_by_themselves():
    """Saying nothing twice is agreement; a name that came once of two is none."""
    silent = [made(base="tire_model_1"), made(base="tire_model_1")]
    said = [made(specimen=["friction"]), made(), *silent]
    assert judge.share(judge.same_names(said)) == pytest.approx(0.75)
    assert judge.same_names(judge.naming(said)) == {("one", "kelvin_voigt"): (1, 2)}
    assert judge.naming_beyond_bases(said) == []
    valve = made(specimen=["valve"])
    assert judge.naming_beyond_bases([valve, *silent]) == [valve, *silent]


def test_a_rig_is_not_to_be_called_probably_at_fault_either():
    one = made(rig=["delay"])
    one.causes[0]["standing"] = "probable"
    assert judge.accused(one) == ["delay"]


def test_bases_agree_but_for_what_they_do_of_themselves():
    said = [made(specimen=["friction", "clearance"]), made(specimen=["clearance"], base="tire_model_1")]
    assert judge.same_beyond_bases(said) == {"one": (2, 2)}
    assert judge.share({"a": (2, 4), "b": (1, 1)}) == pytest.approx(0.6)


def test_a_repeat_whose_original_is_removed_stands_for_itself():
    entries = [{"name": "a"}, {"name": "b", "repeats": "a"}, {"name": "c", "repeats": "b"}]
    assert without(entries, {"a"}) == [{"name": "b"}, {"name": "c", "repeats": "b"}]


@pytest.mark.parametrize("name", SETS)
def test_names_are_single_and_repeats_are_there(name):
    entries = list(SETS[name].runs())
    names = [entry["name"] for entry in entries]
    assert len(set(names)) == len(names) <= 21
    assert {entry["repeats"] for entry in entries if "repeats" in entry} <= set(names)
    assert {"source", "url", "licence", "owners"} == set(SETS[name].owners)


def test_strokes_are_cut_at_the_lower_end_and_freed_of_pressure(tmp_path):
    clock = np.arange(0.0, 30e3, 13.0)
    travel = -20.0 * np.cos(2.0 * np.pi * clock / 6e3)
    travel[600] = -travel[600]  # crosses the middle and is no stroke
    friction, pressure = 5.0 * np.sign(np.sin(2.0 * np.pi * clock / 6e3)), np.full(clock.size, 3.0)
    force = friction + 1e5 * np.pi * 12.85e-3**2 * pressure
    nothing = np.zeros(clock.size)
    rows = np.stack([clock, nothing, nothing, nothing, travel, pressure, force], axis=1)
    np.savetxt(tmp_path / "record.csv", np.vstack([np.zeros((seal.START_ROWS, 7)), rows]))
    found = seal.cycles(tmp_path / "record.csv")
    assert len(found) == 3  # of those that begin and end at a lower turn within the record
    for table in found:
        time, displacement, force = table.T
        assert time[-1] == pytest.approx(6.0, abs=0.02)
        assert displacement[0] == pytest.approx(-20.0, abs=0.01)
        assert np.median(np.abs(force)) == pytest.approx(5.0, rel=1e-3)
        assert np.trapezoid(force, displacement) == pytest.approx(4 * 5.0 * 20.0, rel=0.02)
