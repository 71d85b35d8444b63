"""The parts of pages that are written by programs."""

from __future__ import annotations

from pathlib import Path

PAGE = Path(__file__).parent / "README.md"


def write_part(name: str, text: str, page: Path = PAGE) -> None:
    """Put a text between the marks of this name."""
    begin, end = f"<!-- written: {name} -->", f"<!-- end: {name} -->"
    before, _, rest = page.read_text(encoding="utf-8").partition(begin)
    page.write_text(f"{before}{begin}\n\n{text}\n\n{end}{rest.partition(end)[2]}", encoding="utf-8")
