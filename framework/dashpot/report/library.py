"""The plotting library of the pages: the copy of plotly.js in the wheel, or that of an installed plotly."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

from dashpot.text.problem import InputError, Place

FILE = "plotly.min.js"


def plotly_js() -> str:
    """The text of plotly.js. InputError where neither dashpot nor an installed plotly has it."""
    for path in _places():
        if path.is_file():
            return path.read_text(encoding="utf-8")
    raise InputError.at(
        Place(),
        f"a page needs {FILE}: it is neither among the files of dashpot nor is the package plotly installed",
        "install the wheel of dashpot, or say  pip install plotly",
    )


def require_plotly() -> None:
    """InputError, with how to install it, where the package is missing that draws figures in a notebook."""
    if find_spec("plotly") is None:
        raise InputError.at(
            Place(),
            "plot() needs the package plotly, which is not installed; reports do without it",
            "pip install 'dashpot[plot]'",
        )


# the wheel has its own copy, see hatch_build.py; the package plotly is found without being imported
def _places() -> Iterator[Path]:
    yield Path(__file__).with_name(FILE)
    found = find_spec("plotly")
    for folder in (found.submodule_search_locations or ()) if found else ():
        yield Path(folder) / "package_data" / FILE
