"""What a study or a campaign has done so far, on disk: every block of a search, every result as it ended.

Each record carries the digest of its bytes. What an interruption or a faulty disk has spoilt is done again.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from collections.abc import Iterator, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from dashpot.fit.replay import Block
from dashpot.text.name import shortened
from dashpot.text.problem import InputError, Place

MARK = "study.txt"
DIGEST = hashlib.sha256().digest_size
LENGTH = 8  # bytes


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
        return Record(None if self.folder is None else self.folder / shortened(name))

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
        digest, _, text = self._result.read_bytes().partition(b"\n")
        return json.loads(text) if digest == hashlib.sha256(text).hexdigest().encode() else None

    def blocks(self) -> list[Block]:
        """The blocks on disk up to the first that is not whole, which is cut off with all that follow it."""
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
        content = BytesIO()
        np.save(content, block.points)
        np.save(content, values)
        whole = content.getvalue()
        self._stream.write(len(whole).to_bytes(LENGTH, "little") + hashlib.sha256(whole).digest() + whole)
        self._stream.flush()

    def finish(self, result: Mapping[str, Any]) -> None:
        """Write the result; the blocks are needed no more."""
        self.close()
        if self._result is not None and self._blocks is not None:
            text = json.dumps(result)
            _write_whole(self._result, f"{hashlib.sha256(text.encode()).hexdigest()}\n{text}")
            self._blocks.unlink(missing_ok=True)

    def close(self) -> None:
        """Let go of the file."""
        if self._stream is not None:
            self._stream.close()
            self._stream = None


def _read_blocks(stream: BinaryIO) -> Iterator[Block]:
    size = os.fstat(stream.fileno()).st_size
    while head := stream.read(LENGTH + DIGEST):
        content = stream.read(min(int.from_bytes(head[:LENGTH], "little"), size))
        if hashlib.sha256(content).digest() != head[LENGTH:]:
            return
        whole = BytesIO(content)
        points, values = (np.load(whole, allow_pickle=False) for _ in range(2))
        yield Block(points, values if values.size else None)


def _write_whole(path: Path, text: str) -> None:
    part = path.with_name(f".{path.name}.part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)
