"""A look at measured runs that shows itself."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from dashpot.compare.look import Look as PlainLook
from dashpot.compare.provenance import provenance_of
from dashpot.compare.signals import signal_evidence
from dashpot.notebook.cell import cell
from dashpot.notebook.listing import Listing
from dashpot.notebook.plots import interactive
from dashpot.notebook.printed import Printed
from dashpot.report.look import look_figures, look_grid, look_headline, look_page
from dashpot.report.page import write_page
from dashpot.text.problem import nearest

if TYPE_CHECKING:
    from pandas import DataFrame
    from plotly.graph_objects import Figure as PlotlyFigure

    from dashpot.report.evidence import Evidence


class Look(Printed, PlainLook):
    """Measured runs before any model. In a notebook it shows a table of the runs, with the energy of their cycles.

    Examples:
        >>> seen = dp.look(data)
        >>> print(seen.headline)
        Forces up to ... N; noise floor ... N; explainable error ... N.
        >>> all(run["energy_per_cycle"] > 0.0 for run in seen.as_dict()["runs"])
        True
    """

    @property
    def _line(self) -> str:
        """The answer in a line."""
        return self.headline

    @property
    def headline(self) -> str:
        """The answer in a sentence."""
        return look_headline(self.as_dict())

    @property
    def pictures(self) -> tuple[str, ...]:
        """The titles of all pictures."""
        return tuple(figure.title for figure in look_figures(self._evidence))

    def table(self) -> Listing:
        """The runs: range of motion and force, noise floor, energy per cycle."""
        return Listing.of(look_grid(self.as_dict()))

    def to_pandas(self) -> DataFrame:
        """The same as a pandas frame."""
        return self.table().to_pandas()

    def plot(self, title: str = "Force over velocity at mid stroke") -> PlotlyFigure:
        """Draw the picture of this title, one of ``pictures``. ValueError for another one."""
        drawn = {figure.title: figure for figure in look_figures(self._evidence)}
        if title not in drawn:
            hint = nearest(title, drawn) or "choose one of them"
            raise ValueError(f"expected a picture out of {', '.join(drawn)}, got '{title}'; {hint}")
        return interactive(drawn[title])

    def report(self, path: str | Path) -> Path:
        """Write the report, one HTML file that needs nothing else; the path."""
        return write_page(path, look_page(self.as_dict(), self._evidence))

    @cached_property
    def _evidence(self) -> Evidence:
        stiffness = signal_evidence(self.setting.dataset.runs, {})["dynamic_stiffness"]
        provenance = provenance_of(self.setting, self.seed)
        return cast("Evidence", {**self.evidence(), "dynamic_stiffness": stiffness, "provenance": provenance})

    def _repr_html_(self) -> str:
        found: dict[str, Any] = self.as_dict()
        return cell(self.headline, look_grid(found))
