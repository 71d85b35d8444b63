"""A test bench as a file: which procedures it runs with which options, and how it measures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from dashpot.contract.limits import Limits
from dashpot.contract.measuring import Measuring
from dashpot.contract.options import read_options
from dashpot.contract.rig import PlannedRun, Rig
from dashpot.model.shipped import SUFFIXES, read_specification, spec_folder
from dashpot.text.document import Document
from dashpot.text.form import Form
from dashpot.text.node import Node, Scalar, Sequence
from dashpot.text.problem import InputError, Place, Problem, nearest

FORMAT = "dashpot-rig/1"
Made = TypeVar("Made")


@dataclass(frozen=True)
class Bench:
    """Procedures with their options, the measuring chain, and what the rig can do at most."""

    name: str
    rigs: tuple[Rig, ...]
    measuring: Measuring = Measuring()
    about: str = ""
    limits: Limits = Limits()

    def runs(self) -> list[PlannedRun]:
        """The runs of all procedures, as they are planned. InputError when two have the same name."""
        planned = [run for rig in self.rigs for run in rig.runs()]
        twice = sorted({run.name for run in planned if sum(run.name == other.name for other in planned) > 1})
        if twice:
            raise InputError.at(
                Place(),
                f"{self.name}: several runs are called {', '.join(twice)}",
                "no two procedures may plan the same",
            )
        return planned


def shipped_benches() -> dict[str, Path]:
    """The shipped bench files by name."""
    return {path.stem: path for path in sorted((spec_folder() / "rigs").glob("*.yaml"))}


def find_bench(word: str, rigs: Mapping[str, type[Rig]], options: Mapping[str, str] | None = None) -> Bench:
    """The bench of a file or of a shipped name, or the procedure of that word with the given options.

    InputError when there is none, and for every mistake of its file; ValueError for options that do not fit.
    """
    if word in rigs:
        return Bench(word, (rigs[word](**read_options(rigs[word], options or {})),))
    if options:
        raise ValueError(f"options belong to a procedure ({', '.join(rigs)}); those of a bench stand in its file")
    shipped = shipped_benches()
    path = Path(word)
    if path.suffix in SUFFIXES or path.is_file():
        return read_bench(Document.read(path), rigs)
    if word in shipped:
        return read_bench(read_specification(shipped[word]), rigs)
    known = [*rigs, *shipped]
    hint = nearest(word, known) or f"there are: {', '.join(known) or 'none'}"
    raise InputError.at(Place(word), "there is no such file, procedure or shipped bench", hint)


def read_bench(document: Document, rigs: Mapping[str, type[Rig]]) -> Bench:
    """The bench that a text declares. InputError with all its mistakes."""
    problems: list[Problem] = []
    form = Form(document.root, problems, "the bench")
    form.choice("format", (FORMAT,))
    name, about = form.name("name"), form.text("about", "")
    tests = form.forms("tests")
    if tests == []:
        form.complain("tests", "expected at least one test, got an empty list", "add one, e.g. '- {rig: WORD}'")
    procedures = [_procedure(below, rigs) for below in tests or ()]
    chain, ends = form.form("measuring", default=None), form.form("limits", default=None)
    measuring = made_from(chain, Measuring) if chain else Measuring()
    limits = made_from(ends, Limits) if ends else Limits()
    form.close()
    if problems:
        raise InputError(problems)
    return Bench(name, tuple(rig for rig in procedures if rig), measuring or Measuring(), about, limits or Limits())


def _procedure(form: Form, rigs: Mapping[str, type[Rig]]) -> Rig | None:
    word = form.choice("rig", tuple(rigs))
    return made_from(form, rigs[word]) if word else None


def made_from(form: Form, made: type[Made]) -> Made | None:
    """A thing made with what the form still holds as its options; what is wrong is noted in the form."""
    texts = {key: form.take(key, option_text) for key in form.rest}
    if None in texts.values():
        return None
    try:
        return made(**read_options(made, texts))
    except ValueError as error:
        form.complain(None, f"{form.what}: {error}")
        return None


def option_text(node: Node) -> str:
    """The text of an option: a scalar as written, a list with commas. ValueError for anything else."""
    if isinstance(node, Sequence):
        return ", ".join(_item_text(item) for item in node.items)
    if isinstance(node, Scalar) and node.value is not None:
        return node.written
    raise ValueError(f"expected a number, a text or a list, got {node.describe()}")


def _item_text(node: Node) -> str:
    text = "" if isinstance(node, Sequence) else option_text(node)
    if not text or "," in text:
        raise ValueError(
            f"expected a list of single numbers or texts, got in it {node.describe()}; the decimal sign is a point"
        )
    return text
