"""Somebody else's package works as the built-in ones do, as soon as it is installed."""

from __future__ import annotations

import ast
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from seeds import seed_of

from dashpot import Motion

from .conftest import ROOT, Installation, install

EXAMPLE = ROOT / "tests" / "example_plugin"
THINGS = "missing_slider, soft_slider, blank_columns, random_search"
NETWORK = """\
format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: {start: 100 N/mm, bounds: [10 N/mm, 1 kN/mm]}}
  hysteresis:
    element: soft_slider
    stiffness: {start: 50 N/mm, bounds: [5 N/mm, 500 N/mm]}
    limit: {start: 30 N, bounds: [1 N, 1 kN]}
"""
RUNS = """\
format: dashpot-dataset/1
name: bench
defaults:
  channels:
    time: {column: t, unit: s}
    displacement: {column: x, unit: mm}
    force: {column: F, unit: N}
runs:
  - {name: slow, file: slow.csv, kind: quasi_static}
  - {name: fast, file: fast.csv, kind: sweep}
  - {name: faster, file: faster.csv, kind: sweep}
"""


def sliding(force: float, travel: float) -> float:
    """The force in N of a rigid slider of 20 N after a travel."""
    return 20.0 if travel > 0 else -20.0 if travel < 0 else force


def giving_way(force: float, travel: float) -> float:
    """The force in N of a slider of 30 N and 20 N/mm after a travel in mm: straight back to zero, then exponential."""
    side, stiffness, limit = (1.0 if travel > 0 else -1.0), 20.0, 30.0
    back = min(abs(travel), max(0.0, -side * force / stiffness))
    ahead = limit - (limit - side * force - stiffness * back) * np.exp(-stiffness / limit * (abs(travel) - back))
    return float(side * ahead)


@pytest.fixture(scope="session")
def with_example(installation: Installation, tmp_path_factory: pytest.TempPathFactory) -> Installation:
    """The installation with the example plugin beside it."""
    folder = tmp_path_factory.mktemp("example")
    install(installation.python, "--target", folder, EXAMPLE)
    return replace(installation, also=(folder,))


def test_the_plugin_is_listed_with_its_distribution(with_example, tmp_path):
    done = with_example.run(tmp_path, "dashpot", "list", "plugins")
    assert done.returncode == 0
    [line] = [line for line in done.stdout.splitlines() if line.startswith("example ")]
    assert "dashpot-example 0.3.0" in line and line.endswith(THINGS)


@pytest.mark.parametrize(
    "kind, word",
    [
        ("elements", "soft_slider"),
        ("optimizers", "random_search"),
        ("causes", "missing_slider"),
        ("formats", "blank_columns"),
    ],
)
def test_its_things_stand_among_the_built_in_ones(with_example, tmp_path, kind, word):
    done = with_example.run(tmp_path, "dashpot", "list", kind)
    [line] = [line for line in done.stdout.splitlines() if line.startswith(word)]
    assert "dashpot-example 0.3.0, example" in line
    assert len(done.stdout.splitlines()) > 1


def test_its_element_works_in_a_file_at_once(with_example, installation, tmp_path):
    (tmp_path / "mount.yaml").write_text(NETWORK)
    done = with_example.run(tmp_path, "dashpot", "check", "mount.yaml")
    assert done.returncode == 0, done.stderr
    without = installation.run(tmp_path, "dashpot", "check", "mount.yaml")
    assert without.returncode == 1
    assert "mount.yaml:6:14: there is no element 'soft_slider'" in without.stderr


def test_its_optimizer_identifies_its_element(with_example, tmp_path):
    (tmp_path / "mount.yaml").write_text(NETWORK)
    measure(tmp_path)
    arguments = ["fit", "mount.yaml", "dataset.yaml", "--optimizer", "random_search", "--set", "rounds=5", "-o", "out"]
    done = with_example.run(tmp_path, "dashpot", *arguments, DASHPOT_DEBUG="1")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "mount.yaml").is_file()


def test_its_cause_is_suspected_in_files_of_its_format(with_example, tmp_path):
    (tmp_path / "mount.yaml").write_text(NETWORK.partition("  hysteresis:")[0])
    measure(tmp_path, ".bench", " ", giving_way)
    done = with_example.run(tmp_path, "dashpot", "diagnose", "mount.yaml", "dataset.yaml", "-o", "out", "--json")
    assert done.returncode == 0, done.stderr
    first = json.loads(done.stdout)["causes"][0]
    assert "missing_slider" in [first["cause"], *first["indistinguishable_from"]]


def test_a_torn_file_of_its_format_is_told_by_line(with_example, tmp_path):
    measure(tmp_path, ".bench", " ")
    (tmp_path / "slow.bench").write_text("t x F\n0 1\n")
    done = with_example.run(tmp_path, "dashpot", "fit", "spring", "dataset.yaml", "-o", "out")
    assert "line 2: expected 3 numbers, got '0 1'. save the file again" in done.stderr


def test_the_allow_list_leaves_it_out(with_example, tmp_path):
    done = with_example.run(tmp_path, "dashpot", "list", "elements", DASHPOT_PLUGINS="elements")
    assert done.returncode == 0
    assert "soft_slider" not in done.stdout and "maxwell" in done.stdout


def test_when_it_breaks_it_is_named_and_the_rest_works(with_example, tmp_path):
    broken = tmp_path / "broken"
    install(with_example.python, "--target", broken, EXAMPLE)
    (broken / "dashpot_example" / "__init__.py").write_text("raise RuntimeError('out of order')\n")
    done = replace(with_example, also=(broken,)).run(tmp_path, "dashpot", "check", "kelvin_voigt")
    assert (done.returncode, done.stdout) == (0, "kelvin_voigt: good\n")
    assert done.stderr.count("\n") == 1
    assert "plugin example (dashpot-example 0.3.0)" in done.stderr


def test_its_law_is_the_published_one(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLE))
    from dashpot_example.soft_slider import SoftSlider

    seed = seed_of("test_third_party_plugin")
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    stiffness, limit = rng.uniform(1e4, 1e5), rng.uniform(10.0, 100.0)
    given = SimpleNamespace(stiffness=stiffness, limit=limit)
    force, x = 0.0, 0.0
    for travel in rng.normal(scale=2 * limit / stiffness, size=20):
        motion = Motion(x, x + travel, None, None, None)
        answer = SoftSlider().step(motion, SimpleNamespace(force=force), given, None).force
        expected = integrate_wen(stiffness, limit, force, travel)
        assert answer == pytest.approx(expected, abs=1e-8 * limit)
        force, x = float(answer), x + travel


def integrate_wen(stiffness: float, limit: float, force: float, travel: float) -> float:
    """Wen's rate equation with n = 1, beta = gamma = 1/2 over a travel; steps are short for the corner at zero."""

    def slope(_, z):
        return stiffness * (1 - (0.5 * np.sign(travel) * z + 0.5 * np.abs(z)) / limit)

    return solve_ivp(slope, (0, travel), [force], rtol=1e-11, atol=1e-11 * limit, max_step=abs(travel) / 200).y[0, -1]


def test_the_example_method_is_short_enough_to_copy():
    [method] = [
        node
        for node in ast.parse((EXAMPLE / "dashpot_example" / "random_search.py").read_text()).body
        if isinstance(node, ast.ClassDef)
    ]
    assert method.end_lineno - method.lineno + 1 < 15


def measure(folder: Path, ending: str = ".csv", between: str = ",", friction: Callable = sliding) -> None:
    """Write a small dataset: triangles of +-2 mm and the force of a spring of 100 N/mm with a hysteresis."""
    (folder / "dataset.yaml").write_text(RUNS.replace(".csv", ending))
    for name, step in (("slow", 0.05), ("fast", 0.002), ("faster", 0.001)):
        lines, last, force = [between.join("txF")], 0.0, 0.0
        for index in range(801):
            phase = (index / 200) % 4
            x = 2 * (phase if phase < 1 else 2 - phase if phase < 3 else phase - 4)
            last, force = x, friction(force, x - last)
            lines.append(between.join(map(repr, (index * step, x, 100 * x + force))))
        (folder / f"{name}{ending}").write_text("\n".join(lines) + "\n")
