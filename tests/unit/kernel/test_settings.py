"""Numbers that add up over the runs before, as the settings of a run tell of them."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.kernel.settings import at_settings, require_settings, used_settings, with_settings
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError

SESSION = {"moved": 7.0, "moved 2": 5.0, "moved 3": 11.0, "reached": 2.0, "pressure": 1e5}


def heated(word="moved", base="1 m^2/s", channel="setting"):
    text = (
        "format: dashpot-network/1\nname: warm\nbranches:\n  it:\n    element: self_heating\n    damping: 300 N*s/m\n"
        f"    power: 1 W\n    time: 1 s\n    before: {{fixed: {base}, over: {{{channel}: {word}, kept: 0.5}}}}\n"
    )
    return parse_network(text, load_registry().elements, "n.yaml")


def before(spec, settings):
    lanes = np.array([[slot.value.number for slot in spec.slots()]] * 2)
    shares = [slot.path for slot in spec.slots()].index("it.before.kept")
    lanes[1, shares] = 1.0
    return with_settings(spec, lanes, settings)[:, shares - 1].tolist()


def test_each_run_before_counts_by_what_is_left_of_it():
    assert before(heated(), SESSION) == pytest.approx([1.0 + 7.0 + 5.0 / 2.0 + 11.0 / 4.0, 24.0])
    assert before(heated(), {"moved": 7.0}) == pytest.approx([8.0, 8.0])


def test_outside_of_a_dataset_nothing_was_before():
    assert before(heated(), {}) == [1.0, 1.0]
    assert used_settings(heated(), {}) == {}


def test_all_runs_before_are_among_what_a_network_needs():
    used = used_settings(heated(), SESSION)
    assert used == {"moved": 7.0, "moved 2": 5.0, "moved 3": 11.0}
    stated = {slot.path: slot.value.number for slot in at_settings(heated(), used).slots()}
    assert stated["it.before"] == pytest.approx(1.0 + 7.0 + 5.0 / 2.0 + 11.0 / 4.0)


@pytest.mark.parametrize(("word", "channel"), [("reached", "setting"), ("pressure", "setting"), ("moved", "channel")])
def test_only_what_adds_up_over_runs_may_be_kept(word, channel):
    with pytest.raises(InputError, match="expected a setting that adds up over the runs before") as caught:
        require_settings(heated(word, channel=channel), {"first": SESSION})
    assert "write 'moved', or 'slope'" in str(caught.value) and "n.yaml:9" in str(caught.value)
