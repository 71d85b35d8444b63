"""What the pages are put together of."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator
from pathlib import Path


def put(path: Path, text: str) -> None:
    """Write a text unless it is there."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def raw(html: str) -> str:
    """HTML in a page."""
    return f"````{{raw}} html\n{html}\n````"


def folded(title: str, language: str, text: str) -> Iterator[str]:
    """A code block that is opened by a press."""
    yield raw(f"<details><summary>{title}</summary>")
    yield f"```{language}\n{text}\n```"
    yield raw("</details>")


def inline_picture(title: str, drawing: str) -> str:
    """A drawing as an image that is part of the page."""
    return f'<img alt="{title}" src="data:image/svg+xml;base64,{b64encode(drawing.encode()).decode()}">'
