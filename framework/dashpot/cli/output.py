"""Result files: complete or not there, and nothing overwritten unasked."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from dashpot.text.problem import InputError, Place, Problem


@dataclass(frozen=True)
class OutputFolder:
    """The folder of ``-o``."""

    path: Path
    force: bool

    def claim(self, *patterns: str) -> None:
        """Make the folder and see, before any work is done, that these files may be written into it.

        InputError names every file that would be overwritten without ``--force``.
        """
        if self.path.exists() and not self.path.is_dir():
            raise InputError.at(Place(str(self.path)), "expected a folder, got a file", "choose another -o")
        if not self.force:
            self._refuse_existing(patterns)
        try:
            self.path.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            message = f"expected a folder that can be made, got: {error.strerror}"
            raise InputError.at(Place(str(self.path)), message, "choose another -o, or check its rights") from None
        if not os.access(self.path, os.W_OK | os.X_OK):
            raise InputError.at(Place(str(self.path)), "expected a folder that may be written, got one that may not",
                                "choose another -o, or change its rights")  # fmt: skip

    def _refuse_existing(self, patterns: tuple[str, ...]) -> None:
        found = sorted({path for pattern in patterns for path in self.path.glob(pattern)})
        if found:
            hint = "choose another -o, or say --force to overwrite it"
            raise InputError([Problem(Place(str(path)), "exists already", hint) for path in found])

    def write(self, name: str, text: str) -> Path:
        """Write a text file; the same text gives the same bytes everywhere."""
        return self.write_bytes(name, text.encode("utf-8"))

    def write_bytes(self, name: str, content: bytes | memoryview) -> Path:
        """Write a file under a temporary name first, so that an interrupted run leaves no half of it."""
        path = self.path / name
        part = path.with_name(f".{name}.part")
        try:
            part.write_bytes(content)
            os.replace(part, path)
        except OSError as error:
            part.unlink(missing_ok=True)
            message = f"expected to write a file, got: {error.strerror}"
            raise InputError.at(Place(str(path)), message, "make room, or choose another -o") from None
        except BaseException:
            part.unlink(missing_ok=True)
            raise
        return path
