"""Every block of Python on a written page is run, here or by the test of its page."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from architecture.source import ROOT
from docs.test_pages import PAGES, blocks

import dashpot as dp

HOW_TO = ROOT / "docs" / "how-to"
# run by the test of the page, and the examples of formats by test_formats
ELSEWHERE = {"explanation/accuracy.md", "how-to/campaign.md", "how-to/own-plugin.md", "how-to/own-rig.md"}
ELSEWHERE |= {"how-to/use-in-numba.md"}
HERE = {"how-to/inspection-tests.md", "how-to/own-cause.md", "how-to/own-element.md"}


def run(page: str, **names: Any) -> dict[str, Any]:
    """What the blocks of a page define, one after the other."""
    for block in blocks(HOW_TO / page, "python"):
        exec(block, names)
    return names


def test_every_page_with_python_has_a_test():
    written = {page.relative_to(ROOT / "docs").as_posix(): page for page in PAGES}
    with_python = {name for name, page in written.items() if blocks(page, "python")}
    assert {name for name in with_python if not name.startswith("formats/")} == ELSEWHERE | HERE


def test_a_metric_of_ones_own_is_the_work_of_a_loop():
    found = run("inspection-tests.md")
    turn = np.linspace(0.0, 4.0 * np.pi, 4001)
    x, force = 1e-3 * np.sin(turn), 50.0 * np.cos(turn)
    [made] = found["dashpot_metrics"]()
    loop = dp.Run("slow", "quasi_static", turn, {"displacement": x, "force": force})
    assert made().measure(loop) == pytest.approx(np.pi * 1e-3 * 50.0, rel=1e-3)


def test_a_fault_of_single_runs_has_the_shape_of_an_offset():
    [fault] = run("own-cause.md")["channel_faults"](None, None)

    class View:
        def force(self, run: str) -> np.ndarray:
            return np.zeros(7)

    assert np.array_equal(fault.shapes(View(), "a"), np.ones((1, 7)))
    assert fault.correct([3.0]).offset == 3.0


def test_the_element_of_the_example_conforms():
    from example_plugin.dashpot_example.soft_slider import SoftSlider

    run("own-element.md", SoftSlider=SoftSlider)


def test_comparing_on_a_pool_of_processes(bench, tmp_path, monkeypatch):
    (tmp_path / "my").symlink_to(bench / "mount")
    monkeypatch.chdir(tmp_path)
    [block] = [text for text in blocks(HOW_TO / "campaign.md", "python") if "ProcessPoolExecutor" in text]
    names: dict[str, Any] = {}
    exec(block, names)
    assert [row["name"] for row in names["comparison"].table().rows][:2] == ["kelvin_voigt", "gehmann"]
