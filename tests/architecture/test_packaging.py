"""The distribution holds what lies in the source tree, and says so."""

from __future__ import annotations

import re

from architecture.packaging import plugin_packages, project
from architecture.source import FRAMEWORK, ROOT


def test_every_plugin_package_comes_in_through_the_entry_points():
    assert set(project()["project"]["entry-points"]["dashpot"].values()) == plugin_packages()


def test_every_package_is_in_the_wheel():
    included = project()["tool"]["hatch"]["build"]["targets"]["wheel"]["only-include"]
    assert set(included) == {"framework/dashpot", "specs", *(f"plugins/{name}" for name in plugin_packages())}


def test_the_package_is_typed():
    assert (FRAMEWORK / "py.typed").is_file()


def test_the_installed_metadata_has_the_version_of_the_source():
    from importlib.metadata import version

    import dashpot

    assert version("dashpot") == dashpot.__version__


def test_the_changelog_keeps_the_format():
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    first, *released = re.findall(r"^## (.+)$", text, flags=re.MULTILINE)
    assert first == "[Unreleased]"
    assert released and all(re.fullmatch(r"\[\d+\.\d+\.\d+\] - \d{4}-\d\d-\d\d", title) for title in released)
    groups = {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"}
    assert set(re.findall(r"^### (.+)$", text, flags=re.MULTILINE)) <= groups


def test_changelog_and_citation_have_the_version_of_the_source():
    import dashpot

    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    version, date = re.findall(r"^## \[(\d.+)\] - (.+)$", text, flags=re.MULTILINE)[0]
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert version == dashpot.__version__
    assert f"\nversion: {version}\n" in citation and f'\ndate-released: "{date}"\n' in citation


def test_compilers_have_a_range_that_was_tested():
    pinned = [line for line in project()["project"]["dependencies"] if re.match("numba|llvmlite", line)]
    assert len(pinned) == 2 and all(re.fullmatch(r"\w+>=[\d.]+,<[\d.]+", line) for line in pinned)
