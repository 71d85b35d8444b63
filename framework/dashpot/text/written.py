"""Python values as YAML, as one would write them on one line of a file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from numbers import Integral, Real

from dashpot.text.inserting import plain_or_quoted


def flow(value: object) -> str:
    """A value on one line; a number as the shortest text that reads back alike. TypeError for what YAML does not know.

    Texts stay as they are (``220 N/mm``), mappings become ``{...}``, lists and arrays ``[...]``.
    """
    if isinstance(value, str):
        return plain_or_quoted(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        return repr(float(value))
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{plain_or_quoted(str(key))}: {flow(inner)}' for key, inner in value.items())}}}"
    if isinstance(value, Iterable):
        return f"[{', '.join(map(flow, value))}]"
    raise TypeError(f"expected a number, a text such as '220 N/mm', a mapping or a list, got {value!r}")
