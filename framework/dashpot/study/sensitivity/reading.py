"""From the text of a sensitivity study to its declaration; all mistakes are told at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from dashpot.contract.bench import Bench, find_bench, option_text
from dashpot.contract.registry import Registry
from dashpot.fit.study.declaration import StudySpec
from dashpot.fit.study.patterns import chosen, is_wild
from dashpot.fit.study.reading import network_beside, parse_study, read_patterns
from dashpot.model.network import Slot
from dashpot.model.shipped import SUFFIXES, read_specification
from dashpot.study.sensitivity.declaration import FORMAT, Scatter, SensitivitySpec, Variation
from dashpot.text.document import Document
from dashpot.text.form import Form, read_items, read_number, read_quantity
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.node import Node
from dashpot.text.problem import InputError, Problem, nearest

DRAWS = 200


def is_sensitivity(document: Document) -> bool:
    """Whether a text is a sensitivity study, by what its format begins with."""
    root = document.root
    told = root.entries.get("format") if isinstance(root, MappingNode) else None
    return str(getattr(told, "value", "")).startswith(FORMAT.partition("/")[0])


def read_either(path: Path, registry: Registry) -> StudySpec | SensitivitySpec:
    """The staged study or the sensitivity study of a file. InputError with all its mistakes."""
    document = read_specification(path)
    parse = parse_sensitivity if is_sensitivity(document) else parse_study
    return parse(document, path.parent, registry)


def parse_sensitivity(document: Document, folder: Path, registry: Registry) -> SensitivitySpec:
    """The study that a text declares; paths in it are relative to ``folder``. InputError with all its mistakes.

    Examples:
        >>> study = parse_sensitivity(Document.parse(text), Path(), dp.load_registry())
        >>> study.lanes
        1600
    """
    problems: list[Problem] = []
    form = Form(document.root, problems, "the sensitivity study")
    form.choice("format", (FORMAT,))
    name, about, seed = form.name("name"), form.text("about", ""), form.integer("seed", 0)
    word = form.text("network")
    network = network_beside(word, form.place_of("network"), folder, registry, problems) if word else None
    bench = _bench(form, folder, registry)
    metrics = _metrics(form, registry)
    limits = form.take("limits", lambda node: _limits(node, metrics), {})
    reader = _Reader(network.slots() if network else None)
    over_form = form.form("over")
    over = reader.variation(over_form) if over_form else None
    vary = [reader.variation(below) for below in form.forms("vary", []) or ()]
    scatter = [reader.scattered(below) for below in form.forms("scatter", []) or ()]
    draws = form.integer("draws", DRAWS)
    if draws is not None and draws < 2:
        form.complain("draws", f"{form.what}, 'draws': expected at least 2, got {draws}")
    form.close()
    if problems or network is None or bench is None or over is None:
        raise InputError(problems)
    return SensitivitySpec(
        name=name or "",
        about=about or "",
        network=network,
        bench=bench,
        metrics=tuple(registry.metrics[metric] for metric in metrics),
        over=over,
        vary=tuple(each for each in vary if each),
        scatter=tuple(each for each in scatter if each),
        draws=draws or DRAWS,
        seed=seed or 0,
        limits=limits,
    )


def _bench(form: Form, folder: Path, registry: Registry) -> Bench | None:
    word = form.text("rig")
    options = form.take("options", _option_texts, {}) or {}
    if not word:
        return None
    try:
        return find_bench(str(folder / word) if Path(word).suffix in SUFFIXES else word, registry.rigs, options)
    except InputError as error:
        form.problems.extend(error.problems)
    except ValueError as error:
        form.complain("options" if options else "rig", f"{form.what}: {error}")
    return None


def _metrics(form: Form, registry: Registry) -> list[str]:
    known = registry.metrics
    words = form.texts("metrics", [])
    for word in words or ():
        if word not in known:
            hint = nearest(word, known) or f"known here: {', '.join(known)}"
            form.complain("metrics", f"{form.what}: there is no metric '{word}'", hint)
    if words == []:
        form.complain(None, f"{form.what} names no metric", f"add 'metrics: [...]', of {', '.join(known)}")
    return [word for word in words or () if word in known]


def _limits(node: Node, metrics: list[str]) -> Mapping[str, float]:
    entries = _entries(node, "metric: least value")
    for word in entries:
        if word not in metrics:
            raise ValueError(f"'{word}' is none of the metrics of the study; {', '.join(metrics)}")
    return {word: read_number(value) for word, value in entries.items()}


def _option_texts(node: Node) -> dict[str, str]:
    return {name: option_text(value) for name, value in _entries(node, "option: value").items()}


def _entries(node: Node, expected: str) -> Mapping[str, Node]:
    if not isinstance(node, MappingNode):
        raise ValueError(f"expected lines '{expected}', got {node.describe()}")
    return node.entries


class _Reader:
    """Reads what names parameters; ``slots`` are those of the network, None where it could not be read."""

    def __init__(self, slots: tuple[Slot, ...] | None) -> None:
        self._slots = slots

    def variation(self, form: Form) -> Variation | None:
        """Parameters with the values or factors that they take."""
        name = form.text("name")
        slots = self._named(form)
        unit = slots[0].value.unit if slots else ""
        relative = "factors" in form
        if relative == ("values" in form):
            form.complain(None, f"{form.what}: expected either 'values' or 'factors'")
        values: Any
        if relative:
            values = form.take("factors", lambda node: [read_number(item) for item in read_items(node)])
        else:
            values = form.take("values", lambda node: [read_quantity(item, unit) for item in read_items(node)], [])
        form.close()
        if not (name and slots and values):
            return None
        return Variation(name, tuple(slot.path for slot in slots), tuple(values), relative, "" if relative else unit)

    def scattered(self, form: Form) -> Scatter | None:
        """Parameters with how they scatter."""
        slots = self._named(form)
        unit = slots[0].value.unit if slots else ""
        deviation = form.number("deviation", None)
        between = form.take("between", lambda node: _pair(node, unit), None)
        if (deviation is None) == (between is None):
            form.complain(None, f"{form.what}: expected either 'deviation', a share, or 'between', two values")
        if deviation is not None and not 0.0 < deviation < 0.3:
            form.complain("deviation", f"{form.what}: expected a deviation above 0 and below 0.3, got {deviation:g}")
        form.close()
        return Scatter(tuple(slot.path for slot in slots), deviation, between, unit) if slots else None

    def _named(self, form: Form) -> list[Slot]:
        patterns = read_patterns(form, "parameters", None)
        if patterns is None:
            form.complain(None, f"{form.what} lacks 'parameters'", "name one, or a pattern of several")
        if self._slots is None or patterns is None:
            return []
        for message, hint in _wrong(patterns, self._slots):
            form.complain("parameters", f"{form.what}: {message}", hint)
        found = [slot for slot in self._slots if chosen(slot.path, patterns)]
        if len({slot.value.unit for slot in found}) > 1 and "values" in form:
            form.complain(
                "parameters", f"{form.what}: parameters of several units cannot have one value", "say factors"
            )
        return found


def _wrong(patterns: tuple[str, ...], slots: tuple[Slot, ...]) -> Iterator[tuple[str, str]]:
    paths = [slot.path for slot in slots]
    for pattern in patterns:
        if not any(chosen(path, [pattern]) for path in paths):
            hint = "" if is_wild(pattern) else nearest(pattern, paths)
            yield f"there is no parameter '{pattern}'", hint or f"parameters are: {', '.join(paths)}"
    for slot in slots:
        if slot.value.expression and chosen(slot.path, patterns):
            yield f"'{slot.path}' follows from others", f"vary those in '{slot.value.expression}'"


def _pair(node: Node, unit: str) -> tuple[float, float]:
    values = [read_quantity(item, unit) for item in read_items(node)]
    if len(values) != 2 or values[0] >= values[1]:
        raise ValueError(f"expected two values, the lower one first, got {node.describe()}")
    return values[0], values[1]
