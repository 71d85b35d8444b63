"""The result files of a comparison and of a diagnosis."""

from __future__ import annotations

from collections.abc import Mapping
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from dashpot.cli.output import OutputFolder

if TYPE_CHECKING:
    from dashpot.assess.compare import Comparison
    from dashpot.assess.diagnosis import Diagnosis
    from dashpot.model.network import NetworkSpec
    from dashpot.report.evidence import Evidence

COMPARISON_FILES = ("compare.json", "compare.csv", "report.html")


def diagnosis_files(network: str) -> tuple[str, ...]:
    """Patterns of the files that the diagnosis of a network may write."""
    return "diagnosis.json", "report.html", f"{escape(network)}+*.yaml"


def write_comparison(comparison: Comparison, folder: OutputFolder) -> Path:
    """Write the comparison as JSON, CSV and report; the path of the report."""
    from dashpot.report.comparison import comparison_page
    from dashpot.report.grids import comparison_grid
    from dashpot.report.json_text import json_text
    from dashpot.report.page import render
    from dashpot.report.tables import to_csv

    content = comparison.as_dict()
    grid = comparison_grid(content)
    folder.write("compare.json", json_text(content))
    folder.write("compare.csv", to_csv(grid.rows, grid.columns))
    evidence = with_schematics(comparison.evidence(), {fit.fitted.name: fit.fitted for fit in comparison.fits})
    return folder.write("report.html", render(comparison_page(content, evidence)))


def write_diagnosis(diagnosis: Diagnosis, folder: OutputFolder) -> Path:
    """Write the diagnosis as JSON and report, and the extended network if there is one; the path of the report."""
    from dashpot.report.diagnosis import diagnosis_page
    from dashpot.report.json_text import json_text
    from dashpot.report.page import render

    content = diagnosis.as_dict()
    folder.write("diagnosis.json", json_text(content))
    if diagnosis.extended_text is not None:
        folder.write(diagnosis.extended_name, diagnosis.extended_text)
    title = (diagnosis.extended_name or diagnosis.model.name).removesuffix(".yaml")
    evidence = with_schematics(diagnosis.evidence(), {title: diagnosis.final})
    return folder.write("report.html", render(diagnosis_page(content, evidence)))


def with_schematics(evidence: Mapping[str, Any], networks: Mapping[str, NetworkSpec]) -> Evidence:
    """The evidence with the schematics of networks, each under its title."""
    from dashpot.report.schematic.svg import svg

    return cast("Evidence", {**evidence, "schematic": {title: svg(network) for title, network in networks.items()}})


def comparison_text(comparison: Comparison) -> str:
    """The comparison for the terminal: the answer in a sentence, then the table."""
    from dashpot.report.comparison import comparison_headline
    from dashpot.report.grids import comparison_grid
    from dashpot.report.tables import plain_table

    content = comparison.as_dict()
    return f"{plain_table(comparison_grid(content))}\n{comparison_headline(content)}"


def diagnosis_text(diagnosis: Diagnosis) -> str:
    """The diagnosis for the terminal: the answer in a sentence, then the causes."""
    from dashpot.report.grids import cause_grid
    from dashpot.report.headline import headline
    from dashpot.report.tables import plain_table

    content = diagnosis.as_dict()
    causes = f"{plain_table(cause_grid(content))}\n" if content["causes"] else ""
    return causes + headline(content)
