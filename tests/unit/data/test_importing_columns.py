"""Which columns are displacement and force where their names do not tell, or tell it of several."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from unit.data.tables import Tables

from dashpot.data.importing.finding import find_all
from dashpot.data.importing.imported import import_files
from dashpot.data.importing.letters import beside
from dashpot.data.importing.roles import named_roles
from dashpot.data.importing.text import dataset_text
from dashpot.data.table import Table

STEP = 0.002
TIME = STEP * np.arange(3000)
SINE = np.sin(2.0 * np.pi * 1.5 * TIME)
RAMP = 25.0 + 3.0 * (1.0 - np.exp(-TIME / 20.0))


def mount(way, damping=2.0):
    """Force in N of a spring of 200 N/mm and a dashpot of `damping` N*s/mm over a way in mm."""
    return 200.0 * way + damping * np.gradient(way, STEP)


def slider(way):
    """Force in N of a friction of 20 N behind a spring of 40 N/mm: the return mapping of an elastic slider."""
    force = np.zeros(way.size)
    for number in range(1, way.size):
        force[number] = np.clip(force[number - 1] + 40.0 * (way[number] - way[number - 1]), -20.0, 20.0)
    return force


def noisy(signal, seed, share):
    return signal + share * np.std(signal) * np.random.default_rng(seed).standard_normal(signal.size)


def found_in(columns, units=None):
    """The columns of displacement and force, with their signs, and what is to be confirmed."""
    found = find_all(Table({"t": TIME, **columns}, {"t": "s", **(units or {})}))
    told = {name: (channel.role.column, channel.sign) for name, channel in found.channels.items()}
    return told.get("displacement"), told.get("force"), found.confirm


@pytest.mark.parametrize("sign", [1, -1])
def test_of_two_forces_and_a_noisy_displacement_no_force_is_the_displacement(sign):
    """The displacement has the roughest of the three signals; only over it both forces lose work and grow."""
    way = 5.0 * SINE
    columns = {"1": noisy(way, 1, 5e-3), "2": noisy(mount(way), 2, 2e-3), "3": sign * noisy(mount(way), 3, 0.1)}
    displacement, force, _ = found_in(columns)
    assert displacement == ("1", 1) and force == ("2", 1)


@pytest.mark.parametrize("law", [mount, slider])
@pytest.mark.parametrize("ramp", [RAMP, noisy(25.0 + TIME, 4, 0.01)], ids=["smooth", "noisy"])
def test_a_column_that_goes_with_the_clock_is_no_displacement(law, ramp):
    way = 5.0 * SINE
    displacement, force, _ = found_in({"1": ramp, "2": noisy(way, 1, 2e-3), "3": noisy(law(way), 2, 5e-3)})
    assert (displacement, force) == (("2", 1), ("3", 1))


def test_beside_a_named_force_the_warming_is_no_displacement_either():
    way = 5.0 * SINE
    displacement, force, _ = found_in({"AI 1": RAMP, "AI 2": noisy(way, 1, 2e-3), "Kraft": noisy(mount(way), 2, 5e-3)})
    assert (displacement, force) == (("AI 2", 1), ("Kraft", 1))


def test_a_single_slow_stroke_goes_with_the_clock_and_is_the_displacement():
    stroke = 10.0 * TIME / TIME[-1]
    displacement, force, _ = found_in({"1": stroke, "2": noisy(200.0 * stroke**1.5, 2, 2e-3)})
    assert (displacement[0], force[0]) == ("1", "2")


def test_columns_with_names_as_good_are_asked_for_even_if_one_fits_better():
    way = 5.0 * SINE
    columns = {
        "disp left": way,
        "disp right": noisy(way, 1, 0.3),
        "force upper": noisy(mount(way), 2, 1e-3),
        "force lower": noisy(mount(way), 3, 0.3),
    }
    units = {"disp left": "mm", "disp right": "mm", "force upper": "N", "force lower": "N"}
    displacement, force, confirm = found_in(columns, units)
    assert (displacement[0], force[0]) == ("disp left", "force upper")
    assert "the displacement may be 'disp right' after the names as well as 'disp left': which is it?" in confirm
    assert "the force may be 'force lower' after the names as well as 'force upper': which is it?" in confirm


def test_a_further_thermometer_is_asked_for_by_its_name():
    way = 5.0 * SINE
    columns = {"x": way, "F": mount(way), "temp 1": 20.0 + 0.0 * TIME, "temp 2": 25.0 + 0.0 * TIME}
    *_, confirm = found_in(columns, {"x": "mm", "F": "N", "temp 1": "degC", "temp 2": "degC"})
    assert "the temperature may be 'temp 2' after the names as well as 'temp 1': which is it?" in confirm


def test_a_second_column_in_millimetres_that_explains_the_force_as_well_is_asked_for():
    way = 5.0 * SINE
    columns = {"ch 1": noisy(way, 1, 0.05), "ch 2": noisy(way, 2, 0.05), "ch 3": noisy(mount(way), 3, 0.1)}
    displacement, _, confirm = found_in(columns, {"ch 1": "mm", "ch 2": "mm", "ch 3": "N"})
    other = {"ch 1": "ch 2", "ch 2": "ch 1"}[displacement[0]]
    assert any(f"'{other}' may be the displacement, too" in remark for remark in confirm)


def rubbing():
    """What a friction rig records: normal force in N, way in mm, friction in N and its volts."""
    way = 5.0 * SINE
    rate = np.gradient(way, STEP)
    friction = 12.0 * np.tanh(rate / 2.0) + 0.5 * way
    signals = {"normal": 40.0 + np.abs(np.sin(3.0 * TIME)), "way": way, "volts": friction / 100.0, "friction": friction}
    return {name: noisy(signal, seed, 1e-3) for seed, (name, signal) in enumerate(signals.items())}


@pytest.mark.parametrize("letters", ["abcd", "ABCD"])
@pytest.mark.parametrize("order", list(permutations(range(4))))
def test_letters_in_order_are_places_and_no_symbols(letters, order):
    signals = rubbing()
    names = {list(signals)[index]: letter for index, letter in zip(order, letters, strict=True)}
    columns = {names[name]: signals[name] for name in sorted(names, key=lambda name: names[name])}
    found = find_all(Table({"t": TIME, **columns}, {"t": "s"}))
    told = {channel: each.role.column for channel, each in found.channels.items()}
    assert told == {"displacement": names["way"], "force": names["friction"]}
    assert all(any(f"column '{name}' is taken for" in remark for remark in found.confirm) for name in told.values())


@pytest.mark.parametrize("letter", ["d", "u", "s", "x"])
def test_a_letter_does_not_outvote_how_the_columns_move(letter):
    """The column called as a displacement is the friction, which does not tell the way."""
    signals = rubbing()
    displacement, force, confirm = found_in({"1": signals["way"], letter: signals["friction"], "2": signals["normal"]})
    assert (displacement[0], force[0]) == ("1", letter)
    assert "column '1' is taken for the displacement by how it moves" in confirm
    assert f"the displacement may be '{letter}' after the names as well as '1': which is it?" in confirm


def test_a_letter_for_a_force_does_not_outvote_how_the_columns_move():
    signals = rubbing()
    displacement, force, confirm = found_in({"Weg": signals["way"], "f": signals["normal"], "2": signals["friction"]})
    assert (displacement[0], force[0]) == ("Weg", "2")
    assert "the force may be 'f' after the names as well as '2': which is it?" in confirm


@pytest.mark.parametrize("law", [mount, slider])
@pytest.mark.parametrize("names", [("x", "F"), ("s", "F"), ("x", "ch 1"), ("d", "ch 1")])
@pytest.mark.parametrize("share", [0.0, 0.01])
def test_letters_that_are_symbols_name_their_channels(law, names, share):
    way = 5.0 * SINE
    rate = np.gradient(way, STEP)
    columns = {"v": noisy(rate, 3, share), names[0]: noisy(way, 1, 0.1 * share), names[1]: noisy(law(way), 2, share)}
    displacement, force, confirm = found_in({**columns, "T": RAMP})
    assert (displacement[0], force[0]) == names
    assert not any(f"'{names[0]}' is taken for" in remark for remark in confirm)


def test_channels_keep_their_order_and_their_columns_beside_known_ones():
    """So that what all files have stands once; a column is one channel."""
    roles = named_roles(["a", "v", "f", "d"], {})
    assert list(beside(roles, {name: roles[name] for name in ("displacement", "force")})) == list(roles)
    swapped = {"displacement": roles["acceleration"], "force": roles["force"]}
    assert {name: role.column for name, role in beside(roles, swapped).items()} == {
        "velocity": "v",
        "force": "f",
        "displacement": "a",
    }


def imported(folder, tables):
    for name in tables:
        (folder / name).write_text("")
    return import_files([folder], {"tab": Tables(tables)})


def test_the_displacement_is_no_rival_of_the_force(tmp_path):
    """Over a spring with hardly a loss the rougher displacement is taken for the force, until other files tell."""
    way = 5.0 * SINE * TIME / TIME[-1]
    forces = {"a": slider(way), "b": 2.0 * slider(way), "c": mount(way, 0.05)}
    ways = {name: noisy(way, 1, 0.05 if name == "c" else 1e-3) for name in forces}
    tables = {
        f"{name}.tab": Table({"t": TIME, "1": ways[name], "2": noisy(force, 2, 2e-3)}, {"t": "s"})
        for name, force in forces.items()
    }
    found = imported(tmp_path, tables)
    assert [run.finding.channels["force"].role.column for run in found.runs] == ["2"] * 3
    assert not any("which is it" in remark for remark in found.confirm)
    assert "displacement: {column: 1, unit: mm}" in dataset_text(found, tmp_path, "rig").replace('"', "")
    alone = found_in({"1": ways["c"], "2": noisy(forces["c"], 2, 2e-3)})
    assert alone[0][0] == "2"


def test_pieces_of_a_file_have_the_columns_of_its_longest_one(tmp_path):
    """In a short piece at the beginning, a stroke up, two channels that follow the pressure look like a motion."""
    way = 5.0 * SINE
    whole = [way, noisy(slider(way), 2, 5e-3), noisy(slider(way), 3, 0.2)]
    up = np.linspace(0.0, 5.0, 400)
    swell = 20.0 + np.sin(np.arange(400) / 9.0)
    begin = [up, swell + 0.0 * up, noisy(swell, 4, 0.05)]
    time = np.concatenate([STEP * np.arange(400), 100.0 + TIME])
    columns = [np.concatenate(pair) for pair in zip(begin, whole, strict=True)]
    found = imported(tmp_path, {"a.tab": Table(dict(zip("t123", [time, *columns], strict=True)), {"t": "s"})})
    assert [run.finding.channels["displacement"].role.column for run in found.runs] == ["1", "1"]
