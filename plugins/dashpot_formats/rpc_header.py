"""The header of an RPC III file: blocks of 512 bytes, each with four keywords and their values."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from dashpot.contract.reader import ReadingError

_BLOCK, _RECORD, _KEY = 512, 128, 32
_FIRST = ("FORMAT", "NUM_HEADER_BLOCKS", "NUM_PARAMS")
_HINT = "check that this is an RPC III time history"


@dataclass(frozen=True)
class RpcHeader:
    """The values by keyword, and the bytes that the header takes."""

    values: Mapping[str, str]
    size: int

    @classmethod
    def read(cls, content: bytes) -> RpcHeader:
        """The header at the beginning of a file. Raises ReadingError when there is none."""
        first = [_record(content, index) for index in range(len(_FIRST))]
        if tuple(key for key, _ in first) != _FIRST:
            message = f"expected the keywords {', '.join(_FIRST)} at its beginning, got '{first[0][0][:40]}'"
            raise ReadingError(message, _HINT)
        start = cls(dict(first), 0)
        size = start.whole("NUM_HEADER_BLOCKS") * _BLOCK
        if size > len(content):
            raise ReadingError(
                f"it is cut short: expected a header of {size} bytes, got {len(content)}", "copy it again"
            )
        count = min(start.whole("NUM_PARAMS"), size // _RECORD)
        records = [_record(content, index) for index in range(count)]
        return cls({key: value for key, value in records if key}, size)

    def text(self, key: str, default: str) -> str:
        """The value of a keyword."""
        return self.values.get(key, default).strip().strip('"').strip()

    def choice(self, key: str, known: Mapping[str, str], default: str = "") -> str:
        """What the value stands for. Raises ReadingError when it is none of those known."""
        value = self.text(key, default)
        if value not in known:
            raise ReadingError(f"expected {key} as {' or '.join(known)}, got '{value[:40]}'", _HINT)
        return known[value]

    def whole(self, key: str, default: int | None = None, largest: int = 2**40) -> int:
        """A whole number from 1 on. Raises ReadingError when it is none."""
        value = self.number(key, default)
        if value != int(value) or not 1 <= value <= largest:
            raise ReadingError(f"expected {key} as a whole number from 1 to {largest}, got {value:g}", _HINT)
        return int(value)

    def number(self, key: str, default: float | None = None, smallest: float | None = None) -> float:
        """A number. Raises ReadingError when it is none, or too small."""
        text = self.text(key, "" if default is None else str(default))
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or (smallest is not None and value < smallest):
            raise ReadingError(f"expected a number after {key}, got '{text[:40]}'", _HINT)
        return value


def _record(content: bytes, index: int) -> tuple[str, str]:
    record = content[index * _RECORD : (index + 1) * _RECORD]
    return _text(record[:_KEY]), _text(record[_KEY:])


def _text(raw: bytes) -> str:
    return raw.partition(b"\0")[0].decode("cp1252", errors="replace").strip()
