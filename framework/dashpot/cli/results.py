"""The result files of a comparison and of a diagnosis."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from dashpot.cli.output import OutputFolder

if TYPE_CHECKING:
    from dashpot.compare.comparison import Comparison
    from dashpot.compare.look import Look
    from dashpot.contract.registry import Registry
    from dashpot.diagnose.diagnosis import Diagnosis
    from dashpot.fit.api import Setting
    from dashpot.fit.result import Errors, FitResult
    from dashpot.report.evidence import Evidence

SAME_ERROR = 1e-6  # of an RMSE: what is told and what the files say
COMPARISON_FILES = ("compare.json", "compare.csv", "report.html")
LOOK_FILES = ("look.json", "report.html")


def diagnosis_files(network: str) -> tuple[str, ...]:
    """Patterns of the files that the diagnosis of a network may write."""
    told = ("diagnosis.json", "report.html", "dataset.yaml", "dataset.triage.yaml")
    return *told, f"{escape(network)}.yaml", f"{escape(network)}+*.yaml"


def fit_files(network: str) -> tuple[str, ...]:
    """Patterns of the files that the fit of a network writes."""
    return (
        "fit.json",
        "numbers.csv",
        "knots.csv",
        "posterior.csv",
        "draws.csv",
        "report.html",
        f"{escape(network)}.yaml",
    )


def write_fit(fit: FitResult, folder: OutputFolder) -> Path:
    """Write the identified network, and the fit as JSON, table and report; the path of the report."""
    from dashpot.compare.comparison import comparison_of
    from dashpot.report.fit import fit_page, knots_grid, numbers_grid
    from dashpot.report.json_text import json_text
    from dashpot.report.networks import with_network
    from dashpot.report.page import render
    from dashpot.report.posterior import draws_grid, draws_of, posterior_grid
    from dashpot.report.tables import to_csv

    content, name = fit.as_dict(), f"{fit.declared.name}.yaml"
    comparison = comparison_of(fit)
    patch = {"before": fit.declared.text, "after": fit.identified_text, "before_name": "declared", "after_name": name}
    evidence = with_network({**comparison.evidence(), "patch": patch}, fit.fitted.name, fit.fitted, fit.dataset)
    grids = [numbers_grid(content), knots_grid(content)]
    if fit.posterior:
        evidence["draws"] = draws_of(fit.posterior, fit.fitted)
        grids += [posterior_grid(content), draws_grid(fit.posterior)]
    with folder.together() as results:
        results.write("fit.json", json_text(content))
        for grid in grids:
            results.write(grid.csv_name, to_csv(grid.rows, grid.columns))
        results.write(name, fit.identified_text)
        return results.write("report.html", render(fit_page(content, comparison.as_dict(), evidence)))


def write_comparison(comparison: Comparison, folder: OutputFolder, identified: bool = False) -> Path:
    """Write the comparison as JSON, CSV and report, and the ``identified`` networks; the path of the report."""
    from dashpot.report.comparison import comparison_page
    from dashpot.report.grids import comparison_grid
    from dashpot.report.json_text import json_text
    from dashpot.report.networks import with_schematics
    from dashpot.report.page import render
    from dashpot.report.tables import to_csv

    content = comparison.as_dict()
    grid = comparison_grid(content)
    evidence = with_schematics(comparison.evidence(), {fit.fitted.name: fit.fitted for fit in comparison.fits})
    with folder.together() as results:
        results.write("compare.json", json_text(content))
        results.write("compare.csv", to_csv(grid.rows, grid.columns))
        for fit in comparison.fits if identified else ():
            results.write(f"{fit.declared.name}.yaml", fit.identified_text)
        return results.write("report.html", render(comparison_page(content, evidence)))


def write_look(look: Look, folder: OutputFolder) -> Path:
    """Write a look at measured runs as JSON and report; the path of the report."""
    from dashpot.report.json_text import json_text
    from dashpot.report.look import look_page
    from dashpot.report.page import render

    content = look.as_dict()
    with folder.together() as results:
        results.write("look.json", json_text(content))
        return results.write("report.html", render(look_page(content, look_evidence(look))))


def look_evidence(look: Look) -> Evidence:
    """The evidence of a look, with dynamic stiffness and where it comes from."""
    from dashpot.compare.provenance import provenance_of
    from dashpot.compare.signals import signal_evidence

    stiffness = signal_evidence(look.setting.dataset.runs, {})["dynamic_stiffness"]
    provenance = provenance_of(look.setting, look.seed)
    return cast("Evidence", {**look.evidence(), "dynamic_stiffness": stiffness, "provenance": provenance})


def write_diagnosis(diagnosis: Diagnosis, folder: OutputFolder) -> Path:
    """Write the diagnosis as JSON and report, and the extended network if there is one; the path of the report."""
    from dashpot.report.diagnosis import diagnosis_page
    from dashpot.report.json_text import json_text
    from dashpot.report.networks import with_network
    from dashpot.report.page import render

    content = diagnosis.as_dict()
    title = (diagnosis.extended_name or diagnosis.model.name).removesuffix(".yaml")
    evidence = with_network(diagnosis.evidence(), title, diagnosis.final, diagnosis.setting.dataset)
    with folder.together() as results:
        results.write("diagnosis.json", json_text(content))
        results.write(diagnosis.fitted_name, diagnosis.fitted_text)
        if diagnosis.extended_name is not None and diagnosis.extended_text is not None:
            results.write(diagnosis.extended_name, diagnosis.extended_text)
        for name, text in diagnosis.datasets(folder.path).items():
            results.write(name, text)
        return results.write("report.html", render(diagnosis_page(content, evidence)))


def checked(diagnosis: Diagnosis, folder: OutputFolder, registry: Registry) -> str:
    """The written files read again and simulated: what was told beside what they say. InputError where they differ."""
    before, after = diagnosis.fitted_name, diagnosis.extended_name or diagnosis.fitted_name
    setting = _read_again(diagnosis.setting, diagnosis.triaged_name, diagnosis.seed, folder, registry)
    _refuse_other_errors(
        diagnosis.before, _measured_again(before, setting, diagnosis.jobs, folder, registry), folder.path / before
    )
    setting = _read_again(diagnosis.after_setting, diagnosis.corrected_name, diagnosis.seed, folder, registry)
    found = _measured_again(after, setting, diagnosis.jobs, folder, registry)
    _refuse_other_errors(diagnosis.after, found, folder.path / after)
    runs = f"{found.train:.4g} N on training runs"
    runs += "" if found.held_out is None else f", {found.held_out:.4g} N on held-out runs"
    return f"check: {after} read again and simulated has the reported RMSE: {runs}"


def _read_again(setting: Setting, name: str | None, seed: int, folder: OutputFolder, registry: Registry) -> Setting:
    """The setting with the runs of the corrected dataset of a name; the setting itself where there is none."""
    from dashpot.data.dataset import read_dataset
    from dashpot.fit.api import prepare

    if name is None:
        return setting
    readers = {word: reader() for word, reader in registry.formats.items()}
    again = prepare(read_dataset(folder.path / name, readers, allow_outside=True), seed)
    return replace(setting, scored={run: again.scored[run] for run in setting.scored})


def _measured_again(name: str, setting: Setting, jobs: int, folder: OutputFolder, registry: Registry) -> Errors:
    """The errors of a written network, read again."""
    from dashpot.fit.api import measure_errors
    from dashpot.model.reading import read_network

    return measure_errors(read_network(str(folder.path / name), registry.elements), setting, jobs)


def _refuse_other_errors(told: Errors, found: Errors, network: Path) -> None:
    """InputError where the errors that a written network was found to have are not those that were told."""
    from dashpot.text.problem import InputError, Place

    for one, other in ((told.train, found.train), (told.held_out, found.held_out)):
        if one is not None and other is not None and abs(one - other) > SAME_ERROR * one:
            raise InputError.at(
                Place(str(network)),
                f"expected an RMSE of {one:.9g} N, got {other:.9g} N",
                "the result does not hold: please report it with the dataset",
            )


def comparison_text(comparison: Comparison) -> str:
    """The comparison for the terminal: the answer in a sentence, then the table."""
    from dashpot.report.comparison import comparison_headline
    from dashpot.report.grids import comparison_grid
    from dashpot.report.tables import plain_table

    content = comparison.as_dict()
    return "\n".join([plain_table(comparison_grid(content)), comparison_headline(content), *told_of_models(content)])


def told_of_models(content: Mapping[str, Any]) -> list[str]:
    """What the data do not tell of the parameters of compared models, and which branches may go, in sentences."""
    return [
        f"{model['name']}: {sentence}"
        for model in content["models"]
        for known in [model.get("identifiability") or {"weak": (), "may_go": ()}]
        for sentence in (*known["weak"], *known["may_go"])
    ]


def look_text(look: Look) -> str:
    """A look for the terminal: the runs in a table, then what there is to explain."""
    from dashpot.report.look import FEW, look_grid, look_headline
    from dashpot.report.tables import plain_table

    content = look.as_dict()
    return f"{plain_table(look_grid(content, FEW))}\n{look_headline(content)}"


def diagnosis_text(diagnosis: Diagnosis) -> str:
    """The diagnosis for the terminal: the causes, the errors beside their references, then the answer in a sentence."""
    from dashpot.report.grids import cause_grid
    from dashpot.report.headline import beside_references, headline
    from dashpot.report.tables import plain_table

    content = diagnosis.as_dict()
    causes = f"{plain_table(cause_grid(content))}\n" if content["causes"] else ""
    return causes + "\n".join(filter(None, [beside_references(content), headline(content)]))
