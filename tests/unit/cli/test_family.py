"""A family of shipped networks in the place of one."""

from __future__ import annotations

import json

import numpy as np
import pytest

import dashpot as dp
from dashpot.model import shipped
from dashpot.model.reading import read_network


@pytest.fixture
def data(tmp_path):
    """The dataset of a spring and a damper."""
    time = np.arange(0.0, 3.0, 2e-3)
    x = 1e-3 * np.sin(2.0 * np.pi * 3.0 * time) + 5e-4 * np.sin(2.0 * np.pi * 7.1 * time)
    dp.write_dataset(dp.Data.from_arrays(time, x, 1.5e5 * x + 500.0 * np.gradient(x, time), name="two"), tmp_path / "d")
    return tmp_path / "d"


@pytest.fixture
def small(tmp_path, monkeypatch):
    """Shipped networks of which two are bushings by what they call themselves, and two are in a folder."""
    head = 'format: dashpot-network/1\nname: {0}\nabout: "{1}"\nbranches:\n'
    head += "  a: {{element: spring, stiffness: {{start: 1e5}}}}\n"
    for folder, name, about in (
        ("mounts", "plain", "A bushing of rubber: a spring."),
        ("mounts", "oily", "Oily bushing: a spring and a damper."),
        ("others", "single", "A spring that is like a bushing."),
    ):
        (tmp_path / "networks" / folder).mkdir(parents=True, exist_ok=True)
        text = head.format(name, about) + "  b: {element: damper, damping: {start: 30}}\n" * (name == "oily")
        (tmp_path / "networks" / folder / f"{name}.yaml").write_text(text)
    found = {path.stem: path for path in sorted((tmp_path / "networks").glob("*/*.yaml"))}
    monkeypatch.setattr(shipped, "shipped_networks", lambda: found)


def test_bushings_and_mounts_are_families_and_a_network_is_none():
    assert {"rubber_bushing", "ubs", "eub"} == set(shipped.family_of("bushing"))
    assert {"engine_mount", "strut_mount", "ubs"} < set(shipped.family_of("mount"))
    assert shipped.family_of("mount") == shipped.family_of("mounts")
    for word in ("gehmann", "damper", "nothing", "a", "the", "a/b.yaml"):
        assert not shipped.family_of(word)


def test_a_file_comes_before_a_family(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bushing").write_text("")
    assert not shipped.family_of("bushing")


@pytest.mark.usefixtures("small")
def test_the_fit_of_a_family_compares_its_members_and_writes_each(call, data, tmp_path):
    out = tmp_path / "out"
    code, shown, told = call("fit", "bushing", str(data), "-o", str(out))
    assert code == 0 and "bushing: oily, plain" in shown + told
    found = json.loads((out / "compare.json").read_text())
    errors = {model["name"]: model["rmse"]["all"] for model in found["models"]}
    assert errors["oily"] < 0.05 * errors["plain"]
    oily = read_network(out / "oily.yaml", dp.load_registry().elements)
    numbers = {slot.path: slot.value.number for slot in oily.slots()}
    assert numbers == pytest.approx({"a.stiffness": 1.5e5, "b.damping": 500.0}, rel=0.01)
    assert (out / "report.html").exists() and not (out / "single.yaml").exists()


@pytest.mark.usefixtures("small")
def test_a_family_is_compared_beside_other_networks_each_once(call, data, tmp_path):
    code, _, _ = call("compare", "mounts", "plain", "single", str(data), "-o", str(tmp_path / "out"))
    found = json.loads((tmp_path / "out" / "compare.json").read_text())
    assert code == 0 and [model["name"] for model in found["models"]] == ["oily", "plain", "single"]


@pytest.mark.usefixtures("small")
def test_a_family_is_listed(call):
    code, out, _ = call("list", "bushing")
    assert code == 0 and [line.split()[0] for line in out.splitlines()] == ["oily", "plain"]


@pytest.mark.parametrize("option", [("--sampler", "emcee"), ("--prior", "earlier.yaml")])
def test_what_is_for_one_network_is_refused(call, tmp_path, option):
    code, _, error = call("fit", "bushing", "data", "-o", str(tmp_path / "out"), *option)
    assert code == 2 and f"{option[0]} is for a single network" in error and "rubber_bushing" in error
