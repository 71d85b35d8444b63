"""What a study or a campaign has done so far, on disk: every block of a search as it was answered, every result."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from dashpot.fit.replay import Block
from dashpot.text.problem import InputError, Place

MARK = "study.txt"


class Checkpoint:
    """A folder of records. Without a folder nothing is kept."""

    def __init__(self, folder: Path | None) -> None:
        self.folder = folder

    def open(self, fingerprint: str) -> None:
        """Begin, or go on where the same work stopped. InputError when the records are of another one."""
        if self.folder is None:
            return
        mark = self.folder / MARK
        if mark.exists() and mark.read_text(encoding="utf-8") != fingerprint:
            raise InputError.at(
                Place(str(self.folder)),
                "its records are of another study or campaign: its file, the data, the seed or the version has changed",
                "choose another -o, or say --force to begin again",
            )
        self.folder.mkdir(parents=True, exist_ok=True)
        _write_whole(mark, fingerprint)

    def stage(self, name: str) -> Record:
        """The record of one search of one stage."""
        return Record(None if self.folder is None else self.folder / name)

    def discard(self) -> None:
        """Remove all records."""
        if self.folder is not None and (self.folder / MARK).exists():
            shutil.rmtree(self.folder)


class Record:
    """One search: the blocks answered so far in ``NAME.blocks``, its result in ``NAME.json``."""

    def __init__(self, path: Path | None) -> None:
        self._blocks = path and path.with_name(path.name + ".blocks")
        self._result = path and path.with_name(path.name + ".json")
        self._stream: BinaryIO | None = None

    def result(self) -> dict[str, Any] | None:
        """How the search ended, if it did."""
        if self._result is None or not self._result.exists():
            return None
        try:
            return json.loads(self._result.read_text(encoding="utf-8"))
        except ValueError:
            raise InputError.at(Place(str(self._result)), "expected the record of a search, got a damaged file",
                                "say --force to begin again") from None  # fmt: skip

    def blocks(self) -> list[Block]:
        """The whole blocks on disk; what an interruption left of the last one is cut off."""
        if self._blocks is None or not self._blocks.exists():
            return []
        found = []
        with self._blocks.open("r+b") as stream:
            end = 0
            for block in _read_blocks(stream):
                found.append(block)
                end = stream.tell()
            stream.truncate(end)
        return found

    def keep(self, block: Block) -> None:
        """Append a block. Residuals are too many to be kept: they are evaluated again."""
        if self._blocks is None:
            return
        if self._stream is None:
            self._stream = self._blocks.open("ab")
        values = block.values if block.values is not None and block.values.ndim == 1 else np.empty(0)
        np.save(self._stream, block.points)
        np.save(self._stream, values)
        self._stream.flush()

    def finish(self, result: Mapping[str, Any]) -> None:
        """Write the result; the blocks are needed no more."""
        self.close()
        if self._result is not None and self._blocks is not None:
            _write_whole(self._result, json.dumps(result))
            self._blocks.unlink(missing_ok=True)

    def close(self) -> None:
        """Let go of the file."""
        if self._stream is not None:
            self._stream.close()
            self._stream = None


def _read_blocks(stream: BinaryIO) -> Iterator[Block]:
    while True:
        try:
            points, values = (np.load(stream, allow_pickle=False) for _ in range(2))
        except (EOFError, ValueError, OSError):
            return
        yield Block(points, values if values.size else None)


def _write_whole(path: Path, text: str) -> None:
    part = path.with_name(f".{path.name}.part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)
