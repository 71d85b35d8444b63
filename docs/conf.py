"""How Sphinx builds the documentation: `make docs`. Sphinx, because it fails on every broken reference."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import dashpot  # noqa: E402

project = "dashpot"
author = copyright = "The dashpot authors"
release = version = dashpot.__version__

extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "deflist", "colon_fence"]
myst_heading_anchors = 4
exclude_patterns = ["_build", "building", "elements", "formats", "notebooks", "verbs", "README.md"]
nitpicky = True
smartquotes = False

html_theme = "furo"
html_title = f"dashpot {version}"
html_static_path = ["_static"]
html_css_files = ["pages.css"]
html_math_renderer = "mathml"
html_show_sphinx = False
html_copy_source = False
pygments_style = "friendly"
pygments_dark_style = "monokai"


def setup(app: Any) -> None:
    """Write the generated pages before Sphinx looks for pages, and render formulas without scripts."""
    from building import mathematics

    app.add_html_math_renderer("mathml", (mathematics.inline, None), (mathematics.block, None))
    app.connect("builder-inited", _generate)


def _generate(app: Any) -> None:
    from building.elements import write_elements
    from building.formats import write_formats
    from building.notebooks import write_notebooks, write_plotly
    from building.pages import write_pages
    from building.verbs import write_verbs

    write_pages(HERE / "generated")
    write_elements(HERE / "elements", HERE / "generated" / "elements")
    write_formats(HERE / "formats", HERE / "generated" / "formats")
    write_verbs(HERE / "verbs", HERE / "generated" / "verbs")
    write_notebooks(HERE / "notebooks", HERE / "generated" / "notebooks")
    write_plotly(Path(app.outdir) / "_static")
