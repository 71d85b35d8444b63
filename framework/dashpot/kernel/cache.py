"""Where compiled code is kept: files named by the digest of all that they come from.

What is kept is executed later. So it lies in a folder that nobody but this user may enter, and machine code carries a
digest with a key that lies there, too: what somebody else has put in is as good as nothing. Where no such folder can be
had, one is made that lasts as long as the process.
"""

from __future__ import annotations

import atexit
import hmac
import os
import secrets
import shutil
import stat
import tempfile
from functools import cache
from pathlib import Path

KEY = "key"
PRIVATE = 0o700
DIGEST = 32  # bytes


def cache_folder() -> Path:
    """``DASHPOT_CACHE``, or ``dashpot`` in the user's cache folder."""
    given = os.environ.get("DASHPOT_CACHE")
    if given:
        return Path(given)
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return (Path(base) if base else Path.home() / ".cache") / "dashpot"


def kernel_folder() -> Path:
    """The folder of compiled networks: ``kernels`` in the cache folder, or one for this process alone."""
    return _own_folder(cache_folder() / "kernels")


@cache
def _own_folder(folder: Path) -> Path:
    """The folder itself, made and closed to others; one for this process alone where that cannot be."""
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=PRIVATE)
        if is_own(folder):
            folder.chmod(PRIVATE)
            return folder
    except OSError:
        pass
    return passing_folder()


@cache
def passing_folder() -> Path:
    """A folder that is removed when the process ends."""
    folder = tempfile.mkdtemp(prefix="dashpot-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)


def is_own(path: Path) -> bool:
    """Whether a file or folder belongs to this user and is no link to anything else."""
    found = path.lstat()
    return not stat.S_ISLNK(found.st_mode) and (os.name != "posix" or found.st_uid == os.geteuid())


def keep(file: Path, content: bytes) -> bool:
    """Write a file so that nobody ever reads half of it; whether there was room and the right to do so."""
    try:
        handle, temporary = tempfile.mkstemp(dir=file.parent, suffix=".part")  # readable for this user alone
        try:
            with os.fdopen(handle, "wb") as stream:
                stream.write(content)
            os.replace(temporary, file)
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise
    except OSError:
        return False
    return True


def keep_sealed(file: Path, content: bytes) -> None:
    """Write a file with the digest by which this user knows it again; where it cannot be written it is not kept."""
    key = _key(file.parent)
    if key is None:
        key = secrets.token_bytes(DIGEST)
        keep(file.parent / KEY, key)
    keep(file, _digest(key, file.name, content) + content)


def read_sealed(file: Path) -> bytes | None:
    """The content of a file that this user has kept under its name; None where there is none, or anything else."""
    key = _key(file.parent)
    try:
        whole = file.read_bytes()
    except OSError:
        return None
    content = whole[DIGEST:]
    sound = key is not None and hmac.compare_digest(whole[:DIGEST], _digest(key, file.name, content))
    return content if sound else None


def _digest(key: bytes, name: str, content: bytes) -> bytes:
    return hmac.digest(key, name.encode() + b"\0" + content, "sha256")


def _key(folder: Path) -> bytes | None:
    file = folder / KEY
    try:
        key = file.read_bytes()
        return key if is_own(file) and len(key) == DIGEST else None
    except OSError:
        return None
