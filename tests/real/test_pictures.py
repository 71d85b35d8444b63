"""Pictures of measured sets are of loops where there are any, and of the runs that a network was fitted to."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest
from real import pictures
from unit.compare.specimens import DT, run, sweep

TIME = DT * np.arange(3000)


@pytest.fixture
def drawn(tmp_path, monkeypatch):
    def draw(runs, held_out):
        forces = {each.name: np.zeros(each.time.size) for each in runs}
        monkeypatch.setattr(pictures, "simulated", lambda network, data: forces)
        setting = SimpleNamespace(dataset=SimpleNamespace(runs=runs), split=SimpleNamespace(held_out=held_out))
        return pictures.pictures(SimpleNamespace(setting=setting), tmp_path, tmp_path / "d", tmp_path / "one")

    return draw


def test_the_map_of_what_is_left_is_of_the_training_runs(drawn):
    """The last two are wrong by 2000 N, the others by 100 N."""
    runs = [
        run(f"r{k}", x, 100.0 * np.sign(np.gradient(x)) if k < 4 else np.full(x.size, 2000.0), order=k)
        for k in range(6)
        for x in [sweep((1.0 + k) * 1e-3, 0.0)]
    ]
    words, path = drawn(runs, ("r4", "r5"))[-1]
    assert "of the training runs" in words
    assert "+100 N orange" in path.read_text()


def test_random_runs_are_points_and_loops_are_lines(drawn):
    """Of random motion a piece may be closed by chance."""
    rng = np.random.default_rng(1)
    wave = 1e-3 * np.sin(2.0 * np.pi * 3.0 * TIME)
    noise = 1e-3 * np.convolve(rng.standard_normal(TIME.size), np.ones(40) / 7.0, "same")
    runs = [run("wave", wave, 2e5 * wave, "harmonic"), run("noise", noise, 2e5 * noise, "random", order=1)]
    for _, path in drawn(runs, ())[:2]:
        assert [tag for tag in re.findall("<(polyline|path)", path.read_text())] == ["polyline"] * 2 + ["path"] * 2


def test_a_stroke_and_back_is_a_loop_over_displacement_and_torn_over_velocity(drawn):
    """It begins and ends at one place, with opposite velocities."""
    x = 1e-3 * np.sin(np.pi * TIME / TIME[-1])
    (_, loop), (_, torn), _ = drawn([run(f"r{k}", x, 2e5 * x + k, "transient", order=k) for k in range(2)], ())
    assert "<polyline" in loop.read_text() and "<path" not in loop.read_text()
    assert "<path" in torn.read_text() and "<polyline" not in torn.read_text()
