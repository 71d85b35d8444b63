"""The JSON schema of options: of the keyword arguments of a class, as they are written in a file."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any, get_args, get_origin

from dashpot.contract.options import kind_and_unit, options_of
from dashpot.text import schema as s
from dashpot.text.schema import Schema


def with_options(made: type, more: Mapping[str, Schema]) -> Schema:
    """A mapping of the options of a class, and of some more keys that are required."""
    options = {name: option_schema(option) for name, option in options_of(made).items()}
    required = [name for name, option in options_of(made).items() if option.default is inspect.Parameter.empty]
    about = (made.__doc__ or "").strip().partition("\n")[0]
    return s.mapping({**more, **options}, (*more, *required), about)


def option_schema(option: inspect.Parameter) -> Schema:
    """What may stand for an option: a quantity, a number, a text, or a list of them."""
    kind, unit = kind_and_unit(option.annotation)
    if get_origin(kind) is tuple:
        one = _scalar(get_args(kind)[0], unit)
        return {"anyOf": [s.items(one), one, {"type": "string", "pattern": ","}]}
    return _scalar(kind, unit)


def _scalar(kind: Any, unit: str) -> Schema:
    if unit:
        return s.quantity(unit)
    plain: dict[Any, Schema] = {
        int: {"anyOf": [s.integer(), {"type": "string", "pattern": r"^\s*[-+]?\d+\s*$"}]},
        float: {"anyOf": [s.number(), s.quantity()]},
        bool: {"anyOf": [s.flag(), s.choice(("yes", "no", "true", "false"))]},
    }
    return plain.get(kind, s.text())
