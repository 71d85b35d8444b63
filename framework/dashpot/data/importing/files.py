"""Which files are to be imported, and what their runs are called."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path

from dashpot.data.source import DESCRIPTIONS
from dashpot.data.table import FileReader
from dashpot.text.name import MOST_BYTES, start_of
from dashpot.text.problem import InputError, Place

# longer names fill the tables of a report: words that all files begin with are left out
_LONG = 24
# what is cut off leaves room for a number
_LONGEST = 100
_WORD = re.compile(r"[^ _-]+[ _-]+")


def find_files(given: Iterable[Path], readers: Mapping[str, FileReader]) -> list[Path]:
    """The files that were given, those in given folders that a reader takes unasked, and those that a pattern names.

    Raises InputError for what is not there.
    """
    endings = {suffix for reader in readers.values() for suffix in reader.suffixes}
    found: list[Path] = []
    for path in given:
        if path.is_dir():
            inside = sorted(path.iterdir(), key=_in_order)
            found += [file for file in inside if file.is_file() and file.suffix.lower() in endings]
        elif not path.exists() and set("*?[") & set(path.name):
            found += sorted(path.parent.glob(path.name), key=_in_order)
        elif path.exists():
            found.append(path)
        else:
            raise InputError.at(Place(str(path)), "there is no such file or folder", "check the name and the folder")
    files = [file for file in dict.fromkeys(found) if file.name not in DESCRIPTIONS]
    if not files:
        raise InputError.at(Place(", ".join(map(str, given))), "no measured files were found", "name the files")
    return files


def run_names(files: Sequence[Path]) -> dict[Path, str]:
    """A name for the run of each file, by the file and where needed its folder; long ones without what all share."""
    shared = _shared_words([file.stem for file in files])
    names: dict[Path, str] = {}
    for file in files:
        stem = file.stem[shared:]
        name = _safe(stem)
        if name in names.values():
            name = _safe(f"{file.resolve().parent.name}_{stem}")
        names[file] = free_name(stem, names.values()) if name in names.values() else name
    return names


def free_name(name: str, taken: Collection[str]) -> str:
    """A name for a part of a file that is fit for a run; with a number behind it where it is taken."""
    found, number = _safe(name), 2
    while found in taken:
        found, number = _safe(name, f"_{number}"), number + 1
    return found


def _shared_words(stems: Sequence[str]) -> int:
    """How many characters of long names are words that all of them begin with, each with a letter after them."""
    shared = 0
    if len(stems) < 2 or max(map(len, stems)) <= _LONG:
        return 0
    while (word := _WORD.match(stems[0], shared)) and all(stem.startswith(word[0], shared) for stem in stems):
        if not all(stem[word.end() :][:1].isalpha() for stem in stems):
            break
        shared = word.end()
    return shared


def common_folder(files: Sequence[Path]) -> Path:
    """The folder that holds all files, directly or below."""
    return Path(os.path.commonpath([str(file.resolve().parent) for file in files]))


def _safe(name: str, end: str = "") -> str:
    fit = re.sub(r"[/\\:*?\"<>|\x00-\x1f\x7f]", "_", name).lstrip(".")[:_LONGEST]
    return (start_of(fit, MOST_BYTES - len(end)) or "run") + end


def _in_order(path: Path) -> list[tuple[int, str]]:
    """Names with numbers in the order of the numbers: a2 before a10."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", path.name)]
