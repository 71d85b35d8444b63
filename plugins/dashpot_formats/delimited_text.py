"""The characters of a text file, whatever it was saved with."""

from __future__ import annotations

import codecs
from pathlib import Path

from dashpot.contract.reader import ReadingError

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


def read_lines(path: Path, encoding: str | None) -> list[str]:
    """The lines of a file. Without an encoding: its byte order mark, else UTF-8, else Windows' cp1252.

    Raises ReadingError when the file is not text, or not in the encoding asked for.
    """
    raw = path.read_bytes()
    text = _decode(raw, encoding) if encoding else _guess(raw)
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def _decode(raw: bytes, encoding: str) -> str:
    try:
        return raw.decode(encoding).removeprefix("\ufeff")
    except LookupError:
        raise ReadingError(f"there is no encoding '{encoding}'", "write utf-8, cp1252 or utf-16") from None
    except UnicodeError as error:
        raise ReadingError(f"it is not in the encoding '{encoding}': {error}", "leave 'encoding' away") from None


def _guess(raw: bytes) -> str:
    for mark, encoding in _MARKS:
        if raw.startswith(mark):
            return _decode(raw, encoding)
    unmarked = _wide_characters(raw[:4096])
    if unmarked:
        return _decode(raw, unmarked)
    if b"\0" in raw[:4096]:
        raise ReadingError("it is a binary file, expected a text table", "say its format with 'reader: ...'")
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError:
        return raw.decode("cp1252", errors="replace")


def _wide_characters(start: bytes) -> str | None:
    """UTF-16 without a byte order mark: nearly every second byte is zero, and no other."""
    if len(start) < 8:
        return None
    first, second = start[0::2], start[1::2]
    if second.count(0) > 0.8 * len(second) and not first.count(0):
        return "utf-16-le"
    return "utf-16-be" if first.count(0) > 0.8 * len(first) and not second.count(0) else None
