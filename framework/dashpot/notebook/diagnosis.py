"""A diagnosis that shows itself."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dashpot.contract.registry import load_registry
from dashpot.data.correction import corrected_run
from dashpot.diagnose.diagnosis import Diagnosis as PlainDiagnosis
from dashpot.diagnose.single_runs import correction_of
from dashpot.model.reading import parse_network
from dashpot.notebook.cell import cell
from dashpot.notebook.data import Data
from dashpot.notebook.listing import Listing
from dashpot.notebook.model import Model
from dashpot.notebook.plots import PLOTS, interactive, plot
from dashpot.notebook.printed import Printed
from dashpot.notebook.promoted import promoted
from dashpot.report.diagnosis import diagnosis_page, verdict_notices
from dashpot.report.figures import gain_intervals
from dashpot.report.grids import cause_grid, misfit_grid
from dashpot.report.headline import headline
from dashpot.report.networks import with_network
from dashpot.report.page import write_page
from dashpot.report.parts import Code, Part
from dashpot.report.patch import diff

if TYPE_CHECKING:
    from pandas import DataFrame
    from plotly.graph_objects import Figure as PlotlyFigure


class Diagnosis(Printed, PlainDiagnosis):
    """What a network gets wrong, and why. In a notebook it shows the answer, the causes, and what they change.

    Examples:
        >>> diagnosis.verdict
        'explained'
        >>> [named.cause.word for named in diagnosis.named]
        ['relaxation']
        >>> [branch.element.word for branch in diagnosis.extended.leaves()][-1]
        'maxwell'
        >>> diagnosis.corrected_data.runs[0].name
        'a0p5_p2_up'
    """

    @property
    def _line(self) -> str:
        """The answer in a line."""
        return self.headline

    @property
    def headline(self) -> str:
        """The answer in a sentence."""
        return headline(self.as_dict())

    def table(self) -> Listing:
        """The causes: evidence, gain on held-out runs with its interval, parameters, rivals."""
        return Listing.of(cause_grid(self.as_dict()))

    def misfits(self) -> Listing:
        """What the network gets wrong before any cause is named, and where."""
        return Listing.of(misfit_grid(self.as_dict()))

    def to_pandas(self) -> DataFrame:
        """The table of causes as a pandas frame."""
        return self.table().to_pandas()

    def plot(self, what: str = "gains") -> PlotlyFigure:
        """Draw ``gains``, or what a fit draws, before and after. ValueError for another name."""
        if what == "gains":
            return interactive(gain_intervals(self.as_dict()["causes"]))
        return plot(what, self._evidence, ("gains", *PLOTS))

    @cached_property
    def extended(self) -> Model | None:
        """The network with the accepted causes, ready to be simulated and saved; None where none was accepted."""
        if self.extended_text is None:
            return None
        own = {branch.element.word: branch.element for branch in self.final.leaves()}
        elements = {**load_registry().elements, **own}
        return promoted(Model, parse_network(self.extended_text, elements, self.model.file))

    @cached_property
    def corrected_data(self) -> Data:
        """The measured runs as the corrected dataset has them: faults of runs put right, without runs set aside.

        ``fit``, ``compare`` and ``write_dataset`` take them. Runs in memory have no other corrected dataset.
        """
        dataset = self.setting.dataset
        found = {run.name: correction_of(run.name, self.accused) for run in dataset.runs}
        runs = (corrected_run(run, by) if (by := found[run.name]) else run for run in dataset.runs)
        return Data(dataset.name, tuple(runs))

    def report(self, path: str | Path) -> Path:
        """Write the report, one HTML file that needs nothing else; the path."""
        title = (self.extended_name or self.model.name).removesuffix(".yaml")
        evidence = with_network(self._evidence, title, self.final, self.setting.dataset)
        return write_page(path, diagnosis_page(self.as_dict(), evidence))

    @cached_property
    def _evidence(self) -> dict[str, Any]:
        return self.evidence()

    def _parts(self) -> Iterator[Part]:
        content, patch = self.as_dict(), self.patch()
        yield from verdict_notices(content)
        if content["causes"]:
            yield cause_grid(content)
        if patch:
            changes = [line for line in diff(patch["before"], patch["after"]).splitlines() if line[:1] in "+-"]
            yield Code(f"{patch['before_name']} → {patch['after_name']}", "\n".join(changes), "diff")

    def _repr_html_(self) -> str:
        return cell(self.headline, *self._parts())
