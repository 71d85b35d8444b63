"""A comparison that shows itself."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dashpot.compare.comparison import Comparison as PlainComparison
from dashpot.notebook.cell import cell
from dashpot.notebook.listing import Listing
from dashpot.notebook.plots import PLOTS, interactive, plot
from dashpot.notebook.printed import Printed
from dashpot.report.comparison import comparison_headline, comparison_page
from dashpot.report.figures import rmse_bars
from dashpot.report.grids import comparison_grid, explainable_value, floor_value, runs_grid
from dashpot.report.page import write_page
from dashpot.report.schematic.svg import svg

if TYPE_CHECKING:
    from pandas import DataFrame
    from plotly.graph_objects import Figure as PlotlyFigure


class Comparison(Printed, PlainComparison):
    """Several networks on the same runs. In a notebook it shows the table of their errors.

    Examples:
        >>> comparison = dp.compare(["spring", "mount.yaml"], data)
        >>> print(comparison.headline)
        mount has the lowest RMSE: ... N, ... × the noise floor (... N).
        >>> sorted(comparison.fits[1].errors.per_run) == sorted(run.name for run in comparison.setting.dataset.runs)
        True
    """

    @property
    def _line(self) -> str:
        """The answer in a line."""
        return self.headline

    @property
    def headline(self) -> str:
        """The answer in a sentence."""
        return comparison_headline(self.as_dict())

    def table(self) -> Listing:
        """The errors of every network, next to the explainable error and the noise floor."""
        return Listing.of(comparison_grid(self.as_dict()))

    def runs(self) -> Listing:
        """The error of every network on every run."""
        return Listing.of(runs_grid(self.as_dict()))

    def to_pandas(self) -> DataFrame:
        """The table of errors as a pandas frame."""
        return self.table().to_pandas()

    def plot(self, what: str = "errors") -> PlotlyFigure:
        """Draw ``errors``, or what a fit draws, of all networks. ValueError for another name."""
        if what == "errors":
            content = self.as_dict()
            bars = [{"name": model["name"], **model["rmse"]} for model in content["models"] if model["rmse"]]
            return interactive(rmse_bars(bars, floor_value(content), explainable_value(content)))
        return plot(what, self._evidence, ("errors", *PLOTS))

    def report(self, path: str | Path) -> Path:
        """Write the report, one HTML file that needs nothing else; the path."""
        schematics = {fit.fitted.name: svg(fit.fitted) for fit in self.fits}
        return write_page(path, comparison_page(self.as_dict(), {**self._evidence, "schematic": schematics}))  # type: ignore[typeddict-item]

    @cached_property
    def _evidence(self) -> dict[str, Any]:
        return self.evidence()

    def _repr_html_(self) -> str:
        return cell(self.headline, comparison_grid(self.as_dict()))
