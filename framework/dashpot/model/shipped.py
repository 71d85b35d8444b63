"""Where the shipped specifications lie: beside the package when installed, at the top of a source checkout."""

from __future__ import annotations

import re
from pathlib import Path

from dashpot.text.document import Document
from dashpot.text.problem import InputError, Place, of_family

SUFFIXES = (".yaml", ".yml")


def spec_folder() -> Path:
    """The folder that holds ``networks/`` and whatever else is declared rather than programmed."""
    package = Path(__file__).resolve().parents[1]
    installed = package / "specs"
    return installed if installed.is_dir() else package.parents[1] / "specs"


def read_specification(path: Path) -> Document:
    """The text of a shipped file or of a user's. Raises InputError where it is not sound YAML."""
    return Document.read(path, ours=path.is_relative_to(spec_folder()))


def shipped_networks() -> dict[str, Path]:
    """The shipped networks by name, family by family: a family is a folder."""
    return {path.stem: path for path in sorted((spec_folder() / "networks").glob("*/*.yaml"))}


def family_of(word: str) -> tuple[str, ...]:
    """The shipped networks of a family: a folder such as ``mounts`` or ``mount``, or what they are called, such as
    ``bushing``, in their name or at the head of what they say about themselves. Fewer than two are none.

    A file or a network of that name comes first.
    """
    shipped, asked = shipped_networks(), word.lower()
    if asked in shipped or Path(word).exists() or not asked.isidentifier():
        return ()
    found = tuple(name for name, path in shipped.items() if path.parent.name in (asked, f"{asked}s"))
    found = found or tuple(name for name, path in shipped.items() if asked in _called(name, path))
    return found if len(found) > 1 else ()


def _called(name: str, path: Path) -> set[str]:
    """The words of a network's name, and of what it calls itself: before the colon of what it says about itself."""
    title, colon, _ = _about(path).strip('"').partition(":")
    head = re.split(r",| of | on ", title)[0] if colon else ""
    return {*name.split("_"), *re.findall(r"[a-z]{4,}", head.lower())}  # no articles


def find_network(path_or_name: str | Path) -> Path:
    """The file of a network given by path or by shipped name. Raises InputError when there is none."""
    path = Path(path_or_name)
    if path.is_dir() and str(path_or_name) not in shipped_networks():
        raise InputError.at(
            Place(str(path)), "expected a network file or a shipped name, got a folder", "name a file in it"
        )
    return path if path.suffix in SUFFIXES or path.is_file() else _find_shipped(str(path_or_name))


def find_used_network(word: str, folder: Path) -> Path:
    """The file of a network that another one in ``folder`` uses: a shipped name, or a file in or below that folder.

    Raises InputError when there is none.
    """
    if Path(word).suffix not in SUFFIXES:
        return _find_shipped(word)
    path = folder / word
    if not path.resolve().is_relative_to(folder.resolve()):
        raise InputError.at(Place(word), f"expected a file in or below {folder}", "move it there")
    return path


def _find_shipped(name: str) -> Path:
    shipped = shipped_networks()
    if name in shipped:
        return shipped[name]
    hint = _told_of(name, shipped) or of_family(name, shipped) or f"shipped networks: {', '.join(shipped)}"
    raise InputError.at(Place(name), "there is no such file and no shipped network of that name", hint)


def _told_of(word: str, shipped: dict[str, Path]) -> str:
    """A question after the networks with a word in their name or in what they say about themselves; empty for none."""
    named = [name for name in shipped if word.lower() in name]
    told = [name for name, path in shipped.items() if name not in named and word.lower() in _about(path).lower()]
    *first, last = [f"'{name}'" for name in (*named, *told)] or [""]
    return f"did you mean {', '.join(first)}{' or ' if first else ''}{last}?" if last else ""


def _about(path: Path) -> str:
    """What a network file says about itself, read without its other lines."""
    found = re.search(r"^about: (.*)", path.read_text(encoding="utf-8"), re.MULTILINE)
    return found[1] if found else ""
