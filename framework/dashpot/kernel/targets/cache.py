"""Where compiled code is kept: files named by the digest of all that they come from."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from dashpot.text.problem import InputError, Place


def cache_folder() -> Path:
    """``DASHPOT_CACHE``, or ``dashpot`` in the user's cache folder."""
    given = os.environ.get("DASHPOT_CACHE")
    if given:
        return Path(given)
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return (Path(base) if base else Path.home() / ".cache") / "dashpot"


def keep(file: Path, content: bytes) -> None:
    """Write a file so that nobody ever reads half of it. Raises InputError where it cannot be written."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=file.parent, suffix=".part")
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        os.replace(temporary, file)
    except OSError as error:
        message = f"compiled networks cannot be kept here: {error.strerror}"
        hint = "let the environment variable DASHPOT_CACHE name a folder that may be written"
        raise InputError.at(Place(str(file.parent)), message, hint) from None
