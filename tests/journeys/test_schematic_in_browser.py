"""The schematic as a browser sets it: no label runs into another, with the narrowest and the widest of its faces.

Needs Chromium and `pip install playwright`; the environment variable CHROMIUM may name the browser.
"""

from __future__ import annotations

import os
import shutil
from itertools import combinations

import pytest

from dashpot import load_registry
from dashpot.model.reading import read_network
from dashpot.report.schematic.svg import svg

sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed (pip install playwright)")

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
CHROMIUM = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason=f"no Chromium found (looked for {', '.join(NAMES)})")

SWITCHES = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"]
BOXES = """() => [...document.querySelectorAll('text, .sign, .support, .scaling, rect.body')].map(found => {
    const box = found.getBoundingClientRect();
    const place = [box.left, box.top, box.right, box.bottom];
    return [found.closest('g').getAttribute('class'), found.textContent.trim(), ...place];
})"""


@pytest.fixture(scope="module")
def page():
    with sync_api.sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=CHROMIUM, args=SWITCHES)
        yield running.new_page(viewport={"width": 2200, "height": 1200})
        running.close()


@pytest.mark.parametrize("face", ["Helvetica, Arial, 'Liberation Sans'", "'DejaVu Sans'"])
@pytest.mark.parametrize("name", ["tire_model_5", "axle_model_3_top_mount", "quarter_car", "eub"])
def test_labels_keep_clear_of_everything(page, name, face):
    page.set_content(f"<body>{svg(read_network(name, load_registry().elements))}</body>")
    page.add_style_tag(content=f"svg {{ font-family: {face} !important; }}")
    boxes = page.evaluate(BOXES)
    texts = [box for box in boxes if box[0].startswith("words")]
    others = [box for box in boxes if box[0].startswith(("sign", "support", "scaling"))]
    assert len(texts) > 5
    clashes = [
        (one[1], other[:2])
        for one, other in [*combinations(texts, 2), *((a, b) for a in texts for b in others)]
        if overlap(one, other)
    ]
    assert not clashes


def overlap(one, other) -> bool:
    # the boxes of two lines of one label share the room between the lines
    across = min(one[4], other[4]) - max(one[2], other[2])
    down = min(one[5], other[5]) - max(one[3], other[3])
    return across > 0.5 and down > 3.0
