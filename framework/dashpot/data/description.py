"""What a dataset file says as a whole."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Mapping as MappingOf
from dataclasses import dataclass, field
from pathlib import Path

from dashpot.data.declaration import RunDeclaration, name_of, read_declaration, stem_of
from dashpot.data.inherit import inherit
from dashpot.data.reference import Reference, read_references
from dashpot.data.source import DESCRIPTIONS, Source
from dashpot.data.stiffness_table import TableDeclaration, read_table_declaration
from dashpot.text.document import Document
from dashpot.text.form import REQUIRED, Form, read_items
from dashpot.text.node import Mapping, Node, Scalar, Sequence
from dashpot.text.problem import InputError, Place, Problem

FORMAT = "dashpot-dataset/1"

# keys of a dataset that are no keys of a run, also where dataset and run are one
_OWN_KEYS = ("format", "folder", "references")


@dataclass(frozen=True)
class Description:
    """The sound declarations of a dataset, the names of all its runs, and the problems found in its text.

    `folder` is what the text says about where the measured files lie, None for beside it; `references` are what was
    measured by other means, by the path of the parameter.
    """

    name: str
    folder: str | None
    declarations: tuple[RunDeclaration, ...]
    names: tuple[str, ...]
    problems: tuple[Problem, ...]
    tables: tuple[TableDeclaration, ...] = ()
    references: MappingOf[str, Reference] = field(default_factory=dict)


def is_dataset(path: Path) -> bool:
    """Whether a path is a folder with a dataset file, a measured file with its sidecar, or a file that says it is one.

    Raises InputError for broken YAML.
    """
    if path.is_dir():
        return any((path / name).is_file() for name in DESCRIPTIONS)
    if path.suffix not in (".yaml", ".yml"):
        return path.is_file() and path.with_name(path.name + ".yaml").is_file()
    root = Document.read(path).root if path.is_file() else None
    stated = root.entries.get("format") if isinstance(root, Mapping) else None
    return isinstance(stated, Scalar) and stated.written.startswith(FORMAT.partition("/")[0])


def read_description(document: Document, source: Source) -> Description:
    """Everything a dataset file says. Raises InputError when it is no dataset file."""
    problems: list[Problem] = []
    form = Form(document.root, problems, "the dataset")
    form.choice("format", (FORMAT,))
    if problems:
        raise InputError(problems)
    name = form.text("name", stem_of(source.file or source.folder.resolve().name))
    folder = form.text("folder", None)
    if form.node("allow_outside") is not None:
        form.complain(
            "allow_outside",
            "a dataset cannot allow itself to read files elsewhere",
            "say --allow-outside on the command line instead, where you trust it",
        )
    tables, references = _tables(form), read_references(form)
    many = "runs" in form or "tables" in form or not source.file
    nodes, defaults = _many_runs(form) if many else _single_run(form)
    form.close()
    declarations = tuple(_declare(nodes, defaults, source.file, problems))
    names = tuple(filter(None, (name_of(node, source.file) for node in nodes)))
    return Description(name, folder, declarations, names, tuple(problems), tables, references)


def _tables(form: Form) -> tuple[TableDeclaration, ...]:
    found: dict[str, TableDeclaration] = {}
    for below in form.forms("tables", None) or ():
        declared = read_table_declaration(below)
        if declared and declared.name in found:
            below.complain("name", f"table '{declared.name}' is set aside: another one has the same name", "rename one")
        elif declared:
            found[declared.name] = declared
    return tuple(found.values())


def _many_runs(form: Form) -> tuple[tuple[Node, ...], Mapping | None]:
    given = form.take("defaults", _read_defaults, None)
    sensors = form.node("sensors")
    if sensors is not None:
        common = Mapping(form.place, 0, 0, {"sensors": sensors}, {"sensors": sensors})
        given = inherit(given, common) if given else common
    return (form.take("runs", read_items, () if "tables" in form else REQUIRED) or ()), given


def _read_defaults(node: Node) -> Mapping:
    if not isinstance(node, Mapping):
        raise ValueError(f"expected the defaults as 'key: value' lines, got {node.describe()}")
    return node


def _single_run(form: Form) -> tuple[tuple[Node, ...], Mapping | None]:
    """The whole text declares one run."""
    entries = {key: form.node(key) for key in form.keys if key not in (*_OWN_KEYS, "allow_outside")}
    return (Mapping(form.place, form.origin.start, form.origin.end, entries, entries),), None


def _declare(
    nodes: tuple[Node, ...], defaults: Mapping | None, file: str | None, problems: list[Problem]
) -> Iterator[RunDeclaration]:
    """The sound declarations. What is wrong in the defaults is told once, not for every run."""
    given = set(_places(defaults)) if defaults else set()
    told: set[tuple[Place, str]] = set()
    names: dict[str, RunDeclaration] = {}
    for order, node in enumerate(nodes):
        declaration, found = read_declaration(node, defaults, file, order)
        problems += [p for p in found if p.place not in given or (p.place, p.hint) not in told]
        told.update((problem.place, problem.hint) for problem in found)
        if declaration and declaration.name in names:
            problems.append(_same_name(declaration, names[declaration.name]))
        elif declaration:
            names[declaration.name] = declaration
            yield declaration


def _same_name(declaration: RunDeclaration, first: RunDeclaration) -> Problem:
    line = first.place("").line
    message = f"run '{declaration.name}' is set aside: a run in line {line} has the same name"
    return Problem(declaration.place("name"), message, "rename one of them")


def _places(node: Node) -> Iterator[Place]:
    yield node.place
    if isinstance(node, Mapping):
        for key, value in node.entries.items():
            yield node.keys[key].place
            yield from _places(value)
    elif isinstance(node, Sequence):
        for item in node.items:
            yield from _places(item)
