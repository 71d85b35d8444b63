"""The pages of the elements: one for each family, with the equations, the parameters and the source of every law."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from architecture import written

from building.law import Term, clauses, mathml, symbol
from building.parts import folded, put, raw
from dashpot.text.digits import typeset
from dashpot_elements import FAMILIES

CONVENTION = (
    "Deflection $x > 0$ squeezes, $v$ is its rate and $a$ the rate of that; a force $F > 0$ presses apart. The "
    "equations come from the docstring of each class, the tables from its declarations; below each stands the source "
    "of its law, from which the compiled code is derived."
)


def write_elements(sources: Path, folder: Path) -> None:
    """Write the page of every family: the text that belongs to it, then its laws."""
    folder.mkdir(parents=True, exist_ok=True)
    for family in FAMILIES:
        source = (sources / f"{family}.md").read_text(encoding="utf-8").replace("](../", "](../../")
        put(folder / f"{family}.md", "\n\n".join([source.strip(), *laws(family)]) + "\n")


def overview() -> Iterator[str]:
    """Every law in a line, family by family."""
    made = written.things("elements")
    for family, words in FAMILIES.items():
        yield f"## [{title(family)}](elements/{family}.md)"
        rows = [
            (f"[`{word}`](elements/{family}.md#{word})", written.one_line(made[word]).partition(": ")[0].rstrip("."))
            for word in words
        ]
        yield written.table(("element", "law"), rows)
    names = "\n".join(f"elements/{family}" for family in FAMILIES)
    yield f"```{{toctree}}\n:hidden:\n\n{names}\n```"


def title(family: str) -> str:
    """The heading of the page of a family."""
    source = Path(__file__).resolve().parents[1] / "elements" / f"{family}.md"
    return source.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ")


def laws(family: str) -> Iterator[str]:
    """The laws of a family."""
    made = written.things("elements")
    yield "## Laws"
    yield CONVENTION
    for word in FAMILIES[family]:
        yield from element(word, made[word])


def element(word: str, made: type[Any]) -> Iterator[str]:
    """One element."""
    numbers = {**made.declares.curves, **made.declares.parameters}
    symbols = {key: number.symbol for key, number in numbers.items()}
    yield f"### `{word}`"
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
    yield from folded("The law as it is written", "python", inspect.cleandoc(inspect.getsource(made.step)))


def _clause(clause: list[str | Term], symbols: Mapping[str, str]) -> str:
    pieces = [mathml(piece, symbols) if isinstance(piece, Term) else f"<p>{piece}</p>" for piece in clause]
    return "".join(pieces) if any(isinstance(piece, Term) for piece in clause) else ""


def _inline(text: str) -> str:
    return f"<math>{symbol(text)}</math>" if text else ""
