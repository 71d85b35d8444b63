"""The specimens of a campaign: the rows of a table, or what a pattern over folders finds."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import replace
from glob import glob
from pathlib import Path

from dashpot.campaign.address import file_system, is_remote
from dashpot.campaign.declaration import Measured
from dashpot.text.problem import InputError, Place, Problem

NAME, DATA = "specimen", "data"
NO_FILE_NAME = re.compile(r'[/\\:*?"<>|\x00-\x1f]|^\.|^\s*$')


def specimens_of_table(path: Path, data_needed: bool = True) -> tuple[Measured, ...]:
    """The rows of a CSV file: ``specimen``, ``data`` relative to the file, and a column for each property.

    A property whose cells are all numbers is one; an empty cell is not known. InputError with every mistake.
    """
    headings, rows = _rows_of(path)
    needed = (NAME, DATA) if data_needed else (NAME,)
    missing = [heading for heading in needed if heading not in headings]
    if missing:
        raise InputError.at(
            Place(str(path)),
            f"expected a column '{missing[0]}', got: {', '.join(headings) or 'none'}",
            "its first line names the columns",
        )
    numeric = {heading for heading in headings if all(_is_number(row[heading]) for _, row in rows if row[heading])}
    properties = [heading for heading in headings if heading not in (NAME, DATA)]
    found = [
        Measured(
            row[NAME],
            _beside(row.get(DATA, ""), path.parent),
            {key: float(row[key]) if key in numeric else row[key] for key in properties if row[key]},
        )
        for _, row in rows
    ]
    lines = [Place(str(path), line) for line, _ in rows]
    _refuse(found, lines, data_needed)
    return tuple(found)


def specimens_of_pattern(pattern: str, folder: Path, place: Place) -> tuple[Measured, ...]:
    """A specimen for each path, relative to ``folder``, or address that a pattern names.

    It is called after what the stars stand for. InputError where nothing is found.
    """
    full = pattern if is_remote(pattern) else str(folder / pattern)
    if "*" not in pattern or "**" in pattern:
        raise InputError.at(
            place,
            f"expected a pattern with '*' for the name of the specimen, got '{pattern}'",
            "such as 'measured/*/dataset.yaml'",
        )
    expression = re.compile("([^/]*)".join(map(re.escape, full.replace("\\", "/").split("*"))))
    found = []
    for path in _matching(pattern, folder):
        if match := expression.fullmatch(path.replace("\\", "/")):
            found.append(Measured("-".join(filter(None, match.groups())), path))
    if not found:
        raise InputError.at(place, f"the pattern '{pattern}' names no data", f"it is looked for at {full}")
    _refuse(found, [place] * len(found), True)
    return tuple(found)


def with_properties(found: tuple[Measured, ...], table: Path) -> tuple[Measured, ...]:
    """The specimens with the properties that a table says; InputError for a specimen that it does not have."""
    known = {row.name: row.properties for row in specimens_of_table(table, data_needed=False)}
    missing = [one.name for one in found if one.name not in known]
    if missing:
        raise InputError.at(
            Place(str(table)),
            f"expected a row for every specimen, got none for '{missing[0]}'",
            "a specimen is called after what the * of the pattern stands for",
        )
    return tuple(replace(one, properties=known[one.name]) for one in found)


def _matching(pattern: str, folder: Path) -> list[str]:
    if is_remote(pattern):
        files, place = file_system(pattern)
        return sorted(files.unstrip_protocol(name) for name in files.glob(place))
    return sorted(str(folder / name) for name in glob(pattern, root_dir=folder))


def _rows_of(path: Path) -> tuple[list[str], list[tuple[int, Mapping[str, str]]]]:
    """The headings of a table, and its rows with the numbers of their lines."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError.at(Place(str(path)), f"expected a table as CSV in UTF-8, it cannot be read: {error}") from None
    delimiter = max(",;\t", key="".join(lines[:1]).count)
    headings, *rows = [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=delimiter)] or [[]]
    wrong = [number for number, row in enumerate(rows, 2) if row and len(row) != len(headings)]
    if wrong:
        raise InputError.at(Place(str(path), wrong[0]), f"expected {len(headings)} cells, as in the first line")
    return headings, [(number, dict(zip(headings, row, strict=True))) for number, row in enumerate(rows, 2) if row]


def _beside(data: str, folder: Path) -> str:
    return data if is_remote(data) or not data else str(folder / data)


def _refuse(found: list[Measured], places: list[Place], data_needed: bool) -> None:
    problems = list(_problems(found, places, data_needed))
    if problems:
        raise InputError(problems)


def _problems(found: list[Measured], places: list[Place], data_needed: bool) -> Iterator[Problem]:
    counts = Counter(one.name for one in found)
    if not found:
        yield Problem(Place(), "expected at least one specimen, got none")
    for one, place in zip(found, places, strict=True):
        if NO_FILE_NAME.search(one.name):
            yield Problem(place, f"expected a specimen whose name can be that of a folder, got '{one.name}'")
        elif counts[one.name] > 1:
            yield Problem(place, f"two specimens are called '{one.name}'", "each needs a name of its own")
        if data_needed and not one.data:
            yield Problem(place, f"the specimen '{one.name}' has no data", "write the path of its dataset")


def _is_number(cell: str) -> bool:
    try:
        return abs(float(cell)) < float("inf")
    except ValueError:
        return False
