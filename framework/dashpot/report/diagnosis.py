"""The report of a diagnosis."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from dashpot.report import figures, grids
from dashpot.report.colophon import colophon
from dashpot.report.comparison import shape_parts
from dashpot.report.evidence import Evidence
from dashpot.report.headline import headline, read_errors, short_headline
from dashpot.report.parts import Code, KeyFigures, Notice, NoticeKind, Page, Part, Picture, Section
from dashpot.report.patch import diff
from dashpot.report.readable import percent
from dashpot.text.digits import shown_with_unit

Json = Mapping[str, Any]

VERDICTS: dict[str, tuple[NoticeKind, str]] = {
    "explained": ("good", "Every significant misfit of the training runs has an accepted cause."),
    "nothing_missing": ("good", "The residual is at the noise floor: the data do not ask for a richer model."),
    "partly_explained": ("warning", "The accepted causes explain part of the error; something is still missing."),
    "unexplained": ("bad", "Something is missing in the model that none of the known causes fits."),
    "ambiguous": (
        "warning",
        "More than one cause fits these data, or one is no more than probable; a further measurement would tell.",
    ),
    "bad_data": ("bad", "The measurement has to be put right before the model can be judged."),
}


def diagnosis_page(diagnosis: Json, evidence: Evidence) -> Page:
    """The report of a `dashpot-diagnosis/1`; in `evidence` the labels are "before" and "after".

    Used keys: all of `Evidence`, which says shapes and units; a missing one leaves its part out. Beyond the contract
    a cause may have a `title` (its name in words) and each of its parameters a `unit` (SI), which the headline
    and the tables then show. Raises ValueError for an unknown verdict.
    """
    sections = [section for section in _sections(diagnosis, evidence) if section.parts]
    return Page(
        title=f"Diagnosis of {_name(diagnosis, 'model')} on {_name(diagnosis, 'dataset')}",
        headline=short_headline(diagnosis),
        lead=_lead(diagnosis),
        sections=sections,
        colophon=colophon(diagnosis, evidence),
        summary=("Causes", "Dynamic stiffness and loss angle"),
    )


def _sections(diagnosis: Json, evidence: Evidence) -> Iterator[Section]:
    yield Section("Verdict", parts=list(_verdict(diagnosis, evidence)))
    yield Section("The shape of the force", parts=list(shape_parts(evidence)))
    yield Section("What is wrong", parts=list(_misfit(diagnosis, evidence)))
    yield Section("Why", parts=list(_causes(diagnosis)))
    yield Section(
        "The extended model" if "patch" in evidence else "The model", parts=list(_extension(diagnosis, evidence))
    )
    title = "Before and after" if (diagnosis.get("rmse") or {}).get("after") else "Measured and simulated"
    yield Section(title, parts=list(_before_and_after(diagnosis, evidence)))
    yield Section("What to measure next", parts=[Notice("info", text) for text in _next(diagnosis, evidence)])
    yield Section("The limits of this diagnosis", _tried(evidence), list(_limits(evidence)))


def _verdict(diagnosis: Json, evidence: Evidence) -> Iterator[Part]:
    yield KeyFigures(_key_figures(diagnosis))
    yield from verdict_notices(diagnosis, evidence.get("warnings", ()))


def verdict_notices(diagnosis: Json, warnings: Sequence[str] = ()) -> Iterator[Notice]:
    """What the verdict means, its remarks right behind it, then further warnings, each once."""
    yield Notice(*VERDICTS[diagnosis["verdict"]])
    yield from (Notice("warning", text) for text in dict.fromkeys([*(diagnosis.get("remarks") or ()), *warnings]))


def _misfit(diagnosis: Json, evidence: Evidence) -> Iterator[Part]:
    if diagnosis.get("misfit"):
        yield grids.misfit_grid(diagnosis)
    if evidence.get("misfit_map"):
        yield figures.misfit_map(evidence["misfit_map"])
    if evidence.get("harmonics"):
        yield figures.harmonic_bars(evidence["harmonics"])


def _causes(diagnosis: Json) -> Iterator[Part]:
    if not diagnosis["causes"]:
        return
    yield from (grid for grid in (grids.named_grid(diagnosis), grids.unnamed_grid(diagnosis)) if grid.rows)
    if any(cause.get("gain") is not None for cause in diagnosis["causes"]):
        yield figures.gain_intervals(diagnosis["causes"])


def _extension(diagnosis: Json, evidence: Evidence) -> Iterator[Part]:
    yield from (Picture(title, svg) for title, svg in evidence.get("schematic", {}).items())
    if evidence.get("curves"):
        yield figures.identified_curves(evidence["curves"])
    patch = evidence.get("patch")
    if patch:
        name = patch.get("after_name") or diagnosis.get("extended_model") or "extended.yaml"
        title = f"{patch.get('before_name', 'model')} → {name}"
        yield Code(title, diff(patch["before"], patch["after"]), "diff", name, patch["after"])


def _before_and_after(diagnosis: Json, evidence: Evidence) -> Iterator[Part]:
    rmse = diagnosis.get("rmse") or {}
    bars = [{"name": label, **rmse[label]} for label in ("before", "after") if rmse.get(label)]
    if bars:
        yield figures.rmse_bars(bars, grids.floor_value(diagnosis), grids.explainable_value(diagnosis))
    if evidence.get("dynamic_stiffness"):
        yield from figures.stiffness_figures(evidence["dynamic_stiffness"])
    if "loops" in evidence:
        yield figures.loops(**evidence["loops"])
    if "loops" in evidence and evidence.get("branches"):
        yield figures.branch_loops(evidence["loops"]["measured"], evidence["branches"])
    if "residuals" in evidence:
        yield figures.residual_traces(**evidence["residuals"])
    if evidence.get("history"):
        yield figures.convergence_history(evidence["history"])


def _next(diagnosis: Json, evidence: Evidence) -> list[str]:
    named = [cause["next_measurement"] for cause in diagnosis["causes"] if cause.get("next_measurement")]
    return list(dict.fromkeys(evidence.get("next_measurement") or named))


def _limits(evidence: Evidence) -> Iterator[Part]:
    if evidence.get("limits"):
        yield grids.limits_grid(evidence["limits"])
    if evidence.get("rejected"):
        yield grids.rejected_grid(evidence["rejected"])


def _tried(evidence: Evidence) -> str:
    tried = evidence.get("tried")
    return f"{tried} candidates were tried." if tried else ""


def _key_figures(diagnosis: Json) -> list[tuple[str, str, str, str]]:
    errors, explainable = read_errors(diagnosis), grids.explainable_value(diagnosis)
    runs = f"RMSE on {errors.runs}"
    less = "" if errors.gain is None else f"{percent(errors.gain)} less, "
    shown = [
        ("error before", errors.before, "N", runs),
        ("error after", errors.after, "N", f"{less}{runs}"),
        ("explainable", explainable, "N", f"of a general model of the past motion{grids.cross_validated(diagnosis)}"),
        ("noise floor", errors.floor, "N", grids.floor_note(diagnosis)),
    ]
    return [(label, *shown_with_unit(value, unit), note) for label, value, unit, note in shown if value is not None]


def _lead(diagnosis: Json) -> str:
    model, extended = _name(diagnosis, "model"), diagnosis.get("extended_model")
    how = "extended to" if diagnosis["causes"] else "reduced to" if diagnosis.get("may_go") else "fitted anew as"
    done = f"was {how} {extended}" if extended else "was left as it is"
    origins = (grids.floor_origin(diagnosis), grids.explainable_origin(diagnosis))
    return " ".join(filter(None, [f"{headline(diagnosis)} {model} {done}.", *origins]))


def _name(diagnosis: Json, key: str) -> str:
    return (diagnosis.get(key) or {}).get("name") or f"the {key}"
