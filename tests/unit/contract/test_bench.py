"""Bench files: procedures with options in units, and all mistakes at once."""

from __future__ import annotations

from typing import Annotated

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.contract.bench import find_bench, read_bench, shipped_benches
from dashpot.contract.options import read_options
from dashpot.contract.rig import PORT, PlannedRun, PrescribedPath, Rig
from dashpot.text.document import Document
from dashpot.text.problem import InputError

STILL = PrescribedPath(*np.zeros((3, 5)))


class Steps(Rig):
    """Stands still at several heights."""

    word = "steps"

    def __init__(self, heights: Annotated[tuple[float, ...], "m"] = (0.0,), pause: Annotated[float, "s"] = 1.0):
        self.heights, self.pause = heights, pause

    def runs(self):
        return [PlannedRun(f"h{height:g}", "hold", 0.1, {PORT: STILL}) for height in self.heights]


def bench(text):
    return read_bench(Document.parse("format: dashpot-rig/1\nname: b\n" + text, "b.yaml"), {"steps": Steps})


def test_options_are_read_in_their_units():
    made = bench(
        "tests:\n  - {rig: steps, heights: [1 mm, 2 cm], pause: 2 min}\nmeasuring: {gain: 1.002, delay: 1 ms}\n"
    )
    assert made.rigs[0].heights == (1e-3, 2e-2)
    assert made.rigs[0].pause == 120.0
    assert (made.measuring.gain, made.measuring.delay, made.measuring.repeats) == (1.002, 1e-3, 1)


def test_all_mistakes_are_told_at_once():
    with pytest.raises(InputError) as caught:
        bench(
            "tests:\n  - {rig: stops}\n  - {rig: steps, pause: 3 mm}\n  - {rig: steps, pase: 3 s}\n"
            "measuring: {side: left}\nmore: 1\n"
        )
    said = str(caught.value)
    assert all(
        part in said
        for part in ("did you mean 'steps'", "got 'mm'", "did you mean 'pause'", "hub or platform", "no key 'more'")
    )


def test_two_runs_of_one_name_are_refused():
    with pytest.raises(InputError, match="several runs are called h0"):
        bench("tests:\n  - {rig: steps}\n  - {rig: steps}\n").runs()


def test_a_list_of_plain_numbers_needs_no_unit():
    class Sized:
        def __init__(self, sizes: tuple[int, ...] = (1,)):
            self.sizes = sizes

    assert read_options(Sized, {"sizes": "3, 4"}) == {"sizes": (3, 4)}
    with pytest.raises(ValueError, match="expected a whole number, got '4.5'"):
        read_options(Sized, {"sizes": "3, 4.5"})


def test_a_bench_is_found_by_word_name_or_file(tmp_path):
    rigs = load_registry().rigs
    (tmp_path / "mine.yaml").write_text("format: dashpot-rig/1\nname: mine\ntests: [{rig: triangle, depth: 4 mm}]\n")
    assert find_bench("triangle", rigs, {"depth": "7 mm"}).rigs[0].depth == 7e-3
    assert find_bench(str(tmp_path / "mine.yaml"), rigs).rigs[0].depth == 4e-3
    with pytest.raises(ValueError, match="stand in its file"):
        find_bench(str(tmp_path / "mine.yaml"), rigs, {"depth": "7 mm"})
    with pytest.raises(InputError, match="did you mean 'triangle'"):
        find_bench("triangel", rigs)


@pytest.mark.parametrize("name", shipped_benches())
def test_every_shipped_bench_can_be_run(name):
    found = find_bench(name, load_registry().rigs)
    assert found.name == name and found.about and found.runs()
