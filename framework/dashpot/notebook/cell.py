"""The parts of a report as HTML for one cell of a notebook: no scripts, the colours of the reader."""

from __future__ import annotations

import base64
from functools import singledispatch
from html import escape

from dashpot.report.parts import Code, Column, Grid, Notice, Part, Picture
from dashpot.report.tables import cell_text, printed_heading

# what is marked important stands against the styles that Jupyter gives to every table and text
STYLE = """
.dashpot { max-width: 100%; }
.dashpot h4 { margin: 0.9em 0 0.3em; font-weight: 600; }
.dashpot .scroll { overflow: auto; max-height: 32em; }
.dashpot table { border-collapse: collapse; font-size: 0.92em; margin: 0; }
.dashpot th, .dashpot td { padding: 0.2em 0.8em; border-bottom: 1px solid rgba(128, 128, 128, 0.3); }
.dashpot th, .dashpot td { text-align: left !important; vertical-align: top; }
.dashpot td:not(.number) { min-width: 4em; }
.dashpot .number { text-align: right !important; font-variant-numeric: tabular-nums; }
.dashpot p { margin: 0.3em 0; }
.dashpot .note { opacity: 0.75; font-size: 0.9em; }
.dashpot .warning, .dashpot .bad { border-left: 3px solid #c77700; padding-left: 0.6em; }
.dashpot pre { padding: 0.6em; background: rgba(128, 128, 128, 0.1); overflow: auto; }
.dashpot pre, .dashpot pre span { font-family: monospace !important; }
.dashpot pre .added { background: rgba(10, 122, 85, 0.22); }
.dashpot pre .removed { background: rgba(179, 38, 30, 0.22); }
.dashpot img { max-width: 100%; }
"""


def cell(*parts: Part | str) -> str:
    """The parts one below the other; a text is a paragraph, the first one a heading."""
    first, *others = parts
    top = f"<h4>{escape(first)}</h4>" if isinstance(first, str) else shown(first)
    return f'<div class="dashpot"><style>{STYLE}</style>{top}{"".join(map(shown, others))}</div>'


@singledispatch
def shown(part: object) -> str:
    """The HTML of a part. TypeError for one that a cell cannot show."""
    raise TypeError(f"expected a text, grid, picture, code or notice, got {type(part).__name__}")


@shown.register
def _(part: str) -> str:
    return f"<p>{escape(part)}</p>"


@shown.register
def _(part: Notice) -> str:
    return f'<p class="{part.kind}">{escape(part.text)}</p>'


@shown.register
def _(part: Grid) -> str:
    head = "".join(f"<th{_number(column)}>{escape(printed_heading(column))}</th>" for column in part.columns)
    rows = [
        "".join(f"<td{_number(column)}>{escape(cell_text(column, row))}</td>" for column in part.columns)
        for row in part.rows
    ]
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    caption = f'<p class="note">{escape(part.caption)}</p>' if part.caption else ""
    table = f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'
    return f"<h4>{escape(part.title)}</h4>{table}{caption}"


# as an image, so that neither style nor script of the drawing reaches the page
@shown.register
def _(part: Picture) -> str:
    source = base64.b64encode(part.svg.encode()).decode()
    return f'<p><img alt="{escape(part.title)}" src="data:image/svg+xml;base64,{source}"></p>'


@shown.register
def _(part: Code) -> str:
    marks = {"+": "added", "-": "removed"} if part.language == "diff" else {}
    lines = part.text.removesuffix("\n").split("\n")
    body = "".join(f'<span class="{marks.get(line[:1], "same")}">{escape(line)}\n</span>' for line in lines)
    return f"<h4>{escape(part.title)}</h4><pre>{body}</pre>"


def _number(column: Column) -> str:
    return "" if column.digits is None else ' class="number"'
