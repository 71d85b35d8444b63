"""The parts of the documentation that are written from the code: ``python tests/architecture/written.py`` renews them.

They stand between two comments, ``<!-- written: NAME -->`` and ``<!-- end: NAME -->``; what is around them is written
by hand and stays as it is.
"""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, get_args, get_origin

from dashpot.contract.options import kind_and_unit, options_of
from dashpot.contract.registry import load_registry
from dashpot.model.element import Curve, Parameter
from dashpot.text.digits import typeset

ROOT = Path(__file__).resolve().parents[2]
FRAMEWORK = ROOT / "framework" / "dashpot"
DISTRIBUTION = "dashpot"


def things(kind: str) -> Mapping[str, type[Any]]:
    """The built-in things of one kind by word, whatever else is installed."""
    registry = load_registry()
    return {
        word: made
        for word, made in registry.of(kind).items()
        if registry.origin(kind, word).distribution == DISTRIBUTION
    }


def elements() -> Iterator[str]:
    """A section for each element: its law, its numbers, its source."""
    for word, made in things("elements").items():
        declared = made.declares
        yield f"### `{word}`"
        yield from paragraphs(made)
        rows = [_number_row(key, number) for key, number in {**declared.curves, **declared.parameters}.items()]
        yield table(("key", "meaning", "unit", "sensible range, search scale", "default"), rows)
        if declared.states:
            states = [f"{state.about} ({typeset(state.unit)})" for state in declared.states.values()]
            yield f"Memory: {', '.join(states)}."
        if made.source:
            yield f"Source: {made.source}."


def optimizers() -> Iterator[str]:
    """A section for each optimizer: what it does and its options."""
    for word, made in things("optimizers").items():
        yield f"### `{word}`"
        yield from paragraphs(made)
        yield table(("option", "type", "default"), [_option_row(option) for option in options_of(made).values()])


def formats() -> Iterator[str]:
    """A section for each reader: which files it takes and what can be said to it."""
    for word, made in things("formats").items():
        yield f"### `{word}`"
        yield from format_of_files(word, made)


def format_of_files(word: str, made: type[Any]) -> Iterator[str]:
    """Which files a reader takes, what it needs, what it does, and what may be said under ``file_options``."""
    endings = ", ".join(f"`{suffix}`" for suffix in made.suffixes)
    taken = (
        f"Files ending in {endings}." if endings else f"No ending of its own: `reader: {word}` under a run names it."
    )
    yield taken + (f" Needs `pip install 'dashpot[{made.extra}]'`." if made.extra else "")
    yield from paragraphs(made)
    if made.options:
        yield table(("file option", "meaning"), [(f"`{key}`", meaning) for key, meaning in made.options.items()])


def causes() -> Iterator[str]:
    """A section for each cause: how it shows, what is tried, and the tests that distinguish it from others."""
    for word, made in things("causes").items():
        yield f"### `{word}`"
        yield f"Class `{made.kind}`: {made.about}. " + " ".join(paragraphs(made))
        lines = [f"- How it shows: {made.shows}.", f"- What is tried: {one_line(made.suspects)}"]
        lines += [f"- Test against `{other}`: {telling}." for other, telling in made.confused_with.items()]
        yield "\n".join(lines)


def specimens() -> Iterator[str]:
    """A section for each virtual specimen."""
    for word, made in things("specimens").items():
        yield f"### `{word}`"
        yield f"Stands for {made.about}. " + " ".join(paragraphs(made))


def rigs() -> Iterator[str]:
    """A section for each test procedure: what it does and its options."""
    for word, made in things("rigs").items():
        yield f"### `{word}`"
        yield from paragraphs(made)
        yield table(("option", "type", "default"), [_option_row(option) for option in options_of(made).values()])


def exports() -> Iterator[str]:
    """A section for each target that a network is written for, with its options."""
    for word, made in things("exports").items():
        yield f"### `{word}`"
        yield from paragraphs(made)
        if options_of(made):
            yield table(("option", "type", "default"), [_option_row(option) for option in options_of(made).values()])


def metrics() -> Iterator[str]:
    """A section for each number that a test is made for."""
    for word, made in things("metrics").items():
        yield f"### `{word}`"
        yield f"In {typeset(made.unit)}. " + " ".join(paragraphs(made))


def modules() -> Iterator[str]:
    """A list for each package of the framework: its modules, each with the first paragraph of its docstring."""
    for layer in sorted(path.parent for path in FRAMEWORK.glob("*/__init__.py")):
        found = sorted(path for path in layer.rglob("*.py") if path.name != "__init__.py")
        names = [path.relative_to(layer).with_suffix("").as_posix() for path in found]
        lines = [f"- `{name}` {_module_line(path)}" for name, path in zip(names, found, strict=True)]
        yield f"### `{layer.name}/`"
        yield "\n".join([_module_line(layer / "__init__.py"), "", *lines])


PAGES: Mapping[str, Mapping[str, Callable[[], Iterator[str]]]] = {
    "plugins/README.md": {
        "elements": elements,
        "optimizers": optimizers,
        "formats": formats,
        "causes": causes,
        "specimens": specimens,
        "rigs": rigs,
        "exports": exports,
        "metrics": metrics,
    },
}


def renewed(page: str) -> str:
    """The text of a page with everything between the comments as the code has it now."""
    text = (ROOT / page).read_text(encoding="utf-8")
    for name, write in PAGES[page].items():
        begin, end = f"<!-- written: {name} -->", f"<!-- end: {name} -->"
        if text.count(begin) != 1 or text.count(end) != 1:
            raise ValueError(f"{page}: expected one pair of the comments {begin} and {end}")
        head, rest = text.split(begin)
        text = head + "\n\n".join([begin, *write(), end]) + rest.split(end)[1]
    return text


def table(titles: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """A table in Markdown; empty columns are left out."""
    columns = [column for column in zip(titles, *rows, strict=True) if any(column[1:])]
    head, *body = (" | ".join(cell.replace("|", r"\|") for cell in row) for row in zip(*columns, strict=True))
    return "\n".join(f"| {line} |" for line in (head, " | ".join("---" for _ in columns), *body))


def paragraphs(made: object) -> Iterator[str]:
    """The docstring of a class in Markdown."""
    text = inspect.cleandoc(made.__doc__ or "").replace("``", "`")
    yield from (" ".join(part.split()) for part in re.split(r"\n\s*\n", text))


def one_line(made: object) -> str:
    """The first paragraph of a docstring."""
    return next(paragraphs(made))


def _number_row(key: str, number: Parameter | Curve) -> tuple[str, ...]:
    low, high = number.bounds
    span = f"{_short(low)} to {_short(high)}, {number.scale}"
    if isinstance(number, Curve):
        (value, unit), (over, over_unit) = number.value, number.over
        slope = f"{unit}/({over_unit})" if "/" in over_unit else f"{unit}/{over_unit}"
        return f"`{key}`", number.about, typeset(f"{slope}; table: `{over}` {over_unit}, `{value}` {unit}"), span, ""
    default = "" if number.default is None else _short(number.default)
    return f"`{key}`", number.about, typeset(number.unit), span, default


def _short(number: float) -> str:
    """``1e7`` for 1e+07, as one types it."""
    return re.sub(r"e\+?(-?)0*", r"e\1", f"{number:g}")


def _option_row(option: inspect.Parameter) -> tuple[str, str, str]:
    kind, unit = kind_and_unit(option.annotation)
    many, default = get_origin(kind) is tuple, option.default
    name = get_args(kind)[0].__name__ if many else kind.__name__
    shown = ", ".join(map(repr, default)) if many else repr(default) if not isinstance(default, str) else default
    return f"`{option.name}`", ("list of " * many + name) + (f", {typeset(unit)}" if unit else ""), f"`{shown}`"


def _module_line(path: Path) -> str:
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return " ".join(text.split("\n\n")[0].split()).replace("``", "`")


if __name__ == "__main__":
    for page in PAGES:
        (ROOT / page).write_text(renewed(page), encoding="utf-8")
