"""A `Page` as one HTML file that needs nothing else: no network, no server, no second file."""

from __future__ import annotations

import base64
import urllib.parse
from pathlib import Path
from typing import TYPE_CHECKING

from dashpot.report.library import plotly_js
from dashpot.report.parts import Code, Figure, Grid, Page, Picture
from dashpot.report.plot_json import plot_json
from dashpot.report.security import content_policy, script_json
from dashpot.report.tables import cell_text, to_csv
from dashpot.report.theme import DARK, LIGHT, style_variables
from dashpot.text.digits import typeset

if TYPE_CHECKING:
    from jinja2 import Environment

SCRIPTS = ("colors.js", "columns.js", "plots.js", "start.js")


def write_page(path: str | Path, page: Page) -> Path:
    """Write the page to `path` and return the path. The same page gives the same bytes."""
    path = Path(path)
    path.write_bytes(render(page).encode())
    return path


def render(page: Page) -> str:
    """The page as HTML text. Every text of the page is escaped; only our own scripts may run in it.

    The plotting library, several MB, is in pages with a plot only.
    """
    environment = _environment()
    plotted = any(isinstance(part, Figure) for section in page.sections for part in section.parts)
    library = [plotly_js()] if plotted else []
    scripts = [*library, *(_source(environment, name) for name in SCRIPTS)]
    return environment.get_template("report.html.j2").render(
        page=page,
        plotted=plotted,
        policy=content_policy(scripts),
        scripts=scripts,
        style=_source(environment, "style.css"),
        light=style_variables(LIGHT),
        dark=style_variables(DARK),
    )


def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("dashpot.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"script_json": _figure_json, "csv_link": _csv_link, "picture": _picture}
    environment.filters |= {"text_link": _text_link, "lines": _lines}
    environment.globals |= {"cell_text": cell_text, "typeset": typeset}
    return environment


def _source(environment: Environment, name: str) -> str:
    assert environment.loader is not None
    return environment.loader.get_source(environment, name)[0]


def _figure_json(figure: Figure) -> str:
    from markupsafe import Markup

    return Markup(script_json(plot_json(figure)))


# the byte order mark tells spreadsheets that the file is UTF-8
def _csv_link(grid: Grid) -> str:
    return _data_address("text/csv", "\ufeff" + to_csv(grid.rows, grid.columns))


def _text_link(code: Code) -> str:
    return _data_address("text/plain", code.download or code.text)


def _data_address(kind: str, text: str) -> str:
    return f"data:{kind};charset=utf-8,{urllib.parse.quote(text)}"


def _picture(picture: Picture) -> str:
    return f"data:image/svg+xml;base64,{base64.b64encode(picture.svg.encode()).decode()}"


def _lines(code: Code) -> list[tuple[str, str]]:
    """Each line with its class: what came and what went in a diff."""
    marks = {"+": "added", "-": "removed"} if code.language == "diff" else {}
    return [(marks.get(line[:1], "same"), line) for line in code.text.removesuffix("\n").split("\n")]
