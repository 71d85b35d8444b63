"""A campaign that shows itself."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from dashpot.campaign.content import campaign_content
from dashpot.campaign.run import CampaignResult
from dashpot.notebook.cell import cell
from dashpot.notebook.listing import Listing
from dashpot.notebook.plots import interactive
from dashpot.notebook.printed import Printed
from dashpot.report.campaign import campaign_headline, named_grid, number_figure, population_grid, specimens_grid

if TYPE_CHECKING:
    from pandas import DataFrame
    from plotly.graph_objects import Figure as PlotlyFigure


class Campaign(Printed, CampaignResult):
    """Many specimens as a population. In a notebook it shows means and scatter, and the outliers.

    Examples:
        >>> campaign = dp.campaign("mounts.yaml")
        >>> print(campaign.headline)
        3 specimens: too few were fitted to compare each with the others.
        >>> [column.heading for column in campaign.table().columns][:2]
        ['specimen', 'data']
    """

    @cached_property
    def content(self) -> dict[str, Any]:
        """The result in plain values, as in ``campaign.json``."""
        return campaign_content(self)

    @property
    def _line(self) -> str:
        """The answer in a line."""
        return self.headline

    @property
    def headline(self) -> str:
        """The answer in a sentence."""
        return campaign_headline(self.content)

    def table(self) -> Listing:
        """Every specimen with its properties, its parameters and their intervals in SI."""
        return Listing.of(specimens_grid(self.content))

    def to_pandas(self) -> DataFrame:
        """The same as a pandas frame."""
        return self.table().to_pandas()

    def plot(self, parameter: str, over: str = "", model: str = "") -> PlotlyFigure:
        """Draw a parameter of a model over the specimens, or over one of their properties.

        ``model`` is the first one unless said otherwise. ValueError for what no specimen has.
        """
        return interactive(number_figure(self.content, model or self.campaign.models[0].name, parameter, over))

    def _repr_html_(self) -> str:
        return cell(self.headline, population_grid(self.content), named_grid(self.content))
