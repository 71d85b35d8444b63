"""Tables of dynamic stiffness over frequency, amplitude, preload and further conditions: every row becomes a run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from dashpot.data.channel import Channel, read_column
from dashpot.data.columns import common_length, find_columns, read_numbers
from dashpot.data.declaration import SETTING_UNITS, read_file_options, read_name, read_settings
from dashpot.data.run import Run
from dashpot.data.steady import SAMPLES, STEADY, cosine, sine, steady_samples
from dashpot.data.table import Table
from dashpot.data.trouble import Trouble, Unusable, refuse
from dashpot.text.form import Form, read_items, read_text
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.node import Node, Scalar
from dashpot.text.problem import Place
from dashpot.text.quantity import base_unit, factor, si

Array = NDArray[np.float64]

ANSWERS = {"storage": "N/m", "loss": "N/m", "stiffness": "N/m", "loss_angle": "rad", "loss_factor": "1"}
PAIRS = (
    ("storage", "loss"),
    ("stiffness", "loss_angle"),
    ("stiffness", "loss_factor"),
    ("storage", "loss_angle"),
    ("storage", "loss_factor"),
)
NEEDED, CONDITIONS, SCATTER = ("frequency", "amplitude"), ("frequency", "amplitude", "preload"), "scatter"
UNITS = {**ANSWERS, **{key: SETTING_UNITS[key] for key in CONDITIONS}, SCATTER: "N/m"}


@dataclass(frozen=True)
class TableDeclaration:
    """Everything said about a table. ``scatter`` is the standard deviation of its stiffness, and whether as a share;
    ``static`` are deflections (m) and forces (N) of the static curve, by which preloads in N are deflections.

    A condition that is the same in all rows stands under ``settings``; columns of other names are settings of the rows.
    """

    name: str
    file: str
    columns: tuple[Channel, ...]
    settings: Mapping[str, float]
    notes: Mapping[str, str]
    units: Mapping[str, str]
    scatter: tuple[float, bool] | None
    static: tuple[Array, Array] | None
    held_out: bool | None
    reader: str | None
    file_options: Mapping[str, object]
    places: Mapping[str, Place]

    def place(self, key: str) -> Place:
        """Where the value of a key stands; the table itself when it has no such key."""
        return self.places.get(key, self.places[""])


def read_table_declaration(form: Form) -> TableDeclaration | None:
    """The declaration of a table; None when anything is wrong with it, which is noted."""
    before = len(form.problems)
    path = form.text("file")
    settings, notes, units = read_settings(form)
    columns = form.take("columns", lambda node: _read_columns(node, form), {})
    declared = TableDeclaration(
        name=read_name(form, path),
        file=path,
        columns=tuple(columns.values()),
        settings=settings,
        notes=notes,
        units=units,
        scatter=form.take(SCATTER, _read_scatter, None),
        static=_read_static(form.form("static", default=None)),
        held_out=form.flag("held_out", None),
        reader=form.text("reader", None),
        file_options=form.take("file_options", read_file_options, {}),
        places={key: form.place_of(key) for key in form.keys} | {"": form.place},
    )
    form.close()
    if len(form.problems) == before:
        _check(form, set(columns), set(settings))
    return declared if len(form.problems) == before else None


def read_table(declaration: TableDeclaration, table: Table, order: int) -> tuple[list[Run], list[Trouble]]:
    """The rows of a table as runs, the first with number ``order``, and what was left out.

    Raises Unusable with the reasons to set the table aside. A row without all its numbers is left out.
    """
    columns = find_columns(table, declaration.columns)
    count = common_length(table, columns)
    values = {each.name: _in_si(table, each, columns[each.name], count) for each in declaration.columns}
    values |= _deflected(declaration, table, columns, values)
    shares = {each.name: _is_share(table, each, columns[each.name]) for each in declaration.columns}
    whole = np.isfinite(list(values.values())).all(axis=0)
    conditions = {
        **dict.fromkeys(CONDITIONS, np.zeros(count)),
        **{key: np.full(count, value) for key, value in declaration.settings.items()},
        **{key: column for key, column in values.items() if key not in (*ANSWERS, SCATTER)},
    }
    refuse(
        Trouble(f"expected a {key} above 0, got {conditions[key][row]:g} in {table.where(row)}", "correct the table")
        for key in NEEDED
        for row in np.flatnonzero(whole & ~(conditions[key] > 0.0))[:1]
    )
    if not whole.any():
        raise Unusable([Trouble("none of its rows has all numbers", "check its columns")])
    answers = complex_stiffness(values)
    deviations = _deviations(declaration, values, shares, np.abs(answers))
    runs = [
        _run(
            declaration,
            row,
            {key: float(column[row]) for key, column in conditions.items()},
            answers[row],
            None if deviations is None else float(deviations[row]),
            order + number,
        )
        for number, row in enumerate(np.flatnonzero(whole).tolist())
    ]
    missing = np.flatnonzero(~whole)
    left_out = f"{missing.size} of its rows lack a number and are left out, the first is " if missing.size else ""
    return runs, [Trouble(left_out + table.where(row), "", severity="warning") for row in missing[:1].tolist()]


def complex_stiffness(values: Mapping[str, Array]) -> NDArray[np.complex128]:
    """K' + i K'' in N/m out of one of the ``PAIRS`` of columns, angles in rad."""
    one, other = next(pair for pair in PAIRS if set(pair) <= set(values))
    first, second = values[one], values[other]
    if other == "loss":
        return np.asarray(first + 1j * second)
    slope = np.tan(second) if other == "loss_angle" else second
    if one == "storage":
        return np.asarray(first * (1.0 + 1j * slope))
    return np.asarray(first * np.exp(1j * (second if other == "loss_angle" else np.arctan(second))))


def _read_columns(node: Node, form: Form) -> dict[str, Channel]:
    if not isinstance(node, MappingNode):
        raise ValueError(f"expected 'frequency: {{column: ..., unit: Hz}}' and so on, got {node.describe()}")
    found = {}
    for name, entry in node.entries.items():
        if isinstance(entry, Scalar):
            found[name] = Channel(name, read_column(entry), entry.place)
            continue
        below = Form(entry, form.problems, f"the column '{name}'")
        unit = below.take("unit", partial(_read_unit, name=name), None)
        found[name] = Channel(name, below.take("column", read_column, name), below.place, unit)
        below.close()
    return found


def _read_unit(node: Node, name: str) -> str:
    unit = read_text(node)
    _factor(unit, name)
    return unit


def _factor(unit: str, name: str) -> tuple[float, float]:
    """Factor and zero that bring a column to SI; ValueError for a unit of another kind."""
    if name == "preload" and base_unit(unit) == base_unit("N"):
        return factor(unit, "N")
    if name == SCATTER and base_unit(unit) == base_unit("%"):
        return factor(unit, "1")
    return factor(unit, UNITS.get(name, base_unit(unit)))


def _read_static(form: Form | None) -> tuple[Array, Array] | None:
    if form is None:
        return None
    axes = [form.take(key, partial(_read_axis, unit=unit)) for key, unit in (("deflection", "m"), ("force", "N"))]
    form.close()
    if any(axis is None for axis in axes):
        return None
    deflection, force = (np.array(axis) for axis in axes)
    if deflection.size != force.size or force.size < 2 or min(np.diff(deflection).min(), np.diff(force).min()) <= 0.0:
        form.complain(None, f"{form.what}: expected two numbers or more in each list, as many and both growing")
    return deflection, force


def _read_axis(node: Node, unit: str) -> list[float]:
    return [si(read_text(item), unit) for item in read_items(node)]


def _deflected(
    declaration: TableDeclaration, table: Table, columns: Mapping[str, str], values: Mapping[str, Array]
) -> dict[str, Array]:
    """The preloads in m where they are told in N. Raises Unusable without a static curve, and for one beyond it."""
    told = next((each for each in declaration.columns if each.name == "preload"), None)
    unit = (told.unit or table.units.get(columns["preload"])) if told else None
    if told is None or unit is None or base_unit(unit) != base_unit("N"):
        return {}
    if declaration.static is None:
        hint = "give the deflections at these forces, or the curve: 'static: {deflection: [...], force: [...]}'"
        raise Unusable([Trouble("expected the preload as a deflection, got a force", hint, told.place)])
    loads, (deflection, force) = values["preload"], declaration.static
    refuse(
        Trouble(
            f"the preload of {loads[row]:g} N in {table.where(row)} lies beyond the static curve, which goes "
            f"from {force[0]:g} to {force[-1]:g} N",
            "give a longer curve",
            told.place,
        )
        for row in np.flatnonzero((loads < force[0]) | (loads > force[-1]))[:1]
    )
    return {"preload": np.interp(loads, force, deflection)}


def _read_scatter(node: Node) -> tuple[float, bool]:
    text = read_text(node)
    share = "%" in text
    number = si(text, "1" if share else "N/m")
    if not number > 0.0:
        raise ValueError(f"expected a stiffness such as 3 N/mm or a share such as 2 %, above 0, got '{text}'")
    return number, share


def _check(form: Form, columns: set[str], settings: set[str]) -> None:
    if not any(set(pair) <= columns for pair in PAIRS):
        shown = ", or ".join(f"'{one}' and '{other}'" for one, other in PAIRS[:3])
        form.complain("columns", f"{form.what} does not say the dynamic stiffness", f"give the columns {shown}")
    for key in NEEDED:
        if key not in columns | settings:
            form.complain(
                "columns",
                f"{form.what} lacks '{key}'",
                f"give its column, or one for all rows under 'settings: {{{key}: ...}}'",
            )
    for key in sorted(columns & settings):
        form.complain("settings", f"{form.what} has '{key}' as a column and as a setting", "remove one of them")


def _in_si(table: Table, column: Channel, name: str, count: int) -> Array:
    unit = column.unit or table.units.get(name)
    try:
        scale, zero = (1.0, 0.0) if unit is None else _factor(unit, column.name)
    except ValueError as error:
        raise Unusable(
            [Trouble(f"column '{name}': {error}", f"say the unit of '{column.name}'", column.place)]
        ) from None
    return read_numbers(table, column, name, np.arange(count)) * scale + zero


def _is_share(table: Table, column: Channel, name: str) -> bool:
    unit = column.unit or table.units.get(name)
    return unit is not None and base_unit(unit) == base_unit("%")


def _deviations(
    declaration: TableDeclaration, values: Mapping[str, Array], shares: Mapping[str, bool], sizes: Array
) -> Array | None:
    """The standard deviation (rows,) of the stiffness, N/m; None where it is not stated."""
    if SCATTER in values:
        return values[SCATTER] * sizes if shares[SCATTER] else values[SCATTER]
    if declaration.scatter is None:
        return None
    number, share = declaration.scatter
    return number * sizes if share else np.full(sizes.size, number)


def _run(
    declaration: TableDeclaration,
    row: int,
    settings: Mapping[str, float],
    stiffness: complex,
    deviation: float | None,
    order: int,
) -> Run:
    count = steady_samples(settings["frequency"])
    name = f"{declaration.name}-{row + 1}"
    amplitude = settings["amplitude"]
    path = settings["preload"] + amplitude * sine(count)
    force = amplitude * (stiffness.real * sine(count) + stiffness.imag * cosine(count))
    noise = {} if deviation is None else {"force": {"noise": deviation * amplitude}}
    time = np.arange(count) / (SAMPLES * settings["frequency"])
    for values in (time, path, force):
        values.flags.writeable = False
    return Run(
        name,
        STEADY,
        time,
        {"displacement": path, "force": force},
        settings,
        group=name,
        held_out=declaration.held_out,
        sensors=noise,
        source=declaration.file,
        order=order,
        notes=declaration.notes,
        units=declaration.units,
    )
