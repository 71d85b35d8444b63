"""Printing a network with unknown nodes as a self-contained file of numba code.

The equilibrium is found first. Then every sample is reached twice, in few long steps and in twice as many short ones:
their difference tells the error and takes its leading term away (Richardson). A step is a chain of passes over the
lanes: predict, improve until every lane is done, commit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from dashpot.expr.node import Node
from dashpot.kernel.layout import Layout, Shelf
from dashpot.kernel.mechanics import DONE, Equations, force_row, row_of
from dashpot.kernel.prelude import PRELUDE
from dashpot.kernel.source import WIDTH, indented, print_pass, renumbered
from dashpot.kernel.tiers import Program

MOST_STEPS, MOST_STATIC_STEPS = 40, 400
UNSOLVED, UNBALANCED = 1, 2

_ARGUMENTS = ("still, coarse, fine, per, samples, space, status, lanes, tables, knots, measured, weight, out, miss, "
              "scoring")  # fmt: skip
_TYPES = ("float64[:,::1], float64[:,::1], float64[:,::1], int64, int64, float64[::1], int64[::1], int64, "
          "float64[::1], float64[::1], float64[:,::1], float64[:,::1], float64[:,:,::1], float64[:,::1], "
          "boolean")  # fmt: skip


class SystemLayouts:
    """The passes of a network with the rows that they use."""

    def __init__(self, program: Program, equations: Equations, shelves: Mapping[str, Shelf],
                 passes: Mapping[str, Mapping[str, Node]]) -> None:  # fmt: skip
        self.equations = equations
        self.layouts = {name: Layout(program, rows, shelves=shelves) for name, rows in passes.items()}

    @property
    def rows(self) -> int:
        """How many rows the workspace needs."""
        return max(layout.rows for layout in self.layouts.values())

    def row(self, name: str) -> int:
        """The number of a row."""
        return next(iter(self.layouts.values())).states[name]


def print_system(layouts: SystemLayouts, driven: Sequence[str], unknown: Sequence[str]) -> str:
    """The source file: the function ``run``.

    ``still`` (1, columns), ``coarse`` and ``fine`` (steps, columns) are what drives the steps, ``per`` is the number of
    coarse steps in a sample, ``space`` is a workspace for each of the two, ``status`` (lanes,) stays 0 where all goes
    well. Without ``scoring`` it fills ``out`` (samples, driven nodes then unknown nodes, lanes); with it, it adds
    weight * (force - measured)^2 to the first of ``out``, the other two being (driven nodes, samples). ``miss`` (driven
    nodes, lanes) gathers the squared differences of the forces of the two courses.
    """
    forces = [layouts.row(force_row(joint)) for joint in driven]
    places = [layouts.row(row_of(joint, "position")) for joint in unknown]
    store = [line for number, row in enumerate([*forces, *places]) for line in _stored(number, row)]
    score = [line for number, row in enumerate(forces) for line in _scored(number, row)] or ["pass"]
    begin = [_call("start", "still"), *_newton(layouts, "settle", "still", MOST_STATIC_STEPS, UNBALANCED),
             _call("rest", "still")]  # fmt: skip
    step = [_call("predict", "columns"), *_newton(layouts, "improve", "columns", MOST_STEPS, UNSOLVED),
            _call("commit", "columns")]  # fmt: skip
    course = ["w = space[course * half : (course + 1) * half]", "columns, count = coarse, per", "if course == 1:",
              "    columns, count = fine, 2 * per", "if k == 0:", "    j = 0", *indented(4, begin), "else:",
              "    for j in range((k - 1) * count, k * count):", *indented(8, step)]  # fmt: skip
    body = ["for course in range(2):", *indented(4, course), "if scoring:", *indented(4, score), "else:",
            *indented(4, store)]  # fmt: skip
    return renumbered("\n".join([
        f'"""Network kernel: {len(driven)} driven nodes, {len(unknown)} unknown ones."""', PRELUDE,
        *(_pass(layouts, name) for name in layouts.layouts),
        f'@njit("void({_TYPES})", cache=True, **LOOP)', f"def run({_ARGUMENTS}):",
        "    use_full_vectors()", "    lanes = lanes & -8", f"    half = {WIDTH * layouts.rows}",
        "    for k in range(samples):", *indented(8, body),
    ])) + "\n"  # fmt: skip


def _pass(layouts: SystemLayouts, name: str) -> str:
    # a function of its own: the compiler's work grows faster than the length of a function
    types = "void(float64[:,::1], int64, float64[::1], int64, float64[::1], float64[::1])"
    lines = print_pass(layouts.layouts[name], "columns[j", []) or ["pass"]
    return "\n".join([f'@njit("{types}", cache=True, **LOOP)', f"def {name}(columns, j, w, lanes, tables, knots):",
                      "    use_full_vectors()", "    lanes = lanes & -8", *indented(4, lines)]) + "\n"  # fmt: skip


def _call(name: str, columns: str) -> str:
    return f"{name}({columns}, j, w, lanes, tables, knots)"


def _newton(layouts: SystemLayouts, name: str, columns: str, most: int, failure: int) -> list[str]:
    done = f"w[{WIDTH * layouts.row(DONE)} + l]"
    count = ["left = 0.0", "for l in range(lanes):", f"    left += 1.0 - {done}", "if left == 0.0:", "    break"]
    return ["left = 0.0", f"for i in range({most}):", *indented(4, [_call(name, columns), *count]),
            "if left > 0.0:", "    for l in range(lanes):", f"        if {done} == 0.0:",
            f"            status[l] = {failure}"]  # fmt: skip


def _stored(number: int, row: int) -> list[str]:
    return ["for l in range(lanes):", f"    gap = space[half + {WIDTH * row} + l] - space[{WIDTH * row} + l]",
            f"    out[k, {number}, l] = space[half + {WIDTH * row} + l] + gap * 0.3333333333333333",
            f"    miss[{number}, l] += gap * gap"]  # fmt: skip


def _scored(number: int, row: int) -> list[str]:
    return [f"target, weigh = measured[{number}, k], weight[{number}, k]", "for l in range(lanes):",
            f"    gap = space[half + {WIDTH * row} + l] - space[{WIDTH * row} + l]",
            f"    away = space[half + {WIDTH * row} + l] + gap * 0.3333333333333333 - target",
            f"    out[0, {number}, l] += weigh * (away * away)", f"    miss[{number}, l] += gap * gap"]  # fmt: skip
