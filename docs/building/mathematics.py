"""Formulas of the pages as MathML, made when the pages are: no script renders them."""

from __future__ import annotations

from typing import Any


def inline(writer: Any, node: Any) -> None:
    """A formula within a line."""
    _write(writer, node, "inline")


def block(writer: Any, node: Any) -> None:
    """A formula on a line of its own."""
    _write(writer, node, "block")


def _write(writer: Any, node: Any, display: str) -> None:
    from docutils.nodes import SkipNode
    from latex2mathml.converter import convert

    writer.body.append(convert(node.astext(), display=display))
    raise SkipNode
