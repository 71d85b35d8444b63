"""Result files: JSON whose bytes depend on the content alone."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Collection, Iterator, Mapping
from enum import Enum
from typing import Any

import numpy as np

LINE_LENGTH = 120


class NotFiniteError(ValueError):
    """A number of a result file is NaN or infinite where a number is required."""


def json_text(content: Any, optional: Collection[str] = ()) -> str:
    """`content` as JSON text: keys in their order, sets sorted, floats as the shortest text that reads back alike.

    numpy arrays and scalars, dataclasses, enumerations and tuples are written as what they mean. JSON has no NaN
    or infinity: below a key named in `optional` they become null, anywhere else they are an error.

    Raises `NotFiniteError` naming the place of the number, `TypeError` for what JSON cannot say.
    """
    return "\n".join(_lines(_plain(content, "", frozenset(optional)), "")) + "\n"


def _plain(item: Any, place: str, optional: frozenset[str]) -> Any:
    match item:
        case Enum():
            return _plain(item.value, place, optional)
        case None | bool() | str():
            return item
        case int():
            return int(item)
        case float():
            return _finite(float(item), place, optional)
        case np.generic() | np.ndarray():
            return _plain(item.tolist(), place, optional)
        case Mapping():
            return {_key(key, place): _plain(value, f"{place}.{key}", optional) for key, value in item.items()}
        case set() | frozenset():
            return _plain(sorted(item), place, optional)
        case list() | tuple():
            return [_plain(value, f"{place}[{index}]", optional) for index, value in enumerate(item)]
    if dataclasses.is_dataclass(item) and not isinstance(item, type):
        fields = {entry.name: getattr(item, entry.name) for entry in dataclasses.fields(item)}
        return _plain(fields, place, optional)
    raise TypeError(f"{_shown(place)}: expected numbers, texts, lists or mappings, got {type(item).__name__}")


def _finite(value: float, place: str, optional: frozenset[str]) -> float | None:
    if math.isfinite(value):
        return value
    if optional.intersection(place.replace("[", ".").split(".")):
        return None
    raise NotFiniteError(f"{_shown(place)}: expected a finite number, got {value}")


def _key(key: Any, place: str) -> str:
    if isinstance(key, str):
        return str(key)
    raise TypeError(f"{_shown(place)}: expected texts as keys, got {type(key).__name__} {key!r}")


def _shown(place: str) -> str:
    return place.lstrip(".") or "the result"


# Lists and mappings without inner structure stand on one line where they fit.
def _lines(item: Any, indent: str) -> Iterator[str]:
    line = json.dumps(item, ensure_ascii=False, allow_nan=False)
    if not isinstance(item, dict | list) or _is_leaf(item) and len(indent) + len(line) <= LINE_LENGTH:
        yield line
        return
    opening, closing = "{}" if isinstance(item, dict) else "[]"
    yield opening
    entries = item.items() if isinstance(item, dict) else ((None, value) for value in item)
    yield from _entries(list(entries), indent + "  ")
    yield indent + closing


def _entries(entries: list[tuple[str | None, Any]], indent: str) -> Iterator[str]:
    for count, (key, value) in enumerate(entries, start=1):
        lines = list(_lines(value, indent))
        lines[0] = indent + ("" if key is None else f"{json.dumps(key, ensure_ascii=False)}: ") + lines[0]
        lines[-1] += "," if count < len(entries) else ""
        yield from lines


def _is_leaf(item: dict | list) -> bool:
    values = item.values() if isinstance(item, dict) else item
    return not any(isinstance(value, dict | list) and value for value in values)
