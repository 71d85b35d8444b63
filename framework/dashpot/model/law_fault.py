"""What goes wrong in the law of an element is the fault of its plugin, and is told with the line."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager

from dashpot.model.element import Element
from dashpot.text.problem import InputError, Place


@contextmanager
def told_of_law(element: type[Element]) -> Iterator[None]:
    """Whatever the law raises in this block becomes an InputError at the line of the law that raised it."""
    try:
        yield
    except InputError:
        raise
    except (Exception, SystemExit) as error:
        file, line = _line(element, error)
        message = f"the law of the element '{element.word}' cannot be used: {_told(error)}"
        hint = "this is a fault of the plugin that gives the element: tell its author, `dashpot list elements` says who"
        raise InputError.at(Place(file, line), message, hint) from error


def _told(error: BaseException) -> str:
    text = " ".join(str(error).split())[:300]
    # what tracing says of a law is a sentence by itself
    return text if type(error).__name__ == "TraceError" else f"it raises {type(error).__name__}: {text}"


def _line(element: type[Element], error: BaseException) -> tuple[str, int]:
    code = element.step.__code__
    frames = traceback.extract_tb(error.__traceback__)
    within = [frame.lineno for frame in frames if frame.filename == code.co_filename]
    return code.co_filename, within[-1] or code.co_firstlineno if within else code.co_firstlineno
