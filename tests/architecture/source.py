"""The project's source, read as text: which modules there are and what they import."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FRAMEWORK = ROOT / "framework" / "dashpot"
PLUGINS = ROOT / "plugins"
# what users are told: the README, and where it sends them
REFERENCE = (
    "network-file",
    "dataset-file",
    "study-file",
    "joint-file",
    "campaign-file",
    "diagnosis-file",
    "command-line",
)
MANUAL = (ROOT / "README.md", *(ROOT / "docs" / "reference" / f"{name}.md" for name in REFERENCE))
VERB_PAGES = tuple(sorted((ROOT / "docs" / "verbs").glob("*.md")))


def modules(folder: Path) -> list[Path]:
    """Every Python file below a folder."""
    found = sorted(path for path in folder.rglob("*.py") if "__pycache__" not in path.parts)
    assert found, f"no source in {folder}"
    return found


@cache
def tree(path: Path) -> ast.Module:
    """The syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


def imports(path: Path) -> Iterator[tuple[str, int]]:
    """Full name and line of everything a file imports when it runs, at its top or inside functions."""
    for_annotations = {
        id(inner)
        for node in ast.walk(tree(path))
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        for inner in ast.walk(node)
    }
    package = path.relative_to(FRAMEWORK.parent if FRAMEWORK in path.parents else PLUGINS).parts[:-1]
    for node in (node for node in ast.walk(tree(path)) if id(node) not in for_annotations):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = ".".join(package[: len(package) - node.level + 1]) if node.level else ""
            origin = ".".join(part for part in (above, node.module or "") if part)
            yield from ((f"{origin}.{alias.name}", node.lineno) for alias in node.names)


def texts(path: Path) -> Iterator[tuple[str, int]]:
    """Every string in a file that is not a docstring."""
    said = {id(node.value) for node in ast.walk(tree(path)) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in said:
            yield node.value, node.lineno


def manual() -> str:
    """The text of the README, of the reference and of the pages of verbs, page by page."""
    return "\n".join(page.read_text(encoding="utf-8") for page in (*MANUAL, *VERB_PAGES))


def at(path: Path, line: int) -> str:
    """A place, as a reader wants it."""
    return f"{path.relative_to(ROOT)}:{line}"
