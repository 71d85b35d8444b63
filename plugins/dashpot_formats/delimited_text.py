"""The characters of a text file, whatever it was saved with."""

from __future__ import annotations

import codecs
from collections.abc import Iterator
from pathlib import Path

from dashpot.contract.reader import ReadingError
from dashpot_formats.delimited_lines import LONE, Lines

# bytes that are decoded at a time
_PIECE = 1 << 20

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


def read_lines(path: Path, encoding: str | None) -> Lines:
    """The lines of a file. Without an encoding: its byte order mark, else UTF-8, else Windows' cp1252.

    Raises ReadingError when the file is not text, or not in the encoding asked for.
    """
    raw = path.read_bytes()
    text = _decode(raw, encoding) if encoding else _guess(raw)
    del raw
    return Lines(text.replace(b"\r\n", b"\n").replace(b"\r", b"\n"))


def _decode(raw: bytes, encoding: str) -> bytes:
    """The text in UTF-8."""
    try:
        if codecs.lookup(encoding).name in ("utf-8", "utf-8-sig") and _is_utf_8(raw):
            # a file that was saved again may have the mark twice
            return raw.removeprefix(codecs.BOM_UTF8).removeprefix(codecs.BOM_UTF8)
        return raw.decode(encoding).removeprefix("\ufeff").encode("utf-8", LONE)
    except LookupError:
        raise ReadingError(f"there is no encoding '{encoding}'", "write utf-8, cp1252 or utf-16") from None
    except UnicodeError as error:
        raise ReadingError(f"it is not in the encoding '{encoding}': {error}", "leave 'encoding' away") from None


def _guess(raw: bytes) -> bytes:
    """The text in UTF-8, from an encoding that nobody named."""
    for mark, encoding in _MARKS:
        if raw.startswith(mark):
            return _decode(raw, encoding)
    unmarked = _wide_characters(raw[:4096])
    if unmarked:
        return _decode(raw, unmarked)
    if b"\0" in raw[:4096]:
        raise ReadingError("it is a binary file, expected a text table", "say its format with 'reader: ...'")
    if _is_utf_8(raw):
        return raw
    return b"".join(piece.decode("cp1252", errors="replace").encode() for piece in _pieces(raw))


def _is_utf_8(raw: bytes) -> bool:
    """Whether all is UTF-8, found out piece by piece: decoded, a text may take four times the memory of its bytes."""
    decoder = codecs.getincrementaldecoder("utf-8")()
    try:
        for piece in _pieces(raw):
            decoder.decode(piece)
        decoder.decode(b"", final=True)
    except UnicodeDecodeError:
        return False
    return True


def _pieces(raw: bytes) -> Iterator[bytes]:
    return (raw[start : start + _PIECE] for start in range(0, len(raw), _PIECE))


def _wide_characters(start: bytes) -> str | None:
    """UTF-16 without a byte order mark: nearly every second byte is zero, and no other."""
    if len(start) < 8:
        return None
    first, second = start[0::2], start[1::2]
    if second.count(0) > 0.8 * len(second) and not first.count(0):
        return "utf-16-le"
    return "utf-16-be" if first.count(0) > 0.8 * len(first) and not second.count(0) else None
