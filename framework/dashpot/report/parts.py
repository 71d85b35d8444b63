"""What a report is made of: plain, frozen data; `page` turns it into HTML, `tables` into terminal text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

import numpy as np

NoticeKind = Literal["info", "warning", "good", "bad"]


@dataclass(frozen=True)
class Column:
    """One column of a table.

    `digits` are significant digits; None shows the cell as text. Where the row has an interval (low, high) under the
    key `interval`, that gives the decimals instead. Numbers in the rows are already in `unit`. In a page the cell
    leads to the relative address that the row has under the key `link`.
    """

    key: str
    title: str
    unit: str = ""
    digits: int | None = None
    link: str = ""
    interval: str = ""

    @property
    def heading(self) -> str:
        return f"{self.title} ({self.unit})" if self.unit else self.title


@dataclass(frozen=True)
class Grid:
    """A table; `rows` map column keys to cells (a missing cell or None is shown as a dash).

    What is `folded` is opened by a press on its title; so it is with a figure.
    """

    template: ClassVar[str] = "grid"

    title: str
    columns: Sequence[Column]
    rows: Sequence[Mapping[str, Any]]
    caption: str = ""
    csv_name: str = "table.csv"
    folded: bool = False


@dataclass(frozen=True)
class Figure:
    """An interactive plot with the numbers behind it.

    `columns` hold the numbers in display units, the heading (with its unit) as key. `plot` is plotly JSON
    (`data`, `layout`) with two additions, which keep the page small and let it follow the reader's colours:

    - an array may be a reference `{"column": heading, "rows": [start, stop]}` into `columns`;
    - a colour may be a name of the theme, `"@before"`.

    `layout["meta"]["toggles"]` lists the groups of buttons that show and hide traces (see `figures.toggles`).
    """

    template: ClassVar[str] = "figure"

    title: str
    caption: str
    plot: Mapping[str, Any]
    columns: Mapping[str, Sequence[Any] | np.ndarray]
    folded: bool = False


@dataclass(frozen=True)
class Code:
    """A text in a fixed-width face. In the language "diff" each line starts with "+", "-" or a space.

    With a `file_name` the reader can save `download` (or, where that is empty, `text`).
    """

    template: ClassVar[str] = "code"

    title: str
    text: str
    language: str = "text"
    file_name: str = ""
    download: str = ""


@dataclass(frozen=True)
class Picture:
    """A drawing in SVG; shown as an image, in which no script of the drawing can run."""

    template: ClassVar[str] = "picture"

    title: str
    svg: str
    caption: str = ""


@dataclass(frozen=True)
class Notice:
    """A sentence the reader must not overlook."""

    template: ClassVar[str] = "notice"

    kind: NoticeKind
    text: str


@dataclass(frozen=True)
class KeyFigures:
    """The few numbers that matter: (label, value, unit, note), already written out."""

    template: ClassVar[str] = "key_figures"

    figures: Sequence[tuple[str, str, str, str]]


Part = Figure | Grid | Code | Picture | Notice | KeyFigures


@dataclass(frozen=True)
class Section:
    """A titled piece of the evidence."""

    title: str
    text: str = ""
    parts: Sequence[Part] = ()


@dataclass(frozen=True)
class Page:
    """A whole report: the answer first (`headline`, `lead`), then the evidence, at the end where it came from.

    Key figures, notices and the parts whose titles are in the `summary` are what the one page of it shows.
    """

    title: str
    headline: str
    lead: str
    sections: Sequence[Section]
    colophon: Sequence[tuple[str, str]] = field(default=())
    summary: Sequence[str] = field(default=())
