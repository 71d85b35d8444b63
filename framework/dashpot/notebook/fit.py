"""A fit that shows itself."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dashpot.compare.comparison import Comparison as PlainComparison
from dashpot.contract.registry import load_registry
from dashpot.data.dataset import Dataset
from dashpot.fit.api import prepare
from dashpot.fit.result import FitResult
from dashpot.kernel.api import forces_by_name, solve_runs
from dashpot.model.reading import parse_network
from dashpot.notebook.beyond import warn_of_range
from dashpot.notebook.cell import cell
from dashpot.notebook.listing import Listing
from dashpot.notebook.model import Model
from dashpot.notebook.plots import plot
from dashpot.notebook.printed import Printed
from dashpot.notebook.promoted import promoted
from dashpot.report.grids import comparison_grid
from dashpot.report.parameters import parameters_grid
from dashpot.report.parts import Grid, Notice

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from pandas import DataFrame
    from plotly.graph_objects import Figure as PlotlyFigure


class Fit(Printed, FitResult):
    """A network with its identified parameters. In a notebook it shows the errors, and the parameters with intervals.

    Examples:
        >>> fit = dp.fit("mount.yaml", data, seed=1)
        >>> fit.errors.held_out > fit.noise_floor.value
        True
        >>> fit.at_bound
        ()
        >>> fit.model.name
        'mount'
        >>> fit.free, fit.covariance.shape
        (('rubber.stiffness', 'damping.damping'), (2, 2))
        >>> fit.residuals["a1_p2_up"].shape == data.run("a1_p2_up").force.shape
        True
        >>> fit.aic < fit.bic
        True
    """

    @property
    def _line(self) -> str:
        """The errors in a line."""
        return self.summary().partition("\n")[0]

    def __str__(self) -> str:
        return self.summary()

    def table(self) -> Listing:
        """Every parameter with its 95 % interval, the bounds of the search, and remarks."""
        remarks = {slot.path: "identified" for slot in self.fitted.slots() if slot.value.searched}
        remarks |= dict.fromkeys(self.at_bound, "identified at the end of its range")
        remarks |= dict.fromkeys(self.known.undetermined if self.known else (), "not identifiable from these data")
        remarks |= dict.fromkeys(self.idle, "without influence on these data")
        return Listing.of(parameters_grid(self.fitted, remarks))

    def to_pandas(self) -> DataFrame:
        """The same as a pandas frame."""
        return self.table().to_pandas()

    def plot(self, what: str = "stiffness") -> PlotlyFigure:
        """Draw measurement and fit: ``stiffness``, ``loops``, ``residuals``, ``harmonics``, ``misfit`` or ``history``.

        ValueError for another name, and for a stiffness where nothing oscillates.
        """
        return plot(what, self._evidence)

    @property
    def residuals(self) -> dict[str, NDArray[np.float64]]:
        """Residual (n,) in N of every run: measured minus simulated force. The RMSE excludes the warm-up."""
        simulated = self._comparison.simulated[self.declared.name]
        return {run.name: run.force - simulated[run.name] for run in self.dataset.runs}

    def predict(self, data: Dataset) -> dict[str, NDArray[np.float64]]:
        """The force (n,) in N of every run of a dataset, by name, with the identified parameters.

        Runs beyond the range of the identification give a UserWarning.
        """
        found = forces_by_name(solve_runs(self.fitted, data))
        warn_of_range(self.model, {run.name: run for run in data.runs})
        return found

    @cached_property
    def model(self) -> Model:
        """The identified network: it has the parameters, and can be simulated, fitted again and saved."""
        own = {branch.element.word: branch.element for branch in self.fitted.leaves()}
        elements = {**load_registry().elements, **own}
        return promoted(Model, parse_network(self.identified_text, elements, self.declared.file))

    def save(self, path: str | Path) -> Path:
        """Write the identified network as YAML; the path."""
        target = Path(path)
        target.write_text(self.identified_text, encoding="utf-8")
        return target

    @cached_property
    def _comparison(self) -> PlainComparison:
        return PlainComparison(prepare(self.dataset, self.seed), (self,), {}, self.seed)

    @cached_property
    def _evidence(self) -> dict[str, Any]:
        return self._comparison.evidence()

    def _repr_html_(self) -> str:
        errors = comparison_grid(self._comparison.as_dict())
        ending: list[Notice | str] = [f"Ended because: {self.ending}."]
        numbers: Grid = self.table()
        return cell(f"{self.declared.name} on {self.dataset.name}", errors, numbers, *ending)
