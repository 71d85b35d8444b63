"""Numbers in a JSON file: a matrix, a matrix under a key, or columns under their names."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeGuard

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot.text.problem import nearest
from dashpot_formats.flatten import numbered_columns
from dashpot_formats.option import check_options, get_option


class JsonMatrix(Reader):
    """Reads `[[...], ...]` or `{"data": [[...], ...]}` with a row for each sample, or `{"t": [...], "x": [...]}`.

    `key` tells where the matrix or the columns are (dots lead further down); the columns of a matrix are 1, 2, ...;
    `transpose` where its rows are the channels.
    """

    word = "json"
    suffixes = (".json",)
    options = {
        "key": "where the matrix or the columns are; dots lead further down",
        "transpose": "true where the rows of the matrix are the channels",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        content = _descend(_parse(path), get_option(options, "key", str, None))
        if isinstance(content, dict):
            return Table(_named_columns(content))
        return Table(numbered_columns(_matrix(content), get_option(options, "transpose", bool, False)))


def _parse(path: Path) -> object:
    try:
        return json.loads(path.read_bytes())
    except json.JSONDecodeError as error:
        raise ReadingError(f"it is not JSON: {error.msg}", "write it again", error.lineno) from None
    except (UnicodeDecodeError, RecursionError, ValueError) as error:
        raise ReadingError(f"it is not JSON of numbers: {error}", "write it again") from None


def _descend(content: object, key: str | None) -> object:
    if key is None:
        return _only_matrix(content) if isinstance(content, dict) else content
    for part in key.split("."):
        if not isinstance(content, dict) or part not in content:
            known = list(content) if isinstance(content, dict) else []
            raise ReadingError(f"it has no key '{key}'", nearest(part, known) or f"there are: {', '.join(known[:12])}")
        content = content[part]
    return content


def _only_matrix(content: dict[str, object]) -> object:
    """Under `data`, or under the only key that holds a matrix; else the object itself holds the columns."""
    matrices = [value for value in content.values() if _is_list(value) and value and _is_list(value[0])]
    if _is_list(content.get("data")) or isinstance(content.get("data"), dict):
        return content["data"]
    return matrices[0] if len(matrices) == 1 else content


def _is_list(value: object) -> TypeGuard[list[object]]:
    return isinstance(value, list)


def _named_columns(content: dict[str, object]) -> dict[str, np.ndarray]:
    columns = {key: _vector(value, f"'{key}'") for key, value in content.items() if _is_list(value) and len(value) > 1}
    if not columns:
        raise ReadingError("it holds no lists of numbers", "say where they are with 'key' under file_options")
    return columns


def _matrix(content: object) -> np.ndarray:
    if not isinstance(content, list) or not content:
        raise ReadingError("expected a list of rows", "say where the matrix is with 'key' under file_options")
    if not _is_list(content[0]):
        return _vector(content, "the list")
    for number, row in enumerate(content, 1):
        if not _is_list(row) or len(row) != len(content[0]):
            message = (
                f"expected {len(content[0])} numbers in row {number}, got {len(row) if _is_list(row) else repr(row)}"
            )
            raise ReadingError(message, "make all rows equally long")
    return np.array([_vector(row, f"row {number}") for number, row in enumerate(content, 1)])


def _vector(values: Sequence[object], where: str) -> np.ndarray:
    """Numbers (n,); null is a missing one."""
    for value in values:
        if isinstance(value, bool) or not isinstance(value, int | float | None):
            raise ReadingError(f"expected numbers in {where}, got '{str(value)[:40]}'", "write numbers without quotes")
    try:
        return np.array(values, dtype=float)
    except OverflowError:
        raise ReadingError(f"a number in {where} is too large", "correct it") from None
