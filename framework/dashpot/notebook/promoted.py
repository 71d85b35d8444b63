"""From a result of a layer below to the same result that shows itself."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, TypeVar

Shown = TypeVar("Shown")


def promoted(kind: type[Shown], thing: Any, **changes: Any) -> Shown:
    """``thing`` as an instance of ``kind``, a subclass of its dataclass that adds methods only."""
    if isinstance(thing, kind) and not changes:
        return thing
    return kind(**{field.name: getattr(thing, field.name) for field in fields(thing)} | changes)
