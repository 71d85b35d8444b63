"""What an element declares: complete, consistent, and what its law answers."""

from __future__ import annotations

import math

from dashpot.kernel.compiler.trace import RATES, trace_network
from dashpot.model.branches import FOR_ALL, WAYS
from dashpot.model.element import Curve, Element, Parameter, Scale
from dashpot.testing.specimen import draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination
from dashpot.text.problem import InputError
from dashpot.text.quantity import is_unit

# what stands beside parameters in a file, and what the motion is called
TAKEN = {*WAYS, *FOR_ALL, "old", "new", *RATES}
CURVE_WORDS = {"from", "knots", "refine", "polynomial", "start", "value", "bounds", "scale", "interval"}


def check_declarations(element: type[Element], seed: int | None = None) -> None:
    """Every name, unit, text and range is there and makes sense, and the law can be traced."""
    examination = Examination.begin(element, "declarations", seed)
    _check_class(examination)
    for key, parameter in element.declares.parameters.items():
        _check_parameter(examination, key, parameter)
    for key, curve in element.declares.curves.items():
        _check_curve(examination, key, curve)
    for key, state in element.declares.states.items():
        _check_text(examination, key, state.unit, state.about)
    _check_law(examination)


def _check_class(examination: Examination) -> None:
    element = examination.element
    examination.demand(
        element.word.isidentifier(),
        f"expected a word for files, got '{element.word}'",
        "Set `word` to letters, digits and underscores.",
    )
    examination.demand(bool((element.__doc__ or "").strip()), "the class has no docstring", "Say the law in it.")
    declared = element.declares
    for key in (*declared.parameters, *declared.curves):
        examination.demand(
            key not in TAKEN,
            f"'{key}' is the name of something else in a file or a motion",
            "Give the parameter another name.",
        )


def _check_parameter(examination: Examination, key: str, parameter: Parameter) -> None:
    _check_text(examination, key, parameter.unit, parameter.about)
    low, high = parameter.bounds
    _check_range(examination, key, parameter.bounds, parameter.scale)
    if parameter.default is not None:
        examination.demand(
            low <= parameter.default <= high,
            f"the default {parameter.default:g} of '{key}' lies outside its bounds {low:g} to {high:g}",
            "Change the one or the other.",
        )


def _check_curve(examination: Examination, key: str, curve: Curve) -> None:
    for word, unit in (curve.value, curve.over):
        _check_text(examination, f"{key}, axis {word}", unit, curve.about)
        examination.demand(
            word.isidentifier() and word not in CURVE_WORDS,
            f"'{word}' cannot name an axis of '{key}'",
            f"Take a word other than {', '.join(sorted(CURVE_WORDS))}.",
        )
    examination.demand(curve.value[0] != curve.over[0], f"both axes of '{key}' have the same name", "Rename one.")
    _check_range(examination, key, curve.bounds, curve.scale)


def _check_text(examination: Examination, key: str, unit: str, about: str) -> None:
    examination.demand(is_unit(unit), f"the unit '{unit}' of '{key}' is unknown", "Write one such as N*s/m, or 1.")
    examination.demand(bool(about.strip()), f"nothing is said about '{key}'", "Say in a few words what it is.")


def _check_range(examination: Examination, key: str, bounds: tuple[float, float], scale: Scale) -> None:
    low, high = bounds
    examination.demand(low < high, f"expected growing bounds of '{key}', got {low:g} and {high:g}", "Swap them.")
    finite = low > 0.0 and math.isfinite(high)
    examination.demand(
        scale != "log" or finite,
        f"expected positive finite bounds of '{key}' for its log scale, got {low:g} to {high:g}",
        "Give bounds, or scale='linear'.",
    )


def _check_law(examination: Examination) -> None:
    rng = examination.rng()
    for specimen in draw_specimens(examination.element, rng, draw_sizes(rng)):
        try:
            trace_network(specimen.spec)
        except InputError as error:
            examination.fail(
                f"with {specimen.form}, its step cannot be traced: {error}",
                "A step may only compute with numpy functions of its arguments.",
            )
