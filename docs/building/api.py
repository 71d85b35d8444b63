"""The page of the public names of Python: signatures, docstrings, and examples that run as tests."""

from __future__ import annotations

import doctest
import inspect
from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass
from functools import cached_property
from typing import Any

from architecture import written

import dashpot

WIDTH = 80  # characters that a line of code has room for


def python() -> Iterator[str]:
    """Every public name with its docstring; the examples run as a test, one after the other."""
    yield "# Python"
    yield (
        "Every name below is an attribute of `dashpot`; the examples write `import dashpot as dp`. They are run one "
        "after the other in a folder with the dataset `mount/` and the model `mount.yaml`, and go on from one another."
    )
    for home, names in public_names().items():
        yield f"## {home}"
        for name in names:
            yield f"### `{name}`"
            yield from documented(name, getattr(dashpot, name))
    yield from hooks()


def hooks() -> Iterator[str]:
    """The functions that a plugin may implement, as the framework declares them."""
    from dashpot.contract import hooks as declared

    functions = {name: made for name, made in vars(declared).items() if name.startswith("dashpot_")}
    yield "## Hooks of a plugin"
    yield from docstring(declared.__doc__ or "")
    rows = [
        (f"`{name}`", f"`{inspect.signature(made).return_annotation}`", inspect.cleandoc(made.__doc__ or ""))
        for name, made in functions.items()
    ]
    yield written.table(("hook", "returns", "what"), rows)


def public_names() -> Mapping[str, list[str]]:
    """The public names by what they are for."""
    titles = {"notebook": "In a notebook", "data": "Runs", "text": "Errors", "kernel": "Energy", "fit": "Studies"}
    found: dict[str, list[str]] = {}
    for home, names in dashpot._HOMES.items():
        title = titles.get(home.split(".")[1], "For authors of plugins")
        found.setdefault(title, []).extend(names)
    return found


def documented(name: str, thing: Any) -> Iterator[str]:
    """Signature, words and example of one name; of a result also what it has."""
    of_notebook = inspect.isclass(thing) and ".notebook." in thing.__module__
    if not inspect.isclass(thing) or (is_dataclass(thing) and not of_notebook):
        yield f"```python\n{called(name, inspect.signature(thing))}\n```"
    yield from docstring(thing.__doc__ or "")
    if of_notebook and (members := list(_members(thing))):
        yield written.table(("has", "which is"), members)


def _members(thing: type[Any]) -> Iterator[tuple[str, str]]:
    """The documented members of a class and of the one it is made from."""
    members = {key: member for base in reversed(thing.__mro__[:2]) for key, member in vars(base).items()}
    for key, member in members.items():
        if not key.startswith("_") and (line := _first_line(member)):
            yield f"`{key}`", line


def called(name: str, signature: inspect.Signature) -> str:
    """How a function is called; a long list of arguments stands one below the other."""
    arguments = [_argument(argument) for argument in signature.parameters.values()]
    kinds = [argument.kind for argument in signature.parameters.values()]
    if inspect.Parameter.KEYWORD_ONLY in kinds:
        arguments.insert(kinds.index(inspect.Parameter.KEYWORD_ONLY), "*")
    answer = "" if signature.return_annotation in (None, "None") else f" -> {signature.return_annotation}"
    line = f"dp.{name}({', '.join(arguments)}){answer}"
    if len(line) < WIDTH:
        return line
    lines = "".join(f"    {argument},\n" for argument in arguments)
    return f"dp.{name}(\n{lines}){answer}"


def _argument(argument: inspect.Parameter) -> str:
    stars = {argument.VAR_POSITIONAL: "*", argument.VAR_KEYWORD: "**"}.get(argument.kind, "")
    if argument.default is argument.empty:
        return f"{stars}{argument.name}: {argument.annotation}"
    shown = "..." if repr(argument.default).startswith("<") else repr(argument.default)
    return f"{argument.name}: {argument.annotation} = {shown}"


def docstring(text: str) -> Iterator[str]:
    """A docstring as Markdown, its example as code."""
    for number, piece in enumerate(inspect.cleandoc(text).replace("``", "`").split("Examples:\n")):
        if number == 0:
            yield piece.strip()
        else:
            yield f"```pycon\n{inspect.cleandoc(piece)}\n```"


def examples(thing: Any) -> list[doctest.Example]:
    """The examples in a docstring."""
    return doctest.DocTestParser().get_examples(inspect.cleandoc(thing.__doc__ or ""))


def _first_line(member: Any) -> str:
    text = member.__doc__ if callable(member) or isinstance(member, property | cached_property) else ""
    return inspect.cleandoc(text or "").split("\n\n")[0].replace("\n", " ").replace("``", "`")
