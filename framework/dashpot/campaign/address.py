"""Where data lie: a path, or an address that ``fsspec`` knows. They are read where the work is done."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import Any

from dashpot.data.source import DESCRIPTIONS
from dashpot.text.problem import InputError, Place

FILES = (".yaml", ".yml")


def is_remote(address: str) -> bool:
    """Whether it is an address and not a path."""
    return "://" in address


@contextmanager
def at_hand(address: str) -> Iterator[Path]:
    """The path of a dataset: where it lies, or that of a copy that is kept as long as the block lasts."""
    if not is_remote(address):
        yield Path(address)
        return
    files, place = file_system(address)
    with TemporaryDirectory(prefix="dashpot-") as folder:
        whole = PurePosixPath(place)
        top = whole.parent if whole.suffix in FILES else whole
        try:
            files.get(f"{top}/", folder + "/", recursive=True)
        except OSError as error:
            raise _unreachable(address, error) from None
        yield Path(folder) / whole.name if whole.suffix in FILES else Path(folder)


def state_of(address: str) -> list[list[Any]] | None:
    """Names and marks of the files of a dataset, by which a change is noticed; None where they cannot be seen."""
    try:
        return _remote_state(address) if is_remote(address) else _local_state(Path(address))
    except (OSError, InputError):
        return None


def file_system(address: str) -> tuple[Any, str]:
    """The file system of an address, and the place in it. InputError without ``fsspec``, and where it cannot go."""
    try:
        from fsspec.core import url_to_fs
    except ImportError:
        raise InputError.at(
            Place(address),
            "expected fsspec for data at an address, it is not installed",
            "pip install 'dashpot[cluster]'",
        ) from None
    try:
        return url_to_fs(address)
    except (ImportError, ValueError, OSError) as error:
        raise _unreachable(address, error) from None


def _unreachable(address: str, error: Exception) -> InputError:
    missing = isinstance(error, FileNotFoundError)
    told = "nothing is there" if missing else " ".join(str(error).split()) or type(error).__name__
    return InputError.at(Place(address), f"the data cannot be fetched: {told}", "check the address and your rights")


def _local_state(path: Path) -> list[list[Any]]:
    if path.is_file() and path.name not in DESCRIPTIONS and path.suffix not in FILES:
        found = [path, path.with_name(path.name + ".yaml")]
    else:
        folder = path if path.is_dir() else path.parent
        found = sorted(each for each in folder.rglob("*") if each.is_file())
    return [[each.name, each.stat().st_size, each.stat().st_mtime_ns] for each in found]


def _remote_state(address: str) -> list[list[Any]]:
    files, place = file_system(address)
    whole = PurePosixPath(place)
    top = str(whole.parent if whole.suffix in FILES else whole)
    return [[name.removeprefix(top), files.size(name), files.ukey(name)] for name in sorted(files.find(top))]
