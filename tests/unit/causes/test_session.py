"""What changes from run to run, as runs were made one after the other: a zero, a number, a stiffness, what is warm."""

from __future__ import annotations

import numpy as np
import pytest
from unit.causes.test_promises import NETWORK, REGISTRY, SmallView

from dashpot.data.drive import drive_from_samples
from dashpot.data.history import name_of
from dashpot.kernel.eager import simulate_eagerly
from dashpot.kernel.settings import with_settings
from dashpot.model.reading import parse_network
from dashpot_causes.session import order_of

STEP = 5e-3
CURVE = "stiffness: {deflection: [-1 mm, 0 mm, 1 mm], force: [-100 N, 0 N, 300 N]}"
# strokes in mm in the order of the session: neither rising nor falling
MIXED = (2.0, 5.0, 1.0, 4.0, 2.0, 5.0, 1.0, 3.0)


class Session(SmallView):
    """Sines of some strokes, made in this order."""

    def __init__(self, strokes=MIXED, orders=None):
        super().__init__()
        time = STEP * np.arange(120)
        paths = {f"r{k}": 1e-3 * stroke * np.sin(2.0 * np.pi * 4.0 * time) for k, stroke in enumerate(strokes)}
        self.drives = {run: drive_from_samples(STEP, path) for run, path in paths.items()}
        self.orders = dict(zip(paths, orders or range(len(strokes)), strict=True))
        self.runs = tuple(paths)

    def settings(self, run):
        return {"order": float(self.orders[run])}


def suspects(word, view, text=NETWORK):
    return {each.form: each for each in REGISTRY.causes[word]().suspects(view, parse_network(text, REGISTRY.elements))}


def test_the_order_counts_from_the_first_run_that_is_there():
    assert order_of(Session(orders=range(3, 11))) == {f"r{k}": float(k) for k in range(8)}


@pytest.mark.parametrize(
    "view",
    [
        Session(tuple(range(1, 9))),
        Session(tuple(range(9, 1, -1))),
        Session(MIXED[:3]),
        SmallView(),
    ],
    ids=["rising", "falling", "few", "no order"],
)
def test_where_strokes_foretell_the_order_nothing_is_said_of_it(view):
    assert order_of(view) == {}
    assert suspects("drift", view) == {}
    assert suspects("session_change", view) == {}
    assert not [form for form in suspects("heating", view) if "run to run" in form]


class Moved(Session):
    """The same specimen, and how fast it was moved before each run."""

    def settings(self, run):
        before = [self.drives[f"r{k}"].velocity for k in range(self.orders[run])]
        squares = [STEP * float(np.sum(speed**2)) for speed in reversed(before)]
        told = {name_of("moved", k): square for k, square in enumerate(squares)}
        return {**super().settings(run), "moved": 0.0, **told}


@pytest.mark.parametrize(
    ("word", "form", "strength"),
    [
        ("heating", "a dashpot that warms up, from run to run", 250.0),
        ("heating", "a dashpot and a spring that warm up, from run to run", 250.0),
        ("softening", "softening from run to run", 4e4),
    ],
)
def test_heat_of_the_runs_before_is_written_as_its_column_shows_it(word, form, strength):
    view = Moved()
    suspect = suspects(word, view)[form]
    place = len(suspect.grid) // 2
    spec = parse_network(suspect.extend(NETWORK, [(strength, suspect.grid[place])]), REGISTRY.elements)
    for run in ("r0", "r1", "r7"):
        lanes = with_settings(spec, np.array([[slot.value.number for slot in spec.slots()]]), view.settings(run))
        added = simulate_eagerly(spec, view.drives[run], lanes)[0] - view.force(run)
        shown = strength * suspect.columns(view, run)[place]
        # the file tells numbers to six digits
        assert added == pytest.approx(shown, abs=1e-4 * np.abs(shown).max())
    assert not [form for form in suspects(word, Session()) if "run to run" in form and "numbers" not in form]


def test_a_zero_that_drifts_is_one_number_of_the_load_cell():
    view = Session(orders=range(3, 11))
    drift = suspects("drift", view)["from run to run"]
    assert [float(drift.columns(view, run)[0, 0]) for run in view.runs] == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    written = parse_network(drift.extend(NETWORK, [(-2.5, 0.0)]), REGISTRY.elements)
    offset = written.measurement["force.offset"]
    assert (offset.over.word, offset.over.at, offset.over.numbers[0].number) == ("order", (3.0,), -2.5)
    assert not offset.searched and offset.over.numbers[0].searched


def test_a_network_with_an_offset_of_its_own_keeps_it():
    assert suspects("drift", Session(), NETWORK + "measurement: {force: {offset: {start: 0 N}}}\n") == {}


def test_numbers_follow_the_order_and_beside_a_curve_a_stiffness():
    view = Session()
    plain = suspects("session_change", view)
    assert "numbers from run to run" in plain and "a stiffness from run to run" not in plain
    curved = suspects("session_change", view, NETWORK.replace("stiffness: 200 N/mm", CURVE))
    stiffness = curved["a stiffness from run to run"]
    assert stiffness.columns(view, "r7")[0] == pytest.approx(0.5 * view.displacement("r7"))
    text = stiffness.extend(NETWORK, [(-14e3, 0.0)])
    found = {slot.path: slot.value for slot in parse_network(text, REGISTRY.elements).slots()}
    assert found["setting_stiffness.stiffness.slope"].number == pytest.approx(-2e3)
    assert found["setting_stiffness.stiffness"].over.word == "order"


def test_nothing_heats_by_the_order_alone():
    """Numbers that fall from run to run, or rise, are a change over the session."""
    assert not [form for form in suspects("heating", Session()) if "run to run" in form]


def test_what_a_law_of_heat_changes_over_the_session_is_its_own():
    """Beside a dashpot that is warm of the runs before: its numbers are of the heat, all others of the session."""
    view = Moved()
    heat = suspects("heating", view)["a dashpot that warms up, from run to run"]
    text = heat.extend(NETWORK, [(250.0, heat.grid[0])])
    own = suspects("heating", view, text)["numbers of what is warm from run to run"]
    assert set(own.dependent) == {"heating.damping", "heating.power", "heating.time", "heating.share"}
    other = suspects("session_change", view, text)["numbers from run to run"]
    assert set(other.dependent) == {"stiffness.stiffness", "damping.damping"}


@pytest.mark.parametrize(("ratio", "damping", "named"), [(0.3, 40.0, True), (1.0, 40.0, False), (10.0, 300.0, False)])
def test_a_spring_that_softens_with_hardly_any_damping_is_no_heating(ratio, damping, named):
    """What goes with the heat counts: 3 % of the force at the end of the band, 50 N s/m for 2.6e5 N/m that go."""
    band = 2.0 * np.pi * Moved().highest_frequency
    stiffness = 50.0 * band / 0.03
    for form in ("a dashpot and a spring that warm up", "a dashpot and a spring that warm up, from run to run"):
        suspect = suspects("heating", Moved())[form]
        assert suspect.admits({"damping": damping, "stiffness": stiffness, "ratio": ratio}) == named
        text = suspect.extend(NETWORK, [(250.0, suspect.grid[0])])
        values = {slot.path: slot.value for slot in parse_network(text, REGISTRY.elements).slots()}
        assert values["heating.ratio"].searched and values["heating.ratio"].number == 1.0
