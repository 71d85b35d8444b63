"""The distribution holds what lies in the source tree, and says so."""

from __future__ import annotations

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


def test_the_changelog_has_an_unreleased_section_for_users():
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert "\n## [Unreleased]\n" in text
