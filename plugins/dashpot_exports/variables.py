"""The variables of a mock-up unit: inputs, outputs, the status, and the parameters of the network."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement

from dashpot.text.quantity import dimensions

if TYPE_CHECKING:
    from dashpot.kernel.export import Exported

UNITS = {"displacement": "m", "velocity": "m/s", "force": "N"}


@dataclass(frozen=True)
class Variable:
    """A variable by its name, what it is, its unit, its value at the start, and how well it is known."""

    name: str
    causality: str
    about: str
    unit: str = ""
    start: float | None = None
    interval: str = ""
    kind: str = "Real"

    def attributes(self) -> dict[str, str]:
        """What every version writes."""
        variability = {
            "parameter": "tunable",
            "output": "continuous",
            "input": "continuous",
            "independent": "continuous",
        }[self.causality]
        return {
            "name": self.name,
            "causality": self.causality,
            "variability": "discrete" if self.kind == "Integer" else variability,
            "description": self.about,
        }

    def real_attributes(self) -> dict[str, str]:
        """The unit and the start of a real number."""
        unit = {"unit": self.unit} if self.unit not in ("", "1") else {}
        return unit | ({} if self.start is None else {"start": repr(self.start)})


def variables_of(found: Exported) -> list[Variable]:
    """All of them, in the order of their numbers in ``component.h``."""
    from dashpot.kernel.targets.c99.header import input_names, output_names

    motions = [name for name in input_names(found.online) if not name.startswith("acceleration")]
    inputs = [Variable(name, "input", "at the end of a step", _unit(name), 0.0) for name in motions]
    outputs = [Variable(name, "output", "at the end of a step", _unit(name)) for name in output_names(found.online)]
    about = "0 good, 1 forces at inner nodes not balanced, 2 no static equilibrium, 3 a force not finite"
    status = Variable("status", "output", about, kind="Integer")
    about = "sum of what left the identified range: 1 displacement, 2 speed, 4 amplitude, 8 preload, 16 frequency"
    outside = Variable("outside", "output", about, kind="Integer")
    return [*inputs, *outputs, status, outside, *_parameters(found), Variable("time", "independent", "of the run", "s")]


def _unit(name: str) -> str:
    return UNITS[name.partition("@")[0]]


def _parameters(found: Exported) -> list[Variable]:
    return [
        Variable(slot.path, "parameter", about, slot.value.unit, value, _interval(slot.value.interval))
        for slot, about, value in zip(found.slots, found.abouts, found.values, strict=True)
    ]


def _interval(interval: tuple[float, float] | None) -> str:
    return "" if interval is None or not all(map(isfinite, interval)) else f"{interval[0]!r} {interval[1]!r}"


def add_unit(parent: Element, unit: str) -> None:
    """A unit in terms of kg, m and s, where its exponents are whole."""
    element = SubElement(parent, "Unit", name=unit)
    force, length, time = dimensions(unit)
    exponents = {"kg": force, "m": force + length, "s": time - 2.0 * force}
    if all(float(each).is_integer() for each in exponents.values()):
        SubElement(element, "BaseUnit", {key: str(int(each)) for key, each in exponents.items() if each})
