"""Where a dataset is: its description, its folder, and the measurement files it may read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from dashpot.data.table import FileReader
from dashpot.data.trouble import Trouble, Unusable
from dashpot.text.problem import InputError, Place, nearest

DESCRIPTIONS = ("dataset.yaml", "dataset.yml")
ALLOW = "move it there, or say --allow-outside where you trust the dataset"


@dataclass(frozen=True)
class Source:
    """The description of a dataset, its folder, and the measurement file when there is only that one."""

    description: Path
    folder: Path
    file: str | None = None


def locate(path: Path) -> Source:
    """The dataset at a path: a description, a folder with one, or a data file with a sidecar `<file>.yaml`.

    Raises InputError when there is none.
    """
    if path.is_dir():
        return _in_folder(path)
    if path.suffix in (".yaml", ".yml"):
        measured = path.with_suffix("")
        only = measured.name if measured.suffix and measured.is_file() else None
        return Source(path, path.parent, only)
    sidecar = path.with_name(path.name + ".yaml")
    if not path.exists():
        raise InputError.at(Place(str(path)), "there is no such file or folder", _neighbour(path))
    if not sidecar.exists():
        hint = f"`dashpot import {path}` writes a dataset.yaml over it; or write '{sidecar.name}' yourself"
        raise InputError.at(Place(str(path)), "nothing says what this file holds", hint)
    return Source(sidecar, path.parent, path.name)


def _in_folder(folder: Path) -> Source:
    for name in DESCRIPTIONS:
        if (folder / name).is_file():
            return Source(folder / name, folder)
    raise InputError.at(
        Place(str(folder)),
        "the folder holds no dataset.yaml",
        f"`dashpot import {folder}` writes a first one over the measured files in it",
    )


def _neighbour(path: Path) -> str:
    names = [other.name for other in path.parent.iterdir()] if path.parent.is_dir() else []
    return nearest(path.name, names) or "check the name and the folder"


def measured_folder(source: Source, stated: str | None, allow_outside: bool, place: Place) -> Path:
    """Where the measured files lie, as the description has ``stated`` at ``place``; None: beside it.

    Raises InputError for a folder that lies elsewhere and holds no dataset: a description that somebody else wrote
    leads to no other files, unless the caller allows it.
    """
    folder = source.folder / stated if stated else source.folder
    below = folder.resolve().is_relative_to(source.folder.resolve())
    if below or allow_outside or any((folder / name).is_file() for name in DESCRIPTIONS):
        return folder
    message = f"expected a folder below that of the dataset, or one that holds a dataset, got '{stated}'"
    raise InputError.at(place, message, ALLOW)


def find_file(file: str, folder: Path, allow_outside: bool, place: Place) -> Path:
    """The path of a measurement file, below the folder unless that is allowed. Raises Unusable."""
    path = folder / file
    try:
        is_below = path.resolve().is_relative_to(folder.resolve())
        exists = path.is_file()
    except (OSError, RuntimeError) as error:
        raise Unusable([Trouble(f"this cannot be a file: {error}", "check its name", place)]) from None
    if not is_below and not allow_outside:
        raise Unusable([Trouble("it lies outside the folder of the dataset", ALLOW, place)])
    if not exists:
        raise Unusable([Trouble("there is no such file", _neighbour(path), place)])
    return path


def choose_reader(file: str, word: str | None, readers: Mapping[str, FileReader], place: Place) -> FileReader:
    """The reader asked for, or the one for the ending of the file's name. Raises Unusable when there is none."""
    if word is not None and word in readers:
        return readers[word]
    if word is not None:
        hint = nearest(word, readers) or _known(readers)
        raise Unusable([Trouble(f"there is no reader '{word}'", hint, place)])
    ending = Path(file).suffix.lower()
    for reader in readers.values():
        if ending in reader.suffixes:
            return reader
    raise Unusable(
        [Trouble(f"no reader takes files ending in '{ending}'", f"say 'reader: ...'; {_known(readers)}", place)]
    )


def _known(readers: Iterable[str]) -> str:
    return "there are: " + (", ".join(sorted(readers)) or "none")
