"""A YAML text with positions: read safely, capped, ready to be edited in place."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from dashpot.text.compose import compose, place_at
from dashpot.text.node import Mapping, Node, Scalar, Sequence
from dashpot.text.problem import InputError, Place

__all__ = ["Document", "Mapping", "Node", "Scalar", "Sequence"]

MAX_BYTES = 4 * 1024 * 1024
TEXTS_KEPT = 8  # of no file: each change of a text begins with reading it


@dataclass(frozen=True, eq=False)
class Document:
    """A parsed YAML text. `text[node.start:node.end]` is what a node was read from."""

    text: str
    file: str | None
    root: Node

    @classmethod
    def read(cls, path: Path | str, ours: bool = False) -> Document:
        """Read a file (UTF-8), one of dashpot itself if it is ``ours``.

        Raises InputError when it is missing, too large or not sound YAML.
        """
        file = str(path)
        return cls.parse(_decode(_read_bytes(Path(path), file), file), file, ours)

    @classmethod
    def parse(cls, text: str, file: str | None = None, ours: bool = False) -> Document:
        """Parse a text; `file` is the name used in messages. Raises InputError."""
        if len(text) > MAX_BYTES:
            raise _too_large(file)
        return cls(text, file, _composed(text) if file is None else compose(text, file, ours))


@lru_cache(TEXTS_KEPT)
def _composed(text: str) -> Node:
    return compose(text, None)


def _read_bytes(path: Path, file: str) -> bytes:
    try:
        with path.open("rb") as stream:
            raw = stream.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise InputError.at(Place(file), "there is no such file", "check the name and the folder") from None
    except OSError as error:
        raise InputError.at(Place(file), f"the file cannot be read: {error.strerror}", "check its rights") from None
    if len(raw) > MAX_BYTES:
        raise _too_large(file)
    return raw


def _decode(raw: bytes, file: str) -> str:
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = raw[: error.start].decode("utf-8-sig")
        place = place_at(before, len(before), file)
        message = f"expected UTF-8 text, got the byte 0x{raw[error.start]:02x}"
        raise InputError.at(place, message, "save the file as UTF-8") from None


def _too_large(file: str | None) -> InputError:
    hint = "put long tables into a file of their own"
    return InputError.at(Place(file), f"the text is larger than {MAX_BYTES} bytes", hint)
