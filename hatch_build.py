"""The wheel holds the one file of plotly that reports need, so that nobody has to install the whole package."""

from __future__ import annotations

from importlib.metadata import files
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PLOTLY = "plotly>=5.24"
LIBRARY, LICENCE = "package_data/plotly.min.js", "LICENSE.txt"


class PlottingLibrary(BuildHookInterface):
    """Takes plotly.js and its licence from the plotly of the build; an editable wheel requires plotly."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the two files, or the requirement, to what is built."""
        if self.target_name != "wheel":
            return
        if version == "editable":
            build_data["dependencies"].append(PLOTLY)
            return
        build_data["force_include"] |= {
            _file_of_plotly(LIBRARY): "dashpot/report/plotly.min.js",
            _file_of_plotly(LICENCE): "dashpot/report/plotly-LICENSE.txt",
        }


def _file_of_plotly(ending: str) -> str:
    for path in files("plotly") or ():
        if path.as_posix().endswith(ending):
            return str(Path(str(path.locate())))
    raise FileNotFoundError(
        f"expected a file {ending} of the installed plotly, found none; say  pip install '{PLOTLY}'"
    )
