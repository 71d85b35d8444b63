"""The pages that come from the registry, the public names and the kept results."""

from __future__ import annotations

import doctest
import inspect
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import is_dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import dashpot
from building.law import Term, clauses, mathml, symbol
from dashpot.model.shipped import shipped_networks
from dashpot.report.schematic.svg import svg
from dashpot.text.digits import typeset

ROOT = Path(__file__).resolve().parents[2]
WIDTH = 80  # characters that a line of code has room for
sys.path.insert(0, str(ROOT / "tests"))

from architecture import written  # noqa: E402

from building.accuracy import accuracy, kept_results  # noqa: E402


def elements() -> Iterator[str]:
    """Every element: its equations, its symbols, and what the generated list says."""
    yield "# Elements"
    yield (
        "Deflection $x > 0$ squeezes, $v$ is its rate and $a$ the rate of that; a force $F > 0$ presses apart. The "
        "equations come from the docstring of each class, the tables from its declarations; the last lines are its "
        "source, from which the compiled code is derived."
    )
    for word, made in written.things("elements").items():
        yield from element(word, made)


def element(word: str, made: type[Any]) -> Iterator[str]:
    """One element."""
    numbers = {**made.declares.curves, **made.declares.parameters}
    symbols = {key: number.symbol for key, number in numbers.items()}
    yield f"## `{word}`"
    yield from written.paragraphs(made)
    yield raw("".join(_clause(clause, symbols) for clause in clauses(made)))
    titles = ("symbol", "key", "meaning", "unit", "sensible range, search scale", "default")
    rows = [(_inline(number.symbol), *written._number_row(key, number)) for key, number in numbers.items()]
    yield written.table(titles, rows)
    if made.declares.states:
        states = made.declares.states.values()
        yield f"Memory: {', '.join(f'{state.about} ({typeset(state.unit)})' for state in states)}."
    if made.source:
        yield f"Source: {made.source}."
    yield from folded("What the class says", "python", inspect.cleandoc(inspect.getsource(made.step)))


def networks() -> Iterator[str]:
    """Every shipped network: its schematic, its text."""
    yield "# Shipped networks"
    yield '`dashpot fit NAME ...` takes them by name; `dp.load("NAME")` too. Copy the text to change it.'
    for name, path in shipped_networks().items():
        model = dashpot.load(name)
        yield f"## `{name}`"
        yield f"{model.about} Family: {path.parent.name}."
        yield raw(f'<p class="schematic">{inline_picture(name, svg(model))}</p>')
        if model.source:
            yield f"Source: {model.source}"
        yield from folded("The file", "yaml", path.read_text(encoding="utf-8").rstrip())


def told(words: str) -> Iterator[str]:
    """The help of a verb: what click is told to leave as it is stands as code."""
    for paragraph in words.split("\n\n"):
        title, mark, block = paragraph.partition("\b\n")
        if not mark:
            yield title
            continue
        head, _, rest = block.partition("\n")
        if rest and not head.startswith(" ") and head.endswith(":"):
            yield head
            block = rest
        yield f"```sh\n{inspect.cleandoc(block)}\n```"


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


def public_names() -> Mapping[str, list[str]]:
    """The public names by what they are for."""
    titles = {"notebook": "In a notebook", "kernel": "Energy", "fit": "Studies"}
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


def benchmarks() -> Iterator[str]:
    """The kept benchmark, as its page in the tests has it."""
    folder = ROOT / "tests" / "benchmarks"
    page = re.sub("<!--.*?-->", "", (folder / "README.md").read_text(encoding="utf-8"))
    yield re.sub(
        r"!\[(.*)\]\((.*\.svg)\)", lambda found: raw(inline_picture(found[1], (folder / found[2]).read_text())), page
    )


def masses() -> Iterator[str]:
    """The kept masses of random cars, each with its version and its seed."""
    yield "# How good an identified mass is"
    yield (
        "Cars drawn at random, every other one with rubber top mounts, were measured on virtual rigs that share no "
        "code with dashpot; the study `unsprung_mass` identified the mass of their wheels from the files alone. The "
        "interval is that of the model with the least error on a sweep that it never saw. An error far above the "
        "noise, here 5 N, says that a fit did not converge or that an effect is missing: then the interval is wide."
    )
    for version, found in kept_results("unsprung_mass"):
        yield from _weighed(version, found)


def _weighed(version: str, found: Mapping[str, Any]) -> Iterator[str]:
    cars = found["cars"]
    off = [100.0 * (car["value"] / car["truth"] - 1.0) for car in cars]
    held = sum(car["interval"][0] <= car["truth"] <= car["interval"][1] for car in cars)
    near = sum(abs(each) <= 0.4 for each in off)
    yield f"## {len(cars)} cars of dashpot {version}"
    yield (
        f"Seed {found['seed']}; `python tests/unsprung_mass/run.py --cars {len(cars)} --seed {found['seed']}` repeats "
        f"them. Within 0.4 % of the true mass are {near} of {len(cars)}; the 95 % interval holds it in {held}."
    )
    yield written.table(
        ("car", "top mount (N/mm)", "true (kg)", "found (kg)", "95 % interval (kg)", "off (%)", "error (N)", "model"),
        [
            (
                str(car["number"]),
                f"{1e-3 * car['mount']:.0f}" if car["mount"] else "none",
                f"{car['truth']:.3f}",
                f"{car['value']:.3f}",
                f"{car['interval'][0]:.3f} to {car['interval'][1]:.3f}",
                f"{each:+.2f}",
                f"{car['error']:.2f}",
                f"`{car['model']}`",
            )
            for car, each in zip(cars, off, strict=True)
        ],
    )


def _section(title: str, text: str, write: Callable[[], Iterator[str]]) -> Callable[[], Iterator[str]]:
    def page() -> Iterator[str]:
        yield f"# {title}"
        yield text
        # on a page of their own the things are one level higher
        yield from (part.replace("### `", "## `", 1) if part.startswith("### `") else part for part in write())

    return page


PAGES: Mapping[str, Callable[[], Iterator[str]]] = {
    "elements": elements,
    "networks": networks,
    "causes": _section(
        "Causes",
        "What a diagnosis can name. A plugin adds [causes of its own](../how-to/own-cause.md).",
        written.causes,
    ),
    "optimizers": _section(
        "Optimizers",
        "`--optimizer WORD`, options as `--set OPTION=VALUE`; in Python "
        "`dp.fit(..., optimizer=..., options=...)`. A plugin adds "
        "[methods of its own](../how-to/own-optimizer.md).",
        written.optimizers,
    ),
    "formats": _section(
        "File formats",
        "The ending of a file's name chooses the reader; `reader: WORD` under a run "
        "overrides it. A plugin adds [formats of its own](../how-to/own-format.md).",
        written.formats,
    ),
    "rigs": _section("Rigs", '`dashpot simulate MODEL --rig WORD` or `dp.measure(model, "WORD", ...)`.', written.rigs),
    "exports": _section(
        "Exports",
        "`dashpot export MODEL --to WORD -o OUT`: a network [in other programs](../how-to/use-elsewhere.md).",
        written.exports,
    ),
    "metrics": _section(
        "Metrics",
        "Figures for which a test is made. Comparisons, studies and looks contain "
        "them, and virtual measurements, for every run that is such a test; "
        "[inspection tests](../how-to/inspection-tests.md) shows two.",
        written.metrics,
    ),
    "specimens": _section(
        "Specimens", "Virtual specimens: programs that stand for a part on a rig.", written.specimens
    ),
    "modules": _section(
        "Modules",
        "Every module of the framework, with the first sentence of its docstring; "
        "[the inside](../explanation/inside.md) tells how they work together.",
        written.modules,
    ),
    "python": python,
    "accuracy": accuracy,
    "masses": masses,
    "benchmarks": benchmarks,
}


def write_pages(folder: Path) -> None:
    """Write every page into the folder; a file is touched only when it changes."""
    folder.mkdir(exist_ok=True)
    for name, write in PAGES.items():
        put(folder / f"{name}.md", "\n\n".join(write()) + "\n")


def put(path: Path, text: str) -> None:
    """Write a text unless it is there."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def raw(html: str) -> str:
    """HTML in a page."""
    return f"````{{raw}} html\n{html}\n````"


def folded(title: str, language: str, text: str) -> Iterator[str]:
    """A code block that is opened by a press."""
    yield raw(f"<details><summary>{title}</summary>")
    yield f"```{language}\n{text}\n```"
    yield raw("</details>")


def inline_picture(title: str, drawing: str) -> str:
    """A drawing as an image that is part of the page."""
    from base64 import b64encode

    return f'<img alt="{title}" src="data:image/svg+xml;base64,{b64encode(drawing.encode()).decode()}">'


def _clause(clause: list[str | Term], symbols: Mapping[str, str]) -> str:
    pieces = [mathml(piece, symbols) if isinstance(piece, Term) else f"<p>{piece}</p>" for piece in clause]
    return "".join(pieces) if any(isinstance(piece, Term) for piece in clause) else ""


def _inline(text: str) -> str:
    return f"<math>{symbol(text)}</math>" if text else ""


def _first_line(member: Any) -> str:
    text = member.__doc__ if callable(member) or isinstance(member, property | cached_property) else ""
    return inspect.cleandoc(text or "").split("\n\n")[0].replace("\n", " ").replace("``", "`")
