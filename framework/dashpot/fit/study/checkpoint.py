"""What a study or a campaign has done so far, on disk: every block of a search, every result as it ended.

Each record carries the digest of its bytes and of the study they belong to. What an interruption or a faulty disk has
spoilt is done again, and nothing is taken that was recorded by another study.
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
        self.folder, self._study = folder, ""

    def open(self, fingerprint: str) -> None:
        """Begin, or go on where the same work stopped. InputError when the records are of another one.

        A mark that is damaged is written anew where a record proves to be of this work.
        """
        self._study = fingerprint
        if self.folder is None:
            return
        mark = self.folder / MARK
        if mark.exists():
            self._refuse_another(_marked(mark))
        self.folder.mkdir(parents=True, exist_ok=True)
        _write_whole(mark, f"{fingerprint}\n{_digest(MARK, fingerprint.encode()).hex()}\n")

    def _refuse_another(self, marked: str | None) -> None:
        assert self.folder is not None
        records = {path.with_suffix("").name for end in ("*.blocks", "*.json") for path in self.folder.glob(end)}
        if marked == self._study or (marked is None and not records):
            return
        if marked is None and any(self.stage(name).is_sound() for name in records):
            return
        message = (
            "its records are of another study or campaign: its file, the data, the seed or the version has changed"
            if marked is not None
            else f"its '{MARK}', which tells what its records are of, is damaged, and none of them proves to be of this"
            " study or campaign"
        )
        raise InputError.at(Place(str(self.folder)), message, "choose another -o, or say --force to begin again")

    def stage(self, name: str) -> Record:
        """The record of one search of one stage."""
        return Record(None if self.folder is None else self.folder / shortened(name), self._study)

    def discard(self) -> None:
        """Remove all records."""
        if self.folder is not None and (self.folder / MARK).exists():
            shutil.rmtree(self.folder)


class Record:
    """One search: the blocks answered so far in ``NAME.blocks``, its result in ``NAME.json``.

    ``study`` is the fingerprint of what it belongs to.
    """

    def __init__(self, path: Path | None, study: str) -> None:
        self._study = study
        self._blocks = path and path.with_name(path.name + ".blocks")
        self._result = path and path.with_name(path.name + ".json")
        self._stream: BinaryIO | None = None

    def result(self) -> dict[str, Any] | None:
        """How the search ended, if it did."""
        if self._result is None or not self._result.exists():
            return None
        digest, _, text = self._result.read_bytes().partition(b"\n")
        return json.loads(text) if digest == _digest(self._study, text).hex().encode() else None

    def is_sound(self) -> bool:
        """Whether its result, or the first of its blocks, is whole and of this study."""
        if self.result() is not None:
            return True
        if self._blocks is None or not self._blocks.exists():
            return False
        with self._blocks.open("rb") as stream:
            return any(True for _ in _read_blocks(stream, self._study))

    def blocks(self) -> list[Block]:
        """The blocks on disk up to the first that is not whole, which is cut off with all that follow it."""
        if self._blocks is None or not self._blocks.exists():
            return []
        found = []
        with self._blocks.open("r+b") as stream:
            end = 0
            for block in _read_blocks(stream, self._study):
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
        self._stream.write(len(whole).to_bytes(LENGTH, "little") + _digest(self._study, whole) + whole)
        self._stream.flush()

    def finish(self, result: Mapping[str, Any]) -> None:
        """Write the result; the blocks are needed no more."""
        self.close()
        if self._result is not None and self._blocks is not None:
            text = json.dumps(result)
            _write_whole(self._result, f"{_digest(self._study, text.encode()).hex()}\n{text}")
            self._blocks.unlink(missing_ok=True)

    def close(self) -> None:
        """Let go of the file."""
        if self._stream is not None:
            self._stream.close()
            self._stream = None


def _read_blocks(stream: BinaryIO, study: str) -> Iterator[Block]:
    size = os.fstat(stream.fileno()).st_size
    while head := stream.read(LENGTH + DIGEST):
        content = stream.read(min(int.from_bytes(head[:LENGTH], "little"), size))
        if _digest(study, content) != head[LENGTH:]:
            return
        whole = BytesIO(content)
        points, values = (np.load(whole, allow_pickle=False) for _ in range(2))
        yield Block(points, values if values.size else None)


def _marked(mark: Path) -> str | None:
    """The fingerprint in a mark; None where it is damaged."""
    study, _, digest = mark.read_bytes().partition(b"\n")
    return study.decode() if digest.strip() == _digest(MARK, study).hex().encode() else None


def _digest(study: str, content: bytes) -> bytes:
    return hashlib.sha256(study.encode() + b"\0" + content).digest()


def _write_whole(path: Path, text: str) -> None:
    """Write a file so that after a crash it is there with all of its text, or as it was before."""
    part = path.with_name(f".{path.name}.part")
    with part.open("wb") as stream:
        stream.write(text.encode())
        stream.flush()
        os.fsync(stream.fileno())
    os.replace(part, path)
