"""Libraries that are installed only by who reads their format."""

from __future__ import annotations

from importlib.util import find_spec

from dashpot.contract.reader import ReadingError


def require(package: str, extra: str, files: str) -> None:
    """Raises ReadingError, with how to install it, when the package is missing that reads these files."""
    if find_spec(package) is None:
        raise ReadingError(f"{files} need the package {package}", f"pip install 'dashpot[{extra}]'")
