"""The results of a run as Markdown, what they are held against, and where they are kept."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from axle import AXLE
from counting import REGISTERS
from parts import write_part
from peers import NUMBALSODA, SUNDIALS
from workload import LANES, NETWORK

RESULTS, FIGURE = Path(__file__).parent / "results", "growth.svg"
SWARM, AXLES, BY_HAND = f"{NETWORK}, {LANES} lanes", f"{AXLE}, 64 lanes", f"C by hand, {LANES} lanes"

Content = dict[str, Any]
# what, the goal in words, the figure, whether it is met
Goal = tuple[str, str, float, bool]


def table(content: Content) -> str:
    """The results as Markdown."""
    return "\n\n".join(["\n".join(lines) for lines in _parts(content)])


def _parts(content: Content) -> Iterator[list[str]]:
    yield [_head(content)]
    rows = [
        f"| {what} | {goal} | {found:.3g} | {'yes' if met else 'no'} |" for what, goal, found, met in goals(content)
    ]
    yield ["| goal | wanted | found | met |", "| --- | ---: | ---: | --- |", *rows]
    for work, first in (("W1", SWARM), ("W2", AXLES)):
        base = _row(content, work, first)["ns"]
        rows = [f"| {row['who']} | {row['ns']:.3g} | {row['ns'] / base:.3g} | {_error(row)} |" for row in content[work]]
        yield [f"| {work} | ns per lane and sample | ratio | error rms in N |", "| --- | ---: | ---: | ---: |", *rows]
    rows = [
        f"| {what} | {_told(counts)} | {_told(spent)} | {uneven(counts, spent):.0%} |"
        for what, (counts, spent) in growth(content).items()
    ]
    yield [
        "| growth with | how many | ms | largest distance from a straight line |",
        "| --- | --- | --- | ---: |",
        *rows,
    ]
    rows = [f"| {row['who']} | {row['ns']:.3g} | {row['sum_ns']:.3g} | {row['ratio']:.2f} |" for row in content["sums"]]
    yield ["| network | ns | sum of its branches alone | ratio |", "| --- | ---: | ---: | ---: |", *rows]
    rows = [f"| {who} | {' | '.join(map(str, found.values()))} |" for who, found in content["vectors"].items()]
    yield [f"| instructions that use | {' | '.join(REGISTERS)} |", "| --- | ---: | ---: | ---: |", *rows]
    if content["instructions"]:
        rows = [f"| {name} | {number:.1f} |" for name, number in content["instructions"].items()]
        yield ["| instructions per lane and sample, AVX2 | |", "| --- | ---: |", *rows]
    rows = [f"| {what} | {seconds:.3g} |" for what, seconds in content["start"].items()]
    yield ["| start | s |", "| --- | ---: |", *rows]


def growth(content: Content) -> dict[str, tuple[list[float], list[float]]]:
    """How many there are and what they take in ms, by what there are more and more of."""
    found: dict[str, tuple[list[float], list[float]]] = {}
    for row in content["growth"]:
        counts, spent = found.setdefault(row["what"], ([], []))
        counts.append(row["count"])
        spent.append(row["ms"])
    return found


def uneven(counts: Sequence[float], spent: Sequence[float]) -> float:
    """The largest distance from the best straight line, in parts of the largest value."""
    away = np.polyval(np.polyfit(counts, spent, 1), counts) - spent
    return float(np.abs(away).max() / max(spent))


def _told(numbers: Sequence[float]) -> str:
    return ", ".join(f"{number:.3g}" if isinstance(number, float) else str(number) for number in numbers)


def _head(content: Content) -> str:
    versions = ", ".join(f"{name} {found}" for name, found in content["versions"].items())
    absent = f" Not installed: {', '.join(content['missing'])}." if content["missing"] else ""
    before, after = content["load"]
    machine = f"{content['machine']['processor']}, {content['machine']['cores']} cores"
    sweeps = f"{content['sweeps']} sweeps of {content['seconds']:g} s"
    return (
        f"{content['date']}, {machine}; {versions}.{absent} W1: {sweeps}, W2: one. Medians of {content['rounds']} "
        f"rounds; integrators on {content['peer_seconds']:g} s of one run. Programs at work in the minute before: "
        f"{before:.1f}, in the last one, with this: {after:.1f}."
    )


def goals(content: Content) -> Iterator[Goal]:
    """What is wanted and what was found."""
    swarm, axle = _row(content, "W1", SWARM), _row(content, "W2", AXLES)
    alone, two = _row(content, "W1", f"{NETWORK}, 1 lane"), _row(content, "W1", f"{SWARM}, 2 threads")
    yield _most("W1, ns per lane and sample", 6.0, swarm["ns"])
    yield _most("W1, error rms in N", 1e-4, swarm["error"])
    if by_hand := _row(content, "W1", BY_HAND):
        yield _most("W1 over C by hand", 2.0, swarm["ns"] / by_hand["ns"])
    yield _most(f"{NETWORK}, 1 lane, ns per sample", 60.0, alone["ns"])
    yield _least("two threads over one", 1.9, swarm["clock_ns"] / two["clock_ns"])
    counted = content["swarm"]
    yield _most(f"swarm of {LANES} x {counted['iterations']}, two threads, s", 30.0, counted["seconds"])
    for work, base, name, times in (
        ("W1", swarm, NUMBALSODA, 400.0),
        ("W1", swarm, SUNDIALS, 5000.0),
        ("W2", axle, NUMBALSODA, 20.0),
        ("W2", axle, SUNDIALS, 20.0),
    ):
        if peer := _row(content, work, name):
            yield _least(f"{work}, {name} over dashpot", times, peer["ns"] / base["ns"])
    worst = max(content["sums"], key=lambda row: row["ratio"])
    yield _most(f"network over the sum of its branches, worst: {worst['who']}", 1.5, worst["ratio"])
    start = content["start"]
    yield _most("import, s", 0.3, start["import dashpot"])
    yield _most(f"{NETWORK} cold, s", 5.0, start[f"{NETWORK} cold"])
    yield _most(f"{NETWORK} warm, s", 0.3, start[f"{NETWORK} warm"])


def _most(what: str, goal: float, found: float) -> Goal:
    return what, f"at most {goal:g}", found, found <= goal


def _least(what: str, goal: float, found: float) -> Goal:
    return what, f"at least {goal:g}", found, found >= goal


def _row(content: Content, work: str, name: str) -> dict[str, Any]:
    # an integrator's name is followed by its setting
    rows: Sequence[dict[str, Any]] = content[work]
    exact = [row for row in rows if row["who"] == name]
    return next(iter(exact or [row for row in rows if row["who"].startswith(f"{name}, ")]), {})


def _yes(met: bool) -> str:
    return "yes" if met else "no"


def _error(row: dict[str, Any]) -> str:
    return f"{row['error']:.2g}" if "error" in row else ""


def write(content: Content) -> None:
    """Keep the results of this version, and the table in the README beside this file."""
    RESULTS.mkdir(exist_ok=True)
    text = json.dumps(content, indent=1) + "\n"
    (RESULTS / f"{content['versions']['dashpot']}.json").write_text(text, encoding="utf-8")
    write_part("results", f"{table(content)}\n\n![Growth](results/{FIGURE})")
    draw(content, RESULTS / FIGURE)


def draw(content: Content, path: Path) -> None:
    """The growth as a figure, each share of its largest value over its largest number."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.0, 3.6), layout="constrained")
    axes = figure.add_subplot(xlabel="share of the largest number", ylabel="share of the longest time")
    for what, (counts, spent) in growth(content).items():
        axes.plot(np.divide(counts, counts[-1]), np.divide(spent, spent[-1]), "o-", label=f"{what}, up to {counts[-1]}")
    axes.plot([0.0, 1.0], [0.0, 1.0], "k:", linewidth=1.0)
    axes.legend(fontsize="small")
    figure.savefig(path, metadata={"Date": None})
