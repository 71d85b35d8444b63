"""A file that is a table of dynamic stiffness: which column is which condition or answer, and in which unit."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.data.importing.rows import numeric
from dashpot.data.importing.units import GUESSED, IN_NAME, STATED, UnitFound
from dashpot.data.stiffness_table import NEEDED, PAIRS, UNITS
from dashpot.data.table import Table
from dashpot.text.quantity import factor

Array = NDArray[np.float64]

# names in English and German without blanks, units and underscores; a single letter counts as written
_NAMES = {
    "frequency": "f freq frequency frequenz",
    "amplitude": "A a amp ampl amplitude xa wegamplitude",
    "preload": "preload vorlast mean meandisplacement mittelweg mittellage offset x0",
    "storage": "k' k1 kreal rek storage storagestiffness c' speichersteifigkeit",
    "loss": "k'' k2 kimag imk loss lossstiffness c'' verluststeifigkeit",
    "stiffness": "K k kdyn k* |k| |k*| cdyn c* dynamicstiffness stiffness steifigkeit dynamischesteifigkeit",
    "loss_angle": "delta phi phase lossangle phaseangle verlustwinkel phasenwinkel",
    "loss_factor": "tandelta tand eta lossfactor verlustfaktor",
    "temperature": "T temp temperature temperatur",
}
_KINDS = {**UNITS, "temperature": "K"}
_MOST = 10_000  # rows of a table; more are a record over time


@dataclass(frozen=True)
class ColumnFound:
    """A column of a table, and its unit with what told it."""

    column: str
    unit: UnitFound


@dataclass(frozen=True)
class StiffnessFound:
    """The columns of a table of dynamic stiffness by what they are, the other ones, and what has to be confirmed."""

    columns: Mapping[str, ColumnFound]
    unused: tuple[str, ...]
    confirm: tuple[str, ...]


def find_stiffness(table: Table) -> StiffnessFound | None:
    """What a file tells where it is a table of dynamic stiffness: a frequency and a pair of answers; else None."""
    found: dict[str, ColumnFound] = {}
    for name, values in table.columns.items():
        numbers = numeric(values)
        kind = _kind(name, table.units.get(name, ""))
        if kind and kind not in found and np.isfinite(numbers).any() and numbers.size <= _MOST:
            found[kind] = ColumnFound(name, _unit(kind, name, table.units.get(name, ""), numbers[np.isfinite(numbers)]))
    if "storage" in found and "loss" in found:
        found["loss"] = _beside(found["storage"], found["loss"])
    pair = next((pair for pair in PAIRS if set(pair) <= set(found)), None)
    if pair is None or "frequency" not in found:
        return None
    answers = {key for each in PAIRS for key in each}
    kept = {key: column for key, column in found.items() if key not in answers or key in pair}
    used = {column.column for column in kept.values()}
    unused = tuple(name for name in table.columns if name not in used)
    return StiffnessFound(kept, unused, tuple(_doubts(kept, unused)))


def _beside(storage: ColumnFound, loss: ColumnFound) -> ColumnFound:
    """The loss in the unit of the storage, where it has none of its own: it is the smaller one of the two."""
    return replace(loss, unit=UnitFound(storage.unit.unit, GUESSED)) if loss.unit.by == GUESSED else loss


def _kind(name: str, stated: str) -> str:
    """What a column is, after its name; nothing where its unit is of another kind."""
    bare = re.sub(r"[\[(].*|[\s_.]", "", name)
    word = bare if len(bare) == 1 else bare.lower()
    kind = next((kind for kind, names in _NAMES.items() if word in names.split()), "")
    return kind if kind and (not stated or _measures(stated, kind)) else ""


def _measures(unit: str, kind: str) -> bool:
    try:
        factor(unit, _KINDS[kind])
    except ValueError:
        return False
    return True


def _unit(kind: str, name: str, stated: str, numbers: Array) -> UnitFound:
    if stated:
        return UnitFound(stated, STATED)
    inside = re.search(r"[\[(]([^\])]+)[\])]", name)
    if inside and _measures(inside[1].strip(), kind):
        return UnitFound(inside[1].strip(), IN_NAME)
    return UnitFound(_guess(kind, float(np.max(np.abs(numbers)))), GUESSED)


def _guess(kind: str, largest: float) -> str:
    """The usual unit after the largest number of a column."""
    if kind in ("amplitude", "preload"):
        return "mm" if largest > 0.02 else "m"
    if kind in ("storage", "loss", "stiffness"):
        return "N/mm" if largest < 1e5 else "N/m"
    if kind == "loss_angle":
        return "deg" if largest > 1.6 else "rad"
    return "degC" if kind == "temperature" else {"frequency": "Hz"}.get(kind, "1")


def _doubts(columns: Mapping[str, ColumnFound], unused: Sequence[str]) -> list[str]:
    doubts = [
        f"the {key} '{found.column}' is taken to be in {found.unit.unit}: no unit is stated"
        for key, found in columns.items()
        if found.unit.by == GUESSED and key != "loss_factor"
    ]
    doubts += [
        f"no column was found for the {key}: say its column, or the one of all rows under settings"
        for key in NEEDED
        if key not in columns
    ]
    loads = [name for name in unused if re.search("load|last", name, re.I)]
    if loads and "preload" not in columns:
        told = f"'{loads[0]}' may be a preload told as a force"
        doubts.append(f"{told}: say its column, and the static curve under 'static'")
    return [*doubts, "that the amplitude is half of peak to peak"]
