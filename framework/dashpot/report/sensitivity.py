"""The report of a sensitivity study: where a test fails, what moves it, and the bands of specimens that scatter."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from dashpot.report import figures
from dashpot.report.colophon import colophon
from dashpot.report.parts import Column, Grid, Notice, Page, Part, Section
from dashpot.report.readable import join
from dashpot.report.tables import plain_table
from dashpot.text.digits import number, rig_unit
from dashpot.text.quantity import pretty

Json = Mapping[str, Any]

PLAIN = "nothing else changed"
BANDS = "Specimens whose parameters scatter: median, and the band of nine of ten. Those below the limit fail the test."
SIDE = "Metrics of one unit with nothing else changed. Where they should be the same number and are not, one is wrong."


def sensitivity_page(content: Json) -> Page:
    """The report of a `dashpot-sensitivity-result/1`."""
    study = content["study"]
    sections = [
        Section("Where the limits are reached", parts=[limits_grid(content)] if content["limits_reached"] else []),
        *(Section(metric["word"], metric["about"], list(_of_metric(content, metric))) for metric in content["metrics"]),
        Section("Side by side", SIDE, list(_side_by_side(content))),
        Section("Bands", BANDS, list(_bands(content))),
        Section("Measured runs", parts=[measured_grid(content)] if content["measured"] else []),
    ]
    varied = ", ".join(each["name"] for each in content["vary"]) or "nothing else"
    lead = (
        f"{study['about']} {study['parameter_vectors']} parameter vectors of {study['network']} on {study['rig']}, "
        f"over {content['over']['name']}; varied: {varied}."
    )
    told = {"format": content["format"], "model": {"name": study["network"]}}
    return Page(
        title=f"Study {study['name']}",
        headline=headline(content),
        lead=lead.strip(),
        sections=[section for section in sections if section.parts],
        colophon=colophon(told, {"provenance": {"seed": study["seed"], "draws": study["draws"]}}),
    )


def headline(content: Json) -> str:
    """Where each metric with a limit reaches it, with nothing else changed."""
    units = {metric["word"]: metric for metric in content["metrics"]}
    found = [
        _reached_sentence(each, units[each["metric"]], content["over"])
        for each in content["limits_reached"]
        if each["vary"] is None
    ]
    return " ".join(found) or f"Metrics over {content['over']['name']}."


def limits_grid(content: Json) -> Grid:
    """At which value of the variation over each metric reaches its limit, whatever else is changed."""
    over, rows = content["over"], dict[tuple[str | None, float | None], dict[str, Any]]()
    words = list(dict.fromkeys(each["metric"] for each in content["limits_reached"]))
    for each in content["limits_reached"]:
        row = rows.setdefault(
            (each["vary"], each["value"]), {"changed": _changed(content, each["vary"], each["value"])}
        )
        row[each["metric"]] = None if each["at"] is None else each["at"] * _factor(over)
    limits = {metric["word"]: metric for metric in content["metrics"]}
    columns = [Column("changed", "changed")] + [
        Column(word, f"{word} of {number(limits[word]['at_least'])} {limits[word]['unit']} at", "", 3) for word in words
    ]
    caption = f"The value of: {_heading(over)}. A dash: the limit is not reached in this range."
    return Grid("Where each metric reaches its limit", columns, list(rows.values()), caption, "limits.csv")


def curves_grid(content: Json) -> Grid:
    """Every metric at every place: what ``curves.csv`` holds."""
    over = content["over"]
    rows = [
        {
            "changed": _changed(content, curve["vary"], curve["value"]),
            "over": value * _factor(over),
            **{word: values[number] for word, values in curve["metrics"].items()},
        }
        for curve in content["curves"]
        for number, value in enumerate(over["values"])
    ]
    metrics = [Column(metric["word"], metric["word"], metric["unit"], 4) for metric in content["metrics"]]
    columns = [Column("changed", "changed"), Column("over", _heading(over), "", 4), *metrics]
    return Grid("All values", columns, rows, csv_name="curves.csv")


def bands_grid(content: Json) -> Grid:
    """Bands of specimens that scatter, and how many of them fail."""
    over = content["over"]
    units = {metric["word"]: metric["unit"] for metric in content["metrics"]}
    rows = [
        {
            "metric": band["metric"],
            "over": value * _factor(over),
            "unit": units[band["metric"]],
            **{key: band[key][place] for key in ("low", "median", "high")},
            "failing": _per_cent(band["failing"][place] if band["failing"] else None),
        }
        for band in content["bands"]
        for place, value in enumerate(over["values"])
    ]
    columns = [
        Column("metric", "metric"),
        Column("over", _heading(over), "", 3),
        Column("low", "5 % of the specimens below", "", 3),
        Column("median", "median", "", 3),
        Column("high", "95 % below", "", 3),
        Column("unit", "unit"),
        Column("failing", "fail", "%", 3),
    ]
    return Grid("Bands of specimens", columns, rows, csv_name="bands.csv")


def measured_grid(content: Json) -> Grid:
    """The metrics of measured runs."""
    columns = [Column("metric", "metric"), Column("run", "run"), Column("measured", "measured", "", 4)]
    return Grid(
        "Metrics of measured runs", [*columns, Column("unit", "unit")], content["measured"], csv_name="runs.csv"
    )


def sensitivity_text(content: Json) -> str:
    """The answer for the terminal: where limits are reached, and the bands."""
    grids = [limits_grid(content)] * bool(content["limits_reached"]) + [bands_grid(content)] * bool(content["bands"])
    grids += [measured_grid(content)] * bool(content["measured"])
    return "\n".join([*map(plain_table, grids or [curves_grid(content)]), headline(content)])


def _of_metric(content: Json, metric: Json) -> Iterator[Part]:
    word, over = metric["word"], _over(content)
    for variation in content["vary"]:
        lines = {
            _changed(content, curve["vary"], curve["value"]): curve["metrics"][word]
            for curve in content["curves"]
            if curve["vary"] == variation["name"]
        }
        title = f"{word} over {content['over']['name']}, for each {variation['name']}"
        yield figures.metric_lines(title, over, _metric_heading(metric), lines, limit=metric["at_least"])


def _side_by_side(content: Json) -> Iterator[Part]:
    for unit in dict.fromkeys(metric["unit"] for metric in content["metrics"]):
        alike = [metric for metric in content["metrics"] if metric["unit"] == unit]
        if len(alike) < 2:
            continue
        lines = {metric["word"]: content["curves"][0]["metrics"][metric["word"]] for metric in alike}
        limits = {metric["at_least"] for metric in alike}
        limit = limits.pop() if len(limits) == 1 else None
        title = f"{join(list(lines))} over {content['over']['name']}"
        yield figures.metric_lines(title, _over(content), f"metric ({unit})", lines, limit=limit, ordered=False)


def _bands(content: Json) -> Iterator[Part]:
    metrics = {metric["word"]: metric for metric in content["metrics"]}
    for band in content["bands"]:
        metric = metrics[band["metric"]]
        measured = [row["measured"] for row in content["measured"] if row["metric"] == band["metric"]]
        yield figures.metric_band(
            f"{band['metric']} of specimens that scatter",
            _over(content),
            _metric_heading(metric),
            band,
            limit=metric["at_least"],
            measured=measured,
            caption="Dotted: measured runs." if measured else "",
        )
    if content["bands"]:
        yield bands_grid(content)
        yield Notice("info", _scatter_sentence(content))


def _scatter_sentence(content: Json) -> str:
    told = join([_scattered(each) for each in content["scatter"]])
    return f"{content['study']['draws']} specimens at each place, which differ in {told}."


def _scattered(scatter: Json) -> str:
    names = join(_short(scatter["parameters"]))
    if scatter["deviation"] is not None:
        return f"{names} (standard deviation {number(100.0 * scatter['deviation'])} %)"
    low, high = scatter["between"]
    return f"{names} (evenly from {pretty(low, scatter['unit'])} to {pretty(high, scatter['unit'])})"


def _short(paths: Sequence[str]) -> list[str]:
    """Paths with the knots of one curve told once."""
    return list(dict.fromkeys(path.partition("[")[0] for path in paths))


def _reached_sentence(each: Json, metric: Json, over: Json) -> str:
    limit = f"{number(metric['at_least'], 2)} {metric['unit']}"
    if each["at"] is None:
        return f"{each['metric']} does not fall to {limit}."
    return f"{each['metric']} falls to {limit} at {over['name']} {number(each['at'] * _factor(over), 2)}{_unit(over)}."


def _changed(content: Json, name: str | None, value: float | None) -> str:
    if name is None or value is None:
        return PLAIN
    variation = next(each for each in content["vary"] if each["name"] == name)
    return f"{name} " + (f"x {value:g}" if variation["relative"] else pretty(value, variation["unit"]))


def _per_cent(share: float | None) -> float | None:
    return None if share is None else 100.0 * share


def _over(content: Json) -> tuple[str, list[float]]:
    over = content["over"]
    return _heading(over), [value * _factor(over) for value in over["values"]]


def _heading(over: Json) -> str:
    return f"{over['name']} ({_unit(over).strip() or 'factor'})"


def _unit(over: Json) -> str:
    unit = "" if over["relative"] else rig_unit(over["unit"], max(map(abs, over["values"])))[1]
    return f" {unit}" if unit else ""


def _factor(over: Json) -> float:
    return 1.0 if over["relative"] else rig_unit(over["unit"], max(map(abs, over["values"])))[0]


def _metric_heading(metric: Json) -> str:
    return f"{metric['word']} ({metric['unit']})"
