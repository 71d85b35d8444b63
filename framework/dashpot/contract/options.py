"""Constructor arguments given as text, such as ``particles=48`` or ``amplitudes="1 mm, 3 mm"``."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Annotated, Any, get_args, get_origin

from dashpot.text.problem import nearest
from dashpot.text.quantity import si

YES_AND_NO = {"true": True, "yes": True, "false": False, "no": False}


def options_of(made: type) -> Mapping[str, inspect.Parameter]:
    """The keyword arguments of a class, with their defaults: its options."""
    return inspect.signature(made, eval_str=True).parameters


def read_options(made: type, texts: Mapping[str, str]) -> dict[str, Any]:
    """The options ``texts`` of the class ``made``, each in the type its constructor declares.

    ValueError for an option that it does not have, a text that is not of its type, or a value it does not accept.
    """
    known = options_of(made)
    options = {}
    for name, text in texts.items():
        if name not in known:
            hint = nearest(name, known) or f"it has: {', '.join(known) or 'none'}"
            raise ValueError(f"'{getattr(made, 'word', made.__name__)}' has no option '{name}', {hint}")
        options[name] = read_option(name, text, known[name].annotation)
    made(**options)
    return options


def read_option(name: str, text: str, kind: Any) -> Any:
    """One option's text in its declared type: int, float, bool, str, or a list of numbers `tuple[float, ...]`.

    `Annotated[float, "m"]` is a quantity, `Annotated[tuple[float, ...], "m"]` a list of quantities, both in SI.
    """
    kind, unit = kind_and_unit(kind)
    if get_origin(kind) is tuple:
        item = Annotated[float, unit] if unit else get_args(kind)[0]
        return tuple(read_option(name, part.strip(), item) for part in text.strip("[]").split(","))
    if unit:
        return _quantity(name, text, unit)
    if kind not in READERS:
        raise ValueError(f"option '{name}' is of a type that cannot be given as text")
    read, expected = READERS[kind]
    try:
        return read(text)
    except ValueError:
        raise ValueError(f"option '{name}' expected {expected}, got '{text}'") from None


def kind_and_unit(annotation: Any) -> tuple[Any, str]:
    """The type of an option and its unit, empty where it has none."""
    if get_origin(annotation) is Annotated:
        kind, unit = get_args(annotation)
        return kind, unit
    return annotation, ""


def _quantity(name: str, text: str, unit: str) -> float:
    try:
        return si(text, unit)
    except ValueError as error:
        raise ValueError(f"option '{name}': {error}") from None


def _truth(text: str) -> bool:
    if text.lower() not in YES_AND_NO:
        raise ValueError(text)
    return YES_AND_NO[text.lower()]


READERS: Mapping[Any, tuple[Callable[[str], Any], str]] = {
    int: (int, "a whole number"),
    float: (float, "a number"),
    bool: (_truth, "yes or no"),
    str: (str, "a text"),
    inspect.Parameter.empty: (str, "a text"),
}
