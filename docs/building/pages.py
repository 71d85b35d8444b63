"""The pages that come from the registry, the public names and the kept results."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from architecture import written

import dashpot
from building import elements, formats
from building.accuracy import accuracy, kept_results
from building.api import python
from building.parts import folded, inline_picture, put, raw
from dashpot.model.shipped import shipped_networks
from dashpot.report.schematic.svg import svg

ROOT = Path(__file__).resolve().parents[2]


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
    "elements": _section(
        "Elements",
        "The laws of branches, by what they stand for. A plugin adds [laws of its own](../how-to/own-element.md). "
        "[Which model for my data](../which-model.md) begins with what was measured.",
        elements.overview,
    ),
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
        formats.overview,
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
