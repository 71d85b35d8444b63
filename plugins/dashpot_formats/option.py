"""The options of a reader, as they stand under `file_options` in a dataset."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from dashpot.contract.reader import ReadingError
from dashpot.text.problem import nearest


def check_options(options: Mapping[str, object], known: Collection[str]) -> None:
    """Raises ReadingError for an option that a reader does not have."""
    for key in options:
        if key not in known:
            raise ReadingError(
                f"there is no file option '{key}'", nearest(key, known) or "there are: " + ", ".join(known)
            )


def get_option(options: Mapping[str, object], key: str, kind: type, default: Any) -> Any:
    """The value of an option. Raises ReadingError when it is not of its kind."""
    value = options.get(key, default)
    if value is default or (isinstance(value, kind) and not (kind is int and isinstance(value, bool))):
        return value
    raise ReadingError(
        f"expected the file option '{key}' as {_WORDS[kind]}, got '{value}'", "correct it in the dataset"
    )


_WORDS = {str: "a text", int: "a whole number", bool: "true or false"}
