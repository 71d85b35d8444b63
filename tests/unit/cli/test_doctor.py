"""Each fault of an installation is found, and what to do is said."""

from __future__ import annotations

import json
from collections.abc import Mapping
from types import SimpleNamespace

import pytest

from dashpot.cli import checkup
from dashpot.cli.checkup import Requirement
from dashpot.contract.origin import Origin, PluginFault


def states(findings) -> list[tuple[str, str]]:
    return [(finding.state, finding.what) for finding in findings]


def only(findings):
    [finding] = findings
    return finding


def have(versions: Mapping[str, str]):
    return versions.get


@pytest.mark.parametrize(
    "text, parsed",
    [
        ("numpy>=2", Requirement("numpy", ">=2", "")),
        ("plotly", Requirement("plotly", "", "")),
        ("scipy (>=1.15,<2)", Requirement("scipy", ">=1.15,<2", "")),
        ('h5py>=3.11; extra == "matlab73"', Requirement("h5py", ">=3.11", "matlab73")),
        ("dashpot[docs]; extra == 'dev'", Requirement("dashpot", "", "dev")),
    ],
)
def test_requirements_are_read_as_metadata_writes_them(text, parsed):
    assert Requirement.of(text) == parsed


@pytest.mark.parametrize(
    "wanted, version, met",
    [
        (">=2", "2.0", True),
        (">=2", "1.99.9", False),
        (">=1.15", "1.9", False),
        (">=1.2.0", "1.2", True),
        (">=1,<2", "2.0.0", False),
        ("!=1.5,>=1", "1.5", False),
        ("", "0.1rc1", True),
    ],
)
def test_versions_are_compared_number_by_number(wanted, version, met):
    assert Requirement("library", wanted, "").met_by(version) is met


def test_an_old_python():
    assert only(checkup.python(">=3.11", (3, 12, 1))).state == "good"
    finding = only(checkup.python(">=3.11", (3, 10, 9)))
    assert finding.state == "fault" and finding.found == "3.10.9, expected >=3.11" and finding.advice


def test_missing_and_old_libraries():
    asked = [Requirement("numpy", ">=2", ""), Requirement("scipy", ">=1.15", ""), Requirement("rich", "", "")]
    found = list(checkup.libraries(asked, have({"numpy": "1.26.4", "rich": "13.0"})))
    assert states(found) == [("fault", "numpy"), ("fault", "scipy"), ("good", "rich")]
    assert found[0].found == "1.26.4, expected >=2" and found[0].advice == "pip install 'numpy>=2'"
    assert found[1].found == "missing, expected >=1.15"


def test_an_extra_that_is_not_there_is_no_fault(registry):
    asked = [Requirement("h5py", ">=3.11", "matlab73"), Requirement("swarming", "", "swarm")]
    found = list(checkup.extras(asked, have({"h5py": "3.12"}), registry))
    assert states(found) == [("good", "extra 'matlab73'"), ("note", "extra 'swarm'")]
    assert found[0].found == "reads MATLAB 7.3 and HDF5 files"
    assert found[1].found == "gives the optimizer 'swarm'; not installed: swarming"
    assert found[1].advice == "pip install 'dashpot[swarm]'"


def test_a_plugin_that_cannot_be_loaded():
    good, bad = Origin("mine", "my-plugin", "1"), Origin("yours", "your-plugin", "2")
    faults = (PluginFault(bad, "cannot be loaded: ImportError: no"),)
    registry = SimpleNamespace(
        plugins=(good, bad), faults=faults, origins={("elements", "x"): good}, elements={"x": object}
    )
    found = list(checkup.plugins(registry))
    assert states(found) == [("good", f"plugin {good}"), ("fault", f"plugin {bad}")]
    assert "ImportError: no" in found[1].found and "your-plugin" in found[1].advice


def test_no_elements_at_all(registry):
    assert ("fault", "elements") in states(checkup.plugins(registry))


def test_specs_that_were_not_installed(tmp_path):
    (tmp_path / "networks").mkdir()
    (tmp_path / "networks" / "a.yaml").write_text("")
    assert states(checkup.specs(tmp_path)) == [
        ("good", "shipped networks"),
        ("fault", "shipped rigs"),
        ("fault", "shipped studies"),
    ]


def test_the_cache_folder(tmp_path, monkeypatch):
    (tmp_path / "kept").write_bytes(bytes(2_000_000))
    assert only(checkup.cache(tmp_path)).found == f"{tmp_path}: 1 files, 2.0 MB"
    monkeypatch.setattr(checkup, "LARGE", 1e6)
    assert only(checkup.cache(tmp_path)).state == "note"
    finding = only(checkup.cache(tmp_path / "kept" / "below"))
    assert finding.state == "note" and "Not a directory; each call compiles anew" in finding.found
    assert "DASHPOT_CACHE" in finding.advice


def test_no_space_left(tmp_path, monkeypatch):
    monkeypatch.setattr("shutil.disk_usage", lambda folder: SimpleNamespace(free=1e6))
    assert ("fault", "space") in states(checkup.cache(tmp_path))


def test_the_compiler(tmp_path, monkeypatch):
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path))
    assert only(checkup.compiler()).state == "good"
    wrong = only(checkup.compiler(checkup.PROBE.replace("42.0", "41.0")))
    assert wrong.state == "fault" and "expected 42 from a compiled function, got 41" in wrong.found
    broken = only(checkup.compiler("no assembly"))
    assert broken.state == "fault" and "llvmlite" in broken.advice


def test_a_compiler_without_a_cache(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path / "file"))
    assert only(checkup.compiler(checkup.PROBE + "; another text")).state == "good"


def test_this_installation_is_examined(call):
    code, out, _ = call("doctor", "--json")
    content = json.loads(out)
    assert content["format"] == "dashpot-doctor/1"
    assert content["healthy"] is (code == 0) is all(each["state"] != "fault" for each in content["findings"])
    assert {"Python", "compiler", "cache folder", "threads", "shipped networks"} <= {
        each["what"] for each in content["findings"]
    }


def test_a_fault_has_an_exit_code_and_its_advice(call, registry):
    code, out, _ = call("doctor")
    assert code == 1
    assert "plugin strange (dashpot-strange 0.3)" in out and "-> correct, update or uninstall dashpot-strange" in out
    assert out.rstrip().splitlines()[-1].endswith("faults: see what is marked !!")
    code, out, error = call("doctor", "--quiet")
    assert (code, out) == (1, "") and "cannot be loaded: ImportError: no" in error


def test_every_extra_for_users_has_a_purpose():
    from architecture.packaging import project

    from dashpot import load_registry

    extras = set(project()["project"]["optional-dependencies"])
    assert not [extra for extra in extras if checkup.purpose_of(extra, load_registry()) == "adds to dashpot"]
