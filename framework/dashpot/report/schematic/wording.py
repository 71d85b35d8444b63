"""The lines beside a symbol: numbers with their signs and units, ``k = 8 N/mm``; ``≈`` for one that is to be found."""

from __future__ import annotations

from collections.abc import Iterator

from dashpot.model.element import Curve
from dashpot.model.network import Branch, Characteristic, Joint, NetworkSpec, Value
from dashpot.text.digits import beside, typeset
from dashpot.text.quantity import pretty, pretty_all

GREEK = {
    name: chr(sign)
    for sign, name in enumerate(
        "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho - sigma tau upsilon "
        "phi chi psi omega".split(),
        start=0x3B1,
    )
}
SHORT = 5  # knots of a table that are written out
ARGUMENTS = {"m": "x", "m/s": "v"}


def branch_lines(branch: Branch) -> tuple[str, ...]:
    """What a branch says: its curves, its numbers, the factor on its force."""
    if branch.shares:
        return (f"as {branch.shares}",)
    return tuple(_branch_lines(branch))


def joint_lines(joint: Joint) -> tuple[str, ...]:
    """The masses of a node."""
    if joint.shares:
        return (f"as {joint.shares}",)
    signs = dict(zip(joint.masses, ("m", "m_+"), strict=False)) if len(joint.masses) > 1 else {}
    return tuple(equation(signs.get(key, "m"), value) for key, value in joint.masses.items())


def measurement_lines(spec: NetworkSpec) -> tuple[str, ...]:
    """What the load cell does to the force."""
    named = {key.removeprefix("force.").replace(".", " "): value for key, value in spec.measurement.items()}
    return tuple(equation(name, value) for name, value in named.items())


def equation(sign: str, value: Value) -> str:
    """``k = 8 N/mm``, or with ``≈`` where the number is only a start."""
    return f"{sign} {'≈' if value.role == 'free' else '='} {quantity(value.number, value.unit)}"


def quantity(number: float, unit: str) -> str:
    """A number with its unit as it is typeset."""
    return typeset(pretty(number, unit))


def sign_of(symbol: str) -> str:
    """A sign of a formula: ``sigma`` becomes a Greek letter, the rest stays."""
    letter, low, index = symbol.partition("_")
    return GREEK.get(letter, letter) + low + index


def is_curved(branch: Branch) -> bool:
    """Whether a characteristic of the branch is no straight line."""
    return any(curve.form != "constant" for curve in branch.curves.values())


def _branch_lines(branch: Branch) -> Iterator[str]:
    for key, curve in branch.curves.items():
        declared = branch.element.declares.curves[key]
        yield from _curve_lines(sign_of(declared.symbol or key), ARGUMENTS.get(declared.over[1], "u"), curve, declared)
    for key, value in branch.values.items():
        yield equation(sign_of(branch.element.declares.parameters[key].symbol or key), value)
    if branch.scale:
        yield from _curve_lines("s", "x", branch.scale, branch.scale.curve)


def _curve_lines(sign: str, argument: str, curve: Characteristic, declared: Curve) -> Iterator[str]:
    if curve.form == "constant":
        yield equation(sign, curve.values[0])
    elif curve.form == "polynomial":
        yield from (equation(f"{sign}_{power}", value) for power, value in enumerate(curve.values, start=1))
    else:
        yield from _table_lines("F" if declared.value[1] == "N" else sign, argument, curve, declared)


def _table_lines(sign: str, argument: str, curve: Characteristic, declared: Curve) -> Iterator[str]:
    if curve.form == "data":
        yield f"{sign}({argument}) from {curve.data}"
    elif len(curve.values) <= SHORT:
        for at, value in zip(curve.at, curve.values, strict=True):
            yield equation(f"{sign}({_place(at, curve, declared)})", value)
    else:
        yield f"{sign}({argument}): {len(curve.values)} knots"
        yield f"{argument}: {_range(curve, declared)}"


def _range(curve: Characteristic, declared: Curve) -> str:
    """The first and the last knot in one unit."""
    widest = max(map(abs, curve.at))
    ends = [beside(at, widest) for at in (curve.at[0], curve.at[-1])]
    return " … ".join(map(typeset, pretty_all(ends, declared.over[1])))


def _place(at: float, curve: Characteristic, declared: Curve) -> str:
    """A knot to a thousandth of all of them: one that was measured beside zero stands at zero."""
    return quantity(beside(at, max(map(abs, curve.at))), declared.over[1])
