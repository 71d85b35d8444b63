"""The posterior of a fit in its report: the intervals of both side by side, the draws as table and figures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from dashpot.report import figures
from dashpot.report.evidence import Draws
from dashpot.report.parts import Column, Figure, Grid, Notice, Part
from dashpot.report.readable import join
from dashpot.text.digits import rig_unit

if TYPE_CHECKING:
    from dashpot.fit.posterior import Posterior
    from dashpot.model.network import NetworkSpec

Json = Mapping[str, Any]

MOST_DRAWS = 10_000  # rows of the table
DRAWN = ("posterior.csv", "draws.csv")
TEXT = (
    "What data and priors together say about the parameters, within the bounds. The draws follow a model that is not "
    "linear, and bounds that cut an interval off; the intervals of the fit follow the colour of the residual as each "
    "parameter feels it, for which the posterior has one error of all samples."
)


def posterior_parts(fit: Json, draws: Draws | None) -> Iterator[Part]:
    """The table of a `dashpot-fit/1` with a posterior, whether it converged, and the figures of its draws."""
    told = fit["posterior"]
    yield Notice("info" if told["converged"] else "warning", f"{told['sentence'][:1].upper()}{told['sentence'][1:]}.")
    if told["held"]:
        yield Notice(
            "info",
            f"Held in the draws, though uncertain themselves: {join(told['held'])}. The intervals of the fit count "
            "their uncertainty, the posterior does not.",
        )
    yield posterior_grid(fit)
    if draws is not None:
        yield from draw_figures(draws)


def draw_figures(draws: Draws) -> list[Figure]:
    """Pairs, traces and ranks of the draws."""
    return [figures.corner(draws), figures.draw_traces(draws), figures.draw_ranks(draws)]


def posterior_grid(fit: Json) -> Grid:
    """Every number: median and interval of the posterior, value and interval of the fit, and the state of the chain."""
    rows = []
    for path, each in fit["posterior"]["parameters"].items():
        factor, unit = rig_unit(each["unit"], abs(each["median"]))
        fitted = fit["parameters"][path]
        numbers = {"median": each["median"], "low": each["interval"][0], "high": each["interval"][1]}
        numbers |= {"value": fitted["value"]}
        numbers |= dict(zip(("from", "to"), fitted["interval"] or (None, None), strict=True))
        rows.append(
            {
                "number": path,
                **{key: None if value is None else value * factor for key, value in numbers.items()},
                "unit": unit or None,
                "r_hat": each["r_hat"],
                "effective": each["effective_draws"],
                "time": each["autocorrelation_time"],
            }
        )
    columns = [
        Column("number", "parameter"),
        Column("median", "posterior: median", "", 5),
        Column("low", "posterior: 95 % from", "", 5),
        Column("high", "posterior: to", "", 5),
        Column("value", "fit", "", 5),
        Column("from", "fit: 95 % from", "", 5),
        Column("to", "fit: to", "", 5),
        Column("unit", "unit"),
        Column("r_hat", "R-hat", "", 4),
        Column("effective", "effective draws", "", 3),
        Column("time", "autocorrelation time, steps", "", 3),
    ]
    return Grid("Posterior beside the intervals of the fit", columns, rows, csv_name=DRAWN[0])


def draws_grid(posterior: Posterior) -> Grid:
    """The draws, thinned: step, walker and the numbers in the units of the rig."""
    units = [rig_unit(each.unit, abs(each.median)) for each in posterior.marginals]
    columns = [Column("step", "step"), Column("walker", "walker")]
    columns += [
        Column(each.path, each.path, unit, 6) for each, (_, unit) in zip(posterior.marginals, units, strict=True)
    ]
    rows = [
        {"step": int(step), "walker": int(walker)}
        | {
            each.path: float(number * factor)
            for each, number, (factor, _) in zip(posterior.marginals, numbers, units, strict=True)
        }
        for step, walker, *numbers in posterior.thinned(MOST_DRAWS)
    ]
    return Grid("Draws from the posterior", columns, rows, csv_name=DRAWN[1])


def draws_of(posterior: Posterior, fitted: NetworkSpec) -> Draws:
    """The draws as evidence: numbers with the fewest effective draws first."""
    table = posterior.thinned(MOST_DRAWS)
    order = sorted(range(len(posterior.marginals)), key=lambda k: posterior.marginals[k].effective)
    values = {slot.path: slot.value.number for slot in fitted.slots()}
    paths = [posterior.marginals[k].path for k in order]
    return Draws(
        step=table[:, 0],
        walker=table[:, 1],
        numbers={path: table[:, 2 + k] for path, k in zip(paths, order, strict=True)},
        units={path: posterior.marginals[k].unit for path, k in zip(paths, order, strict=True)},
        fitted={path: values[path] for path in paths},
    )
