"""Notebooks in percent format: run cell by cell, and written as a page with what each cell shows."""

from __future__ import annotations

import ast
import contextlib
import io
import json
import os
import re
import tempfile
from collections.abc import Iterator
from html import escape
from itertools import count
from pathlib import Path
from typing import Any

from building.parts import put, raw

CELL = re.compile(r"^# %%( \[markdown\])?.*\n", flags=re.MULTILINE)
PLOTLY = "plotly.min.js"
PLOTS = count(1)


def write_notebooks(sources: Path, folder: Path) -> None:
    """Run every notebook below ``sources`` and write it as a page."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in sorted(sources.glob("*.py")):
        with tempfile.TemporaryDirectory() as place, contextlib.chdir(place):
            put(folder / f"{path.stem}.md", "\n\n".join(page(path)) + "\n")


def page(path: Path) -> Iterator[str]:
    """The page of a notebook. What a cell raises goes through, with the cell in its notes."""
    names: dict[str, Any] = {"__name__": "__main__"}
    for number, (is_text, body) in enumerate(cells(path.read_text(encoding="utf-8"))):
        if is_text:
            yield re.sub(r"^# ?", "", body, flags=re.MULTILINE).strip()
            if number == 0:
                yield f"The source of this page is a notebook as text: {{download}}`{path.name} <{_link(path)}>`."
                yield raw(f'<script src="../../_static/{PLOTLY}"></script>')
            continue
        yield f"```python\n{body.strip()}\n```"
        try:
            yield from run(body, names)
        except Exception as error:
            error.add_note(f"in {path.name}, cell {number}:\n{body}")
            raise


def cells(text: str) -> Iterator[tuple[bool, str]]:
    """The cells: whether each is text, and what it holds."""
    _, *parts = CELL.split(text)
    yield from ((bool(mark), body) for mark, body in zip(parts[::2], parts[1::2], strict=True) if body.strip())


def run(body: str, names: dict[str, Any]) -> Iterator[str]:
    """Run a cell; what it prints, and what its last line shows."""
    tree, last = ast.parse(body), None
    if tree.body and isinstance(tree.body[-1], ast.Expr):
        last = ast.Expression(tree.body.pop().value)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(last, "cell", "eval"), names) if last else None
    if printed.getvalue():
        yield f"```text\n{printed.getvalue().rstrip()}\n```"
    if value is not None:
        yield shown(value)


def shown(value: Any) -> str:
    """What a cell shows of its value, as Jupyter does: a plot, HTML, or a text."""
    if hasattr(value, "to_plotly_json"):
        return raw(plot(value))
    if hasattr(value, "_repr_html_"):
        return raw(f'<div class="output">{value._repr_html_()}</div>'.replace("\n\n", "\n"))
    return f"```text\n{value!r}\n```"


def plot(figure: Any) -> str:
    """A plotly figure that draws itself with the copy of plotly that lies beside the pages."""
    drawn = json.loads(figure.to_json())
    place, height = f"plot-{next(PLOTS)}", drawn["layout"].get("height", 450)
    data, layout = (json.dumps(drawn[key]).replace("</", "<\\/") for key in ("data", "layout"))
    title = escape(str(drawn["layout"].get("title", {}).get("text", "plot")))
    return (
        f'<div id="{place}" class="plot" role="img" aria-label="{title}" style="height:{height}px"></div>\n'
        f"<script>Plotly.newPlot('{place}', {data}, {layout}, {{displaylogo: false, responsive: true}});</script>"
    )


def write_plotly(folder: Path) -> None:
    """The library of the plots, as reports have it."""
    from dashpot.report.library import plotly_js

    folder.mkdir(parents=True, exist_ok=True)
    put(folder / PLOTLY, plotly_js())


def _link(path: Path) -> str:
    return os.path.relpath(path, path.parents[1] / "generated" / "notebooks")
