"""The documentation is built without a warning, its notebooks run, and viewing it asks nobody anything."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest
from architecture.source import ROOT, VERB_PAGES

sys.path.insert(0, str(ROOT / "docs"))
pytest.importorskip("sphinx", reason="the documentation needs the extra docs")

LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src", "object": "data"}
SOURCES = ROOT / "docs" / "notebooks"
NOTEBOOKS = sorted(path.stem for path in SOURCES.glob("*.py"))


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built pages; every warning is an error."""
    folder = tmp_path_factory.mktemp("site")
    build = [sys.executable, "-m", "sphinx", "--fail-on-warning", "--keep-going", "--quiet"]
    done = subprocess.run(
        [*build, "-d", folder / "doctrees", ROOT / "docs", folder / "html"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "html"


def test_the_pages(site):
    """In one test, since the pages are built once for each worker that needs them."""
    every_page_is_reached(site)
    nothing_outside_is_loaded(site)
    notebooks_show_what_they_found(site)
    the_examples_of_all_verbs_ran()
    generated_pages_hold_what_is_installed(site)
    if chromium := shutil.which("chromium") or shutil.which("google-chrome"):
        plots_and_formulas_are_drawn(site, chromium)


def every_page_is_reached(site: Path) -> None:
    index = (site / "index.html").read_text(encoding="utf-8")
    pages = {path.relative_to(site).as_posix() for path in site.rglob("*.html")}
    assert len(pages) > 20
    assert not [
        page for page in pages - {"index.html", "search.html", "genindex.html"} if f'href="{page}"' not in index
    ]


def nothing_outside_is_loaded(site: Path) -> None:
    for page in site.rglob("*.html"):
        found = Loads()
        found.feed(page.read_text(encoding="utf-8"))
        assert not [address for address in found.addresses if re.match(r"(?:\w+:)?//", address)], page
        assert not [address for address in found.addresses if not found.is_there(address, page.parent)], page
    for sheet in site.rglob("*.css"):
        assert not re.search(r"(?:url\(|@import)\s*['\"]?(?:https?:)?//", sheet.read_text(encoding="utf-8")), sheet


def notebooks_show_what_they_found(site: Path) -> None:
    texts = {
        name: (site / "generated" / "notebooks" / f"{name}.html").read_text(encoding="utf-8") for name in NOTEBOOKS
    }
    assert all('<div class="output">' in text or "highlight-text" in text for text in texts.values())
    plotted = [name for name in NOTEBOOKS if ".plot(" in (SOURCES / f"{name}.py").read_text(encoding="utf-8")]
    assert plotted and all("Plotly.newPlot(" in texts[name] for name in plotted)
    assert "width at 1.5 mm: 120 N" in texts["declare_a_topology"]
    assert "identified:" in texts["identify_a_tire"]
    assert "+relaxation" in texts["find_a_hidden_effect"]
    assert "of the wheel" in texts["quarter_car_in_numba"]


def the_examples_of_all_verbs_ran() -> None:
    """A command that fails ends the building of the pages."""
    from building.verbs import commands

    pages = ROOT / "docs" / "generated" / "verbs"
    wanted = {page.stem: commands(page.read_text(encoding="utf-8")) for page in VERB_PAGES}
    assert sum(map(bool, wanted.values())) > 10
    for name, lines in wanted.items():
        text = (pages / f"{name}.md").read_text(encoding="utf-8")
        assert all(f"$ {line}\n" in text for line in lines), name


def generated_pages_hold_what_is_installed(site: Path) -> None:
    from architecture.written import things

    for kind in ("elements", "causes", "optimizers", "formats", "rigs", "specimens", "exports"):
        page = (site / "generated" / f"{kind}.html").read_text(encoding="utf-8")
        assert not [word for word in things(kind) if f">{word}</span>" not in page], kind
    families = (site / "generated" / "elements").glob("*.html")
    assert sum(page.read_text(encoding="utf-8").count('<math display="block">') for page in families) > 20


def plots_and_formulas_are_drawn(site: Path, chromium: str) -> None:
    page = site / "generated" / "notebooks" / "declare_a_topology.html"
    switches = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"]
    profile = f"--user-data-dir={site.parent / 'profile'}"
    command = [chromium, *switches, profile, "--virtual-time-budget=9000", "--dump-dom", page.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env={**os.environ, "LC_ALL": "C.UTF-8"})
    assert done.returncode == 0, done.stderr
    assert 'class="main-svg"' in done.stdout


class Loads(HTMLParser):
    """What a page loads by itself."""

    def __init__(self) -> None:
        super().__init__()
        self.addresses: list[str] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = dict(attributes)
        address = given.get(LOADED.get(tag, ""))
        if address and not address.startswith("data:"):
            self.addresses.append(address)

    @staticmethod
    def is_there(address: str, folder: Path) -> bool:
        """Whether the file of an address lies beside the page."""
        return (folder / address.partition("?")[0].partition("#")[0]).exists()
