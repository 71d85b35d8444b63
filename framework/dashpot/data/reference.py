"""Numbers of a specimen that were measured by other means: reports put them beside a fit, which never sees them."""

from __future__ import annotations

from dataclasses import dataclass

from dashpot.text.form import Form, read_text
from dashpot.text.node import Node
from dashpot.text.problem import InputError, Place
from dashpot.text.quantity import measure, si

MEANS = "measured by other means"


@dataclass(frozen=True)
class Reference:
    """The number or the curve over velocity of a network's parameter ``path``, measured ``by`` other means.

    ``text`` is the number with its unit, empty for a curve of ``force`` (k,) N over growing ``velocity`` (k,) m/s.
    """

    path: str
    by: str
    place: Place
    text: str = ""
    velocity: tuple[float, ...] = ()
    force: tuple[float, ...] = ()

    def number(self, unit: str) -> float:
        """The number in ``unit``. InputError for a curve, and for a unit of another kind."""
        try:
            if not self.text:
                raise ValueError("expected a number, got a curve over velocity")
            return si(self.text, unit)
        except ValueError as error:
            hint = f"a parameter in {unit}: write 'value: 1 {unit}' with its number"
            raise InputError.at(self.place, f"the reference of '{self.path}': {error}", hint) from None


def read_references(form: Form) -> dict[str, Reference]:
    """The ``references`` of a dataset by the paths of the parameters; every mistake is noted in the form."""
    found = {path: _read(path, below) for path, below in form.named("references", {}).items()}
    return {path: reference for path, reference in found.items() if reference}


def _read(path: str, form: Form) -> Reference | None:
    before = len(form.problems)
    by = form.text("by", MEANS)
    if "value" in form:
        text = form.take("value", _read_number)
        found = Reference(path, by, form.place, text or "")
    else:
        velocity, force = form.quantities("velocity", "m/s"), form.quantities("force", "N")
        _require_curve(form, velocity, force)
        found = Reference(path, by, form.place, "", tuple(velocity or ()), tuple(force or ()))
    form.close()
    return None if len(form.problems) > before else found


def _read_number(node: Node) -> str:
    text = read_text(node)
    measure(text)
    return text


def _require_curve(form: Form, velocity: list[float] | None, force: list[float] | None) -> None:
    if velocity is None or force is None:
        return
    if len(velocity) < 2 or len(force) != len(velocity):
        got = f"got {len(velocity)} and {len(force)}"
        form.complain("force", f"{form.what}: expected as many forces as velocities, two at least, {got}")
    elif any(after <= before for before, after in zip(velocity, velocity[1:], strict=False)):
        form.complain("velocity", f"{form.what}: expected growing velocities", "sort the table")
