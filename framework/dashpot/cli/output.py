"""Result files: all of a set or none, nothing overwritten unasked, and one writer for each folder."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from dashpot.text.problem import InputError, Place, Problem

try:
    import fcntl
except ImportError:  # Windows has no locks on folders
    fcntl = None  # type: ignore[assignment]

UNFINISHED = ".dashpot.unfinished"  # names of files of a set that an interruption left incomplete


@dataclass(frozen=True)
class OutputFolder:
    """The folder of ``-o``."""

    path: Path
    force: bool

    def claim(self, *patterns: str) -> None:
        """See, before any work is done, that these files may be written; the folder is made where there is none.

        InputError names every file that would be overwritten without ``--force``. Files of a set that an earlier call
        could not complete are no results: they are written anew.
        """
        self._make()
        if not self.force:
            self._refuse_existing(patterns)
        for pattern in (*patterns, UNFINISHED):
            for part in self.path.glob(_part_name(pattern)):
                part.unlink(missing_ok=True)

    def _make(self) -> None:
        if self.path.exists() and not self.path.is_dir():
            raise InputError.at(Place(str(self.path)), "expected a folder, got a file", "choose another -o")
        try:
            self.path.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            message = f"expected a folder that can be made, got: {error.strerror}"
            raise InputError.at(Place(str(self.path)), message, "choose another -o, or check its rights") from None
        if not os.access(self.path, os.W_OK | os.X_OK):
            raise InputError.at(
                Place(str(self.path)),
                "expected a folder that may be written, got one that may not",
                "choose another -o, or change its rights",
            )

    def _refuse_existing(self, patterns: tuple[str, ...]) -> None:
        unfinished = self._unfinished()
        found = sorted({path for pattern in patterns for path in self.path.glob(pattern)})
        if complete := [path for path in found if path.name not in unfinished]:
            hint = "choose another -o, or say --force to overwrite it"
            raise InputError([Problem(Place(str(path)), "exists already", hint) for path in complete])

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Keep other calls out of the folder as long as this lasts. InputError where another one is in it already."""
        self._make()
        handle = None if fcntl is None else os.open(self.path, os.O_RDONLY)
        try:
            if handle is not None:
                self._lock(handle)
            yield
        finally:
            if handle is not None:
                os.close(handle)

    def _lock(self, handle: int) -> None:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError.at(
                Place(str(self.path)),
                "another call of dashpot is writing into this folder",
                "wait for its end, or choose another -o",
            ) from None
        except OSError:  # some network drives know no locks
            pass

    @contextmanager
    def together(self) -> Iterator[Results]:
        """A set of files: complete at the end of the block, and none of it there when the block fails."""
        with _discarded(Results(self.path)) as results:
            yield results
            before = self._unfinished()
            self._note(before | set(results.names))
            results.publish()
            self._note(before - set(results.names))

    def write(self, name: str, text: str) -> Path:
        """Write a single text file."""
        with self.together() as results:
            return results.write(name, text)

    def _unfinished(self) -> set[str]:
        try:
            return set((self.path / UNFINISHED).read_text(encoding="utf-8").splitlines())
        except OSError:
            return set()

    def _note(self, names: set[str]) -> None:
        if not names:
            return (self.path / UNFINISHED).unlink(missing_ok=True)
        with _discarded(Results(self.path)) as note:
            note.write(UNFINISHED, "\n".join(sorted(names)))
            note.publish()


@dataclass(frozen=True)
class Results:
    """A set of files, each written beside its place until all are complete."""

    folder: Path
    names: list[str] = field(default_factory=list)

    def write(self, name: str, text: str) -> Path:
        """Add a text file; the same text gives the same bytes everywhere. The path that it will have."""
        return self.write_bytes(name, text.encode("utf-8"))

    def write_bytes(self, name: str, content: bytes | memoryview) -> Path:
        """Add a file. InputError where there is no room for it, or where it may not be written."""
        return self._write(name, [content])

    def write_pieces(self, name: str, texts: Iterable[str]) -> Path:
        """Add a text file whose pieces are made one after the other."""
        return self._write(name, (text.encode("utf-8") for text in texts))

    def _write(self, name: str, pieces: Iterable[bytes | memoryview]) -> Path:
        path = self.folder / name
        self.names.append(name)
        with _told(path), (self.folder / _part_name(name)).open("wb") as stream:
            for piece in pieces:
                stream.write(piece)
        return path

    def publish(self) -> None:
        """Put all files in their places."""
        for name in self.names:
            with _told(self.folder / name):
                os.replace(self.folder / _part_name(name), self.folder / name)

    def discard(self) -> None:
        """Remove what was not published."""
        for name in self.names:
            (self.folder / _part_name(name)).unlink(missing_ok=True)


def _part_name(name: str) -> str:
    return f".{name}.part"


@contextmanager
def _discarded(results: Results) -> Iterator[Results]:
    try:
        yield results
    finally:
        results.discard()


@contextmanager
def _told(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        message = f"expected to write a file, got: {error.strerror}"
        raise InputError.at(Place(str(path)), message, "make room, or choose another -o") from None
