"""A network that shows itself."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from dashpot.model.lint import find_weaknesses
from dashpot.model.network import NetworkSpec
from dashpot.notebook.cell import cell
from dashpot.notebook.listing import Listing
from dashpot.report.parameters import parameters_grid
from dashpot.report.parts import Notice, Picture
from dashpot.report.schematic.svg import svg

if TYPE_CHECKING:
    from pandas import DataFrame

    from dashpot.kernel.jit import Solver


class Model(NetworkSpec):
    """A network. In a notebook it shows its schematic and its parameters.

    Examples:
        >>> model = dp.load("gehmann")
        >>> [branch.name for branch in model.leaves()]
        ['stiffness', 'maxwell']
        >>> [slot.path for slot in model.slots()]
        ['maxwell.stiffness', 'maxwell.relaxation_time']
        >>> model.weaknesses()
        []
    """

    def table(self) -> Listing:
        """Every parameter with its meaning, unit, bounds and role."""
        return Listing.of(parameters_grid(self))

    def to_pandas(self) -> DataFrame:
        """The same as a pandas frame."""
        return self.table().to_pandas()

    @property
    def schematic(self) -> str:
        """The drawing of the network as the text of an SVG file."""
        return svg(self)

    def weaknesses(self) -> list[str]:
        """What is weak in the structure whatever the data, a sentence each."""
        return [str(problem) for problem in find_weaknesses(self)]

    def jit(self, **settings: float) -> Solver:
        """Functions compiled by numba, ``step`` and ``simulate``, for your own compiled code; see ``Solver``.

        ``settings`` in SI give the parameters that depend on the settings of a run.
        """
        from dashpot.kernel.jit import jit_network

        return jit_network(self, settings)

    def save(self, path: str | Path) -> Path:
        """Write the YAML text of the network; the path."""
        target = Path(path)
        target.write_text(self.text, encoding="utf-8")
        return target

    def _repr_html_(self) -> str:
        notices = [Notice("warning", text) for text in self.weaknesses()]
        about = [self.about] if self.about else []
        return cell(
            self.name, *about, Picture(f"Schematic of {self.name}", self.schematic), parameters_grid(self), *notices
        )
