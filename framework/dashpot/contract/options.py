"""Constructor arguments given as text, such as ``particles=48`` on the command line."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any

from dashpot.text.problem import nearest

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
    """One option's text in its declared type: int, float, bool or str."""
    if kind not in READERS:
        raise ValueError(f"option '{name}' is of a type that cannot be given as text")
    read, expected = READERS[kind]
    try:
        return read(text)
    except ValueError:
        raise ValueError(f"option '{name}' expected {expected}, got '{text}'") from None


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
