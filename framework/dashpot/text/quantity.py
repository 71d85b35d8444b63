"""Quantities as people write them: `220 N/mm`, `160 ms`, `5 %`; inside everything is SI.

The units are our own short list, on purpose: an angle is a dimension of its own (so rad/s never passes for Hz),
`rpm` counts revolutions per minute, and a pound is a mass (the force is `lbf`).
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from decimal import Decimal
from functools import cache
from typing import TYPE_CHECKING, Any

from dashpot.text.problem import nearest

if TYPE_CHECKING:
    import pint

_PREFIXES = """
nano- = 1e-9 = n-
micro- = 1e-6 = µ- = u-
milli- = 1e-3 = m-
centi- = 1e-2 = c-
deci- = 1e-1 = d-
deca- = 1e1 = da-
hecto- = 1e2 = h-
kilo- = 1e3 = k-
mega- = 1e6 = M-
giga- = 1e9 = G-
"""

_UNITS = """
meter = [length] = m
second = [time] = s
gram = [mass] = g
kelvin = [temperature]; offset: 0 = K
ampere = [current] = A
radian = [angle] = rad
percent = 0.01 = %
minute = 60 * second = min
hour = 3600 * second = h
hertz = 1 / second = Hz
rpm = 1 / minute
inch = 0.0254 * meter = in
foot = 12 * inch = ft
tonne = 1000 * kilogram = t
pound = 0.45359237 * kilogram = lb
standard_gravity = 9.80665 * meter / second ** 2 = g0
newton = kilogram * meter / second ** 2 = N
kilogram_force = kilogram * standard_gravity = kgf
ton_force = tonne * standard_gravity = tonf
pound_force = pound * standard_gravity = lbf
kip = 1000 * pound_force
newton_second = newton * second = Ns
newton_meter = newton * meter = Nm
newton_millimeter = newton * millimeter = Nmm
pascal = newton / meter ** 2 = Pa
bar = 100000 * pascal
psi = pound_force / inch ** 2
joule = newton * meter = J
watt = joule / second = W
volt = watt / ampere = V
degree = 0.017453292519943295 * radian = deg
revolution = 360 * degree = rev
degree_Celsius = kelvin; offset: 273.15 = degC = celsius
"""

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?")
_FACTOR = r"(?:[A-Za-z%][A-Za-z_]*\d?|1)(?:(?:\^|\*\*)(?:-?\d(?:\.\d{1,3})?|\(-?\d(?:\.\d{1,3})?(?:/[1-9])?\)))?"
_BETWEEN = r"(?: *[*/] *| +)"
_GROUP = rf"(?:{_FACTOR}|\({_FACTOR}(?:{_BETWEEN}{_FACTOR}){{0,5}}\)(?:(?:\^|\*\*)-?\d(?:\.\d{{1,3}})?)?)"
_UNIT = re.compile(rf"{_GROUP}(?:{_BETWEEN}{_GROUP}){{0,5}}")
_SPELLINGS = {"·": "*", "⋅": "*", "²": "^2", "³": "^3", "μ": "u", "µ": "u", "°C": "degC", "°": "deg", "−": "-"}
_FAMILIAR = (
    "N kN daN mm um m cm s ms us min h Hz kHz rpm kg g t % N/mm N/m kN/mm N*s/mm N*s/m Ns/mm Nm kNm bar mbar Pa kPa "
    "MPa psi K degC rad deg m/s mm/s m/s^2 g0 in ft lb lbf kip kgf tonf J W V mV A"
).split()

_BASE_UNITS = {
    "[mass]": "kg",
    "[length]": "m",
    "[time]": "s",
    "[temperature]": "K",
    "[current]": "A",
    "[angle]": "rad",
}

# for each kind of quantity: the first unit whose number is not below the stated one
_RIG_UNITS = (
    "m from 10, mm from 0.01, um from 0",
    "s from 1, ms from 0.1, us from 0",
    "kN from 10, N from 0",
    "kN/mm from 10, N/mm from 0",
    "mm/N from 0.01, um/N from 0",
    "kN*s/mm from 10, N*s/mm from 0.01, N*s/m from 0",
    "t from 10, kg from 0.1, g from 0",
    "kHz from 10, Hz from 0",
    "m/s from 1, mm/s from 0",
    "MPa from 1, kPa from 1, Pa from 0",
)

# what something does per setting, and how a rig engineer writes that
_PER_SETTING = {"/Pa": "/bar"}

# special hints for what is easily confused: (unit written, dimension wanted)
_TORSION = "a test in torsion is written on a lever of 1 m: 'unit: m, gain: 0.0174533' for degrees, 'unit: N' for N*m"
_CONFUSED = {
    ("g", "m/s^2"): "multiples of gravity are written g0",
    ("lb", "N"): "a pound of force is written lbf",
    ("rad/s", "Hz"): "frequencies are in Hz: divide by 2*pi",
    **dict.fromkeys([(angle, "m") for angle in ("rad", "mrad", "deg", "°")], _TORSION),
    **dict.fromkeys([(moment, "N") for moment in ("N*m", "Nm", "kN*m", "kNm", "N*mm", "Nmm")], _TORSION),
}


# factors of the units that stand in nearly every file, and of those that a rig engineer is shown: these need no library
# of units
USUAL = {
    ("N/mm", "N/m"): "1e3",
    ("kN/mm", "N/m"): "1e6",
    ("N*s/mm", "N*s/m"): "1e3",
    ("mm/N", "m/N"): "1e-3",
    ("um/N", "m/N"): "1e-6",
    ("kN*s/mm", "N*s/m"): "1e6",
    ("kN*s/mm", "N/(m/s)"): "1e6",
    ("N*s/m", "N/(m/s)"): "1",
    ("N*s/mm", "N/(m/s)"): "1e3",
    ("kN*s/m", "N*s/m"): "1e3",
    ("kN*s/m", "N/(m/s)"): "1e3",
    ("kN*s^2/m^2", "N*s^2/m^2"): "1e3",
    ("MN*s^2/m^2", "N*s^2/m^2"): "1e6",
    ("t", "kg"): "1e3",
    ("g", "kg"): "1e-3",
    ("kHz", "Hz"): "1e3",
    ("kPa", "Pa"): "1e3",
    ("MPa", "Pa"): "1e6",
    ("mm", "m"): "1e-3",
    ("mm/s", "m/s"): "1e-3",
    ("um", "m"): "1e-6",
    ("ms", "s"): "1e-3",
    ("us", "s"): "1e-6",
    ("kN", "N"): "1e3",
    ("%", "1"): "0.01",
}

# the powers of those that numbers are mostly kept in, for the same reason
USUAL_POWERS: dict[str, dict[str, float]] = {
    "1": {},
    "m": {"[length]": 1.0},
    "s": {"[time]": 1.0},
    "kg": {"[mass]": 1.0},
    "Hz": {"[time]": -1.0},
    "Pa": {"[mass]": 1.0, "[length]": -1.0, "[time]": -2.0},
    "m/s": {"[length]": 1.0, "[time]": -1.0},
    "N": {"[mass]": 1.0, "[length]": 1.0, "[time]": -2.0},
    "N/m": {"[mass]": 1.0, "[time]": -2.0},
    "m/N": {"[mass]": -1.0, "[time]": 2.0},
    "N*s/m": {"[mass]": 1.0, "[time]": -1.0},
    "N/(m/s)": {"[mass]": 1.0, "[time]": -1.0},
    "N*s^2/m^2": {"[mass]": 1.0, "[length]": -1.0},
    "J": {"[mass]": 1.0, "[length]": 2.0, "[time]": -2.0},
    "W": {"[mass]": 1.0, "[length]": 2.0, "[time]": -3.0},
    "m^2/s": {"[length]": 2.0, "[time]": -1.0},
    "s/m": {"[length]": -1.0, "[time]": 1.0},
}
USUAL_POWERS |= {given: USUAL_POWERS[wanted] for given, wanted in USUAL if wanted in USUAL_POWERS}


def si(quantity: str | float, unit: str) -> float:
    """A quantity as a number in `unit`, which is an SI unit: `si("220 N/mm", "N/m")` is 220000.

    A bare number is SI already. Raises ValueError (expected, got, what to do) for a text that is not a finite number
    with a unit of the same dimension.
    """
    if isinstance(quantity, bool) or not isinstance(quantity, str | int | float):
        raise ValueError(f"expected {_wanted(unit)}, got '{quantity}'")
    value = _read(quantity, unit) if isinstance(quantity, str) else float(quantity)
    if not math.isfinite(value):
        raise ValueError(f"expected a finite number, got '{quantity}'")
    return value


@cache
def factor(unit_text: str, unit: str) -> tuple[float, float]:
    """`(scale, offset)` such that a number in `unit_text` times scale plus offset is in `unit`.

    Raises ValueError when the unit is unknown or measures something else.
    """
    scale, offset = _exact_factor(unit_text, unit)
    return float(scale), float(offset)


def is_unit(text: str) -> bool:
    """Whether a text is a unit we know."""
    if text in USUAL_POWERS:
        return True
    try:
        _parse(text)
    except ValueError:
        return False
    return True


@cache
def base_unit(unit_text: str) -> str:
    """The SI base unit of the same kind: `kN` gives `kg*m*s^-2`. ValueError for an unknown unit."""
    found = powers(unit_text)
    present = [(name, found[key]) for key, name in _BASE_UNITS.items() if key in found]
    return "*".join(f"{name}^{power:g}" for name, power in present) or "1"


def measure(quantity: str | float) -> float:
    """A quantity of any kind in SI base units: `3 bar` gives 300000. ValueError when it is none."""
    return si(quantity, base_unit_of(quantity))


def base_unit_of(quantity: str | float) -> str:
    """The SI base unit of a quantity: `20 degC` gives `K^1`, a bare number `1`. ValueError for an unknown unit."""
    written = unit_of(quantity) if isinstance(quantity, str) else ""
    return base_unit(written) if written else "1"


def unit_of(quantity: str) -> str:
    """The unit with which a quantity is written: `3 bar` gives `bar`, `2 / s` gives `1/ s`, a bare number nothing."""
    written = _NUMBER.sub("", quantity.strip(), count=1).strip()
    return "1" + written if written.startswith("/") else written


def in_unit(value: float, unit: str, digits: int) -> str:
    """A number in SI base units written in a unit: `293.15` in `degC` is `20 degC`. ValueError for an unknown unit."""
    scale, offset = _exact_factor(unit, base_unit(unit)) if unit else (Decimal(1), Decimal(0))
    return f"{_format((_finite(value, unit or '1') - offset) / scale, digits)} {unit}".rstrip()


@cache
def force_dimension(unit: str) -> int:
    """The power with which a quantity in `unit` grows when all forces grow: N/m -> 1, s -> 0, m/N -> -1.

    At fixed lengths and times forces grow like masses, so it is the power of the mass. Raises ValueError when that
    is not a whole number or the unit is unknown.
    """
    power = powers(unit).get("[mass]", 0.0)
    if power != int(power):
        raise ValueError(f"expected a whole power of force in the unit '{unit}', got {power:g}")
    return int(power)


@cache
def dimensions(unit: str) -> tuple[float, float, float]:
    """The powers of force, length and time in a unit: `N*s/m` gives (1, -1, 1). ValueError for an unknown unit."""
    found = powers(unit)
    mass, length, time = (found.get(name, 0.0) for name in ("[mass]", "[length]", "[time]"))
    return mass, length - mass, time + 2.0 * mass


def pretty(value: float, unit: str, digits: int = 4) -> str:
    """A number in `unit` as a rig engineer writes it: `pretty(220000.0, "N/m")` is `220 N/mm`.

    `si` reads it back, to the `digits` shown. Raises ValueError for an unknown unit or a number that is not finite.
    """
    return pretty_in(value, unit, shown_unit(value, unit), digits)


def pretty_all(values: Sequence[float], unit: str, digits: int = 4) -> list[str]:
    """Numbers of one kind in `unit` as `pretty` writes them, all in the unit that suits the largest.

    `pretty_all([-5e-6, 4e-3], "m")` is `["-0.005 mm", "4 mm"]`. ValueError as for `pretty`.
    """
    shown = shown_unit(max(values, key=abs, default=0.0), unit)
    return [pretty_in(value, unit, shown, digits) for value in values]


def pretty_in(value: float, unit: str, shown: str, digits: int = 4) -> str:
    """A number in `unit` written in the unit `shown` of the same kind. ValueError as for `pretty`."""
    number = _finite(value, unit) / _exact_factor(shown, unit)[0]
    return _format(number, digits) + ("" if shown == "1" else f" {shown}")


def shown_unit(value: float, unit: str) -> str:
    """The unit in which a rig engineer writes a number in `unit`: `N/mm` for 220000 N/m. ValueError as for `pretty`."""
    for kept, told in _PER_SETTING.items():
        if unit.endswith(kept):
            scale = float(_exact_factor(told.removeprefix("/"), kept.removeprefix("/"))[0])
            return shown_unit(scale * value, unit.removesuffix(kept)) + told
    number, known = _finite(value, unit), _rig_units(unit)
    if not number:
        # nothing has no size: the unit of what is usual
        return known[1][0] if known else unit
    return next((name for name, smallest in known if abs(number / _exact_factor(name, unit)[0]) >= smallest), unit)


def _finite(value: float, unit: str) -> Decimal:
    if not math.isfinite(value):
        raise ValueError(f"expected a finite number in {unit}, got {value}")
    return Decimal(repr(float(value)))


@cache
def _rig_units(unit: str) -> tuple[tuple[str, Decimal], ...]:
    # what something does per setting: N/m per Pa is a length by its dimension only
    if re.sub(r"\([^)]*\)", "", unit).count("/") > 1:
        return ()
    wanted = powers(unit)
    for choice in _RIG_UNITS:
        pairs = [pair.split(" from ") for pair in choice.split(", ")]
        if powers(pairs[0][0]) == wanted:
            return tuple((name, Decimal(smallest)) for name, smallest in pairs)
    return ()


def _format(number: Decimal, digits: int) -> str:
    if not number:
        return "0"
    shown = Decimal(f"{number:.{digits - 1}e}")
    return f"{shown.normalize():{'f' if -5 <= shown.adjusted() < 7 else 'e'}}"


def _read(text: str, unit: str) -> float:
    match = _NUMBER.match(text.strip().replace("−", "-"))
    if not match:
        raise ValueError(f"expected {_wanted(unit)}, got '{text}'")
    written = text.strip()[match.end() :].strip()
    if written.startswith(","):
        raise ValueError(f"expected {_wanted(unit)}, got '{text}'; the decimal sign is a point")
    number = Decimal(match.group())
    if not written:
        return float(number)
    scale, offset = _exact_factor("1" + written if written.startswith("/") else written, unit)
    return float(number * scale + offset)


@cache
def _exact_factor(unit_text: str, unit: str) -> tuple[Decimal, Decimal]:
    known = "1" if unit_text == unit else USUAL.get((unit_text, unit))
    if known is not None and (unit_text == "1" or _UNIT.fullmatch(unit_text)):
        return Decimal(known), Decimal(0)
    given, wanted = _parse(unit_text), _parse(unit)
    if given.dimensionality != wanted.dimensionality:
        hint = _CONFUSED.get((unit_text.strip(), unit), f"write it in {unit} or a unit of the same kind")
        raise ValueError(f"expected {_wanted(unit)}, got '{unit_text}', which measures {_measures(given)}; {hint}")
    offset = _convert(0, given, wanted)
    return _convert(1, given, wanted) - offset, offset


def _wanted(unit: str) -> str:
    return "a plain number" if unit == "1" else f"a quantity in {unit}"


def _measures(unit: pint.Unit) -> str:
    names = {key.strip("[]"): value for key, value in sorted(unit.dimensionality.items())}
    words = [name if power == 1 else f"{name}^{power:g}" for name, power in names.items()]
    return " * ".join(words) or "a ratio"


@cache
def _parse(unit_text: str) -> pint.Unit:
    from pint.errors import UndefinedUnitError

    text = unit_text.strip()
    for written, meant in _SPELLINGS.items():
        text = text.replace(written, meant)
    if len(text) > 80 or not _UNIT.fullmatch(text):
        raise _unknown_unit(unit_text, text)
    try:
        return _registry().parse_units("" if text == "1" else text.replace("%", "percent"))
    except UndefinedUnitError as error:
        names = [error.unit_names] if isinstance(error.unit_names, str) else list(error.unit_names)
        raise _unknown_unit(unit_text, names[0]) from None


@cache
def powers(unit: str) -> dict[str, float]:
    """The powers of mass, length, time and so on in a unit: `N/m` gives 1 of mass, -2 of time. ValueError for none."""
    if unit in USUAL_POWERS:
        return USUAL_POWERS[unit]
    dimension: Any = _parse(unit).dimensionality
    return {name: float(power) for name, power in dimension.items()}


def _unknown_unit(unit_text: str, word: str) -> ValueError:
    hint = nearest(unit_text, _FAMILIAR) or nearest(word, _FAMILIAR) or "units look like N, N/mm, N*s/mm, ms, Hz, %"
    return ValueError(f"unknown unit '{unit_text}'; {hint}")


def _convert(value: int, given: pint.Unit, wanted: pint.Unit) -> Decimal:
    return Decimal(_registry().Quantity(Decimal(value), given).to(wanted).magnitude)


@cache
def _registry() -> pint.UnitRegistry:
    import pint

    registry: pint.UnitRegistry = pint.UnitRegistry(None, autoconvert_offset_to_baseunit=True, non_int_type=Decimal)
    registry.load_definitions((_PREFIXES + _UNITS).strip().splitlines())
    return registry
