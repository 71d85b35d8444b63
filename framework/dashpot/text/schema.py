"""JSON Schema (draft 7, which editors know) in the terms of `Form`: one function for each way of reading a key."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

Schema = dict[str, Any]

DRAFT = "http://json-schema.org/draft-07/schema#"
ANYTHING: Schema = {}
QUANTITY: Schema = {
    "type": ["number", "string"],
    "pattern": r"^\s*[-+−]?(\d+\.?\d*|\.\d+)([eE][-+]?\d{1,3})?\s*([A-Za-z%°µμ(/1][^,;:]*)?$",
    "description": "a number with a unit, such as 220 N/mm; a bare number is SI",
}


def document(kind: str, about: str, content: Schema, parts: Mapping[str, Schema] | None = None) -> Schema:
    """The schema of a whole file; ``parts`` are what `part` refers to."""
    head = {"$schema": DRAFT, "title": f"dashpot {kind}", "description": about}
    return {**head, **content, "definitions": {"quantity": QUANTITY, **(parts or {})}}


def part(name: str, about: str = "") -> Schema:
    """Another schema of the same document."""
    reference = {"$ref": f"#/definitions/{name}"}
    # beside a reference draft 7 reads nothing else
    return {"allOf": [reference], "description": about} if about else reference


def text(about: str = "", pattern: str = r"\S") -> Schema:
    """A text; a number is taken as it is written."""
    return _told({"type": ["string", "number", "boolean"], "pattern": pattern}, about)


def texts(about: str = "") -> Schema:
    """A list of texts."""
    return _told({"type": "array", "items": text()}, about)


def patterns(about: str = "") -> Schema:
    """One text or several."""
    return _told({"anyOf": [text(), texts()]}, about)


def number(about: str = "") -> Schema:
    """A number without a unit."""
    return _told({"type": "number"}, about)


def integer(about: str = "", **limits: int) -> Schema:
    """A whole number."""
    return _told({"type": "integer", **limits}, about)


def flag(about: str = "") -> Schema:
    """true or false."""
    return _told({"type": "boolean"}, about)


def quantity(unit: str = "", about: str = "") -> Schema:
    """A number, or a text of a number and a unit. Whether the unit is of the right kind, the reader says."""
    return part("quantity", in_unit(about, unit))


def choice(known: Collection[str], about: str = "") -> Schema:
    """One of the known words."""
    return _told({"enum": list(known)}, about)


def items(of: Schema, about: str = "", **limits: int) -> Schema:
    """A list."""
    return _told({"type": "array", "items": of, **limits}, about)


def pair(of: Schema, about: str = "") -> Schema:
    """A list of two."""
    return items(of, about, minItems=2, maxItems=2)


def named(of: Schema, about: str = "", **limits: Any) -> Schema:
    """Entries under names of one's own."""
    return _told({"type": "object", "additionalProperties": of, **limits}, about)


def mapping(keys: Mapping[str, Schema], required: Collection[str] = (), about: str = "", **more: Any) -> Schema:
    """Known keys and no others."""
    closed = {"type": "object", "properties": dict(keys), "additionalProperties": False, **more}
    return _told({**closed, **({"required": list(required)} if required else {})}, about)


def by_key(cases: Mapping[str, Schema], otherwise: Schema) -> Schema:
    """The schema of the first key that is there."""
    schema = otherwise
    for key, then in reversed(list(cases.items())):
        schema = {"if": {"type": "object", "required": [key]}, "then": then, "else": schema}
    return schema


def by_word(key: str, cases: Mapping[str, Schema], about: str = "") -> Schema:
    """A mapping whose other keys depend on the word under ``key``."""
    found = [
        {"if": {"properties": {key: {"const": word}}, "required": [key]}, "then": then} for word, then in cases.items()
    ]
    return {"type": "object", "required": [key], "properties": {key: choice(cases, about)}, "allOf": found}


def in_unit(about: str, unit: str) -> str:
    """What a number means, with its unit."""
    return about + (f" ({unit})" if unit and unit != "1" else "") if about else unit


def _told(schema: Schema, about: str) -> Schema:
    return {**schema, "description": about} if about else schema
