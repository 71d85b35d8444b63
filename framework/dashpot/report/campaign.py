"""The report of a campaign: who does not belong to the others, what the population is, what it depends on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from dashpot.report import figures
from dashpot.report.parts import Column, Figure, Grid, KeyFigures, Notice, Page, Part, Section
from dashpot.report.readable import counted_words, percent
from dashpot.text.digits import number, quantity, with_interval

Json = Mapping[str, Any]

MOST_NUMBERS = 8  # that are drawn; the tables have all
CHANCE = 0.01
LINK = "address"


def campaign_page(content: Json) -> Page:
    """The report of a `dashpot-campaign-result/1`."""
    told = content["campaign"]
    sections = [
        Section("Result", parts=list(_result(content))),
        Section("Specimens", parts=[shown_grid(content)]),
        *(section for population in content["populations"] for section in _population(content, population)),
        Section("Causes", "What diagnoses found, specimen by specimen.", list(_causes(content))),
    ]
    known = [(f"data of {one['specimen']}", one["digest"]) for one in content["specimens"] if one["digest"]]
    made = [("result format", content["format"]), ("dashpot", content["version"]), ("seed", str(told["seed"]))]
    return Page(
        f"Campaign {told['name']}",
        campaign_headline(content),
        told["about"],
        [section for section in sections if section.parts],
        (*made, *known),
    )


def campaign_headline(content: Json) -> str:
    """The answer in a sentence."""
    names = list(dict.fromkeys(one["specimen"] for one in content["named"]))
    count = len(content["specimens"])
    tested = [population["tested"] for population in content["populations"]]
    if not names and tested and all(tested):
        told = f"No outlier among {count} specimens"
    elif not names:
        told = f"{counted_words(count, 'specimen')}: too few were fitted to compare each with the others"
    else:
        words = "is an outlier" if len(names) == 1 else "are outliers"
        told = f"{len(names)} of {count} specimens {words}: {', '.join(names)}"
    failed = len(content["failures"])
    return told + (f"; {failed} job{'s' * (failed > 1)} failed." if failed else ".")


def specimens_grid(content: Json) -> Grid:
    """Every specimen with all its numbers and their intervals in SI, for other programs."""
    columns = {key: Column(key, key) for key in ("specimen", "data", "digest")}
    rows = []
    for one in content["specimens"]:
        row = {key: one[key] for key in columns if key in one}
        _add(columns, row, {key: (value, "") for key, value in one["properties"].items()})
        for model, fit in one["models"].items():
            for path, entry in fit["numbers"].items():
                ends = (entry["value"], *entry["interval"])
                _add(
                    columns,
                    row,
                    {
                        f"{model}: {path}{end}": (value, entry["unit"])
                        for end, value in zip(("", " from", " to"), ends, strict=True)
                    },
                )
            _add(columns, row, {f"{model}: RMSE {part}": (value, "N") for part, value in fit["rmse"].items()})
            _add(columns, row, {f"{model}: {key}": (fit[key], "") for key in ("unlike", "group")})
        rows.append(row)
    return Grid("Specimens", list(columns.values()), rows, csv_name="specimens.csv")


def _add(columns: dict[str, Column], row: dict[str, Any], cells: Mapping[str, tuple[Any, str]]) -> None:
    for heading, (value, unit) in cells.items():
        columns.setdefault(heading, Column(heading, heading, unit if unit != "1" else ""))
        row[heading] = value


def shown_grid(content: Json) -> Grid:
    """Every specimen as a reader wants it: rig units, intervals, a link to its own report."""
    named = {one["specimen"]: one["kind"] for one in content["named"]}
    failed = {failure["specimen"]: failure["reason"] for failure in content["failures"]}
    grouped = {each["model"] for each in content["populations"] if max(each["groups"]) > 1}
    columns = {"specimen": Column("specimen", "specimen", link=LINK), "remark": Column("remark", "remark")}
    rows = []
    for one in content["specimens"]:
        address = f"jobs/{one['reports'][0]}/report.html" if one["reports"] else None
        remark = named.get(one["specimen"]) or failed.get(one["specimen"])
        row = {"specimen": one["specimen"], LINK: address, "remark": remark}
        for name, value in one["properties"].items():
            columns.setdefault(name, Column(name, name))
            row[name] = number(value, 4) if isinstance(value, float) else value
        for model, fit in one["models"].items():
            _show(columns, row, model, fit, model in grouped)
        for model, verdict in one["verdicts"].items():
            columns.setdefault(f"{model}: verdict", Column(f"{model}: verdict", f"{model}: verdict"))
            row[f"{model}: verdict"] = verdict.replace("_", " ")
        rows.append(row)
    caption = "Values with 95 % intervals. A specimen opens its own report."
    used = [column for column in columns.values() if any(row.get(column.key) is not None for row in rows)]
    return Grid("Specimens", used, rows, caption, "specimens.csv")


def _show(columns: dict[str, Column], row: dict[str, Any], model: str, fit: Json, grouped: bool) -> None:
    for path, entry in fit["numbers"].items():
        heading = f"{model}: {path}"
        columns.setdefault(heading, Column(heading, heading))
        row[heading] = with_interval(entry["value"], entry["interval"], entry["unit"])
    columns.setdefault(f"{model}: RMSE", Column(f"{model}: RMSE", f"{model}: RMSE", "N", 3))
    row[f"{model}: RMSE"] = fit["rmse"]["train"]
    if grouped:
        columns.setdefault(f"{model}: group", Column(f"{model}: group", f"{model}: group"))
        row[f"{model}: group"] = fit["group"]


def population_grid(content: Json) -> Grid:
    """The mean of every number, how specimens scatter beyond what each is known to, and what one is known to."""
    columns = [
        Column("model", "model"),
        Column("parameter", "parameter"),
        Column("mean", "mean [95 % interval]"),
        Column("scatter", "scatter between specimens"),
        Column("interval", "95 % interval of it"),
        Column("error", "standard error of one"),
    ]
    rows = [
        {
            "model": population["model"],
            "parameter": each["parameter"],
            "mean": with_interval(each["mean"], each["interval"], each["unit"]),
            "scatter": _size(each["scatter"], each),
            "error": _size(each["error"], each),
            "interval": " to ".join(_size(end, each) for end in each["scatter_interval"]),
        }
        for population in content["populations"]
        for each in population["numbers"]
    ]
    return Grid("The population", columns, rows, csv_name="population.csv")


def named_grid(content: Json) -> Grid:
    """The outliers, with their evidence."""
    columns = [
        Column("specimen", "specimen"),
        Column("kind", "likely"),
        Column("probability", "probability", "", 3),
        Column("model", "model"),
        Column("evidence", "evidence"),
    ]
    rows = [{**one, "model": one["model"] or None, "evidence": "; ".join(one["evidence"])} for one in content["named"]]
    return Grid("Outliers", columns, rows, csv_name="named.csv")


def dependence_grid(population: Json) -> Grid:
    """What a unit more of a property does to each number."""
    columns = [
        Column("property", "property"),
        Column("parameter", "parameter"),
        Column("effect", "effect of one more"),
        Column("interval", "95 % interval"),
        Column("certain", "apart from 0"),
    ]
    rows = [
        {
            "property": each["property"],
            "parameter": each["parameter"],
            "effect": _size(each["effect"], each),
            "interval": " to ".join(_size(end, each) for end in each["interval"]),
            "certain": "yes" if each["certain"] else "no",
        }
        for each in population["dependence"]
    ]
    return Grid("Dependence on properties", columns, rows, csv_name=f"{population['model']}-dependence.csv")


def _size(value: float, entry: Json) -> str:
    """A deviation: a share where numbers are compared as ratios."""
    return percent(value, 3) if entry["relative"] else quantity(value, entry["unit"])


def _result(content: Json) -> Iterator[Part]:
    named = {one["specimen"] for one in content["named"]}
    yield KeyFigures(
        [
            ("specimens", str(len(content["specimens"])), "", ""),
            ("outliers", str(len(named)), "", ""),
            ("failed jobs", str(len(content["failures"])), "", ""),
        ]
    )
    for grid in (named_grid(content), population_grid(content)):
        if grid.rows:
            yield grid
    yield from (Notice("warning", f"{failure['job']}: {failure['reason']}") for failure in content["failures"])


def _population(content: Json, population: Json) -> Iterator[Section]:
    parts: list[Part] = [Notice("info", f"{remark}.") for remark in population["remarks"]]
    parts += _numbers(content, population)
    yield Section(f"Parameters of {population['model']}", _groups(population), parts)
    if population["dependence"]:
        told = "Effects are those of all properties together, each with the others held."
        found: list[Part] = [dependence_grid(population), *_over(content, population)]
        yield Section(f"Parameters of {population['model']} over properties", told, found)
    charts = [figures.control_chart(chart) for chart in population["charts"][:MOST_NUMBERS]]
    yield Section(f"Batches, by {population['model']}", parts=charts)
    if population["shared"]:
        yield Section(f"Common parameters of {population['model']}", parts=list(_shared(population)))


def _groups(population: Json) -> str:
    count = max(population["groups"])
    if count < 2:
        return "The specimens that belong to the population are one group."
    members = [
        [name for name, group in zip(population["specimens"], population["groups"], strict=True) if group == k]
        for k in range(1, count + 1)
    ]
    return f"There are {count} groups of specimens alike: " + "; ".join(", ".join(each) for each in members) + "."


def _numbers(content: Json, population: Json) -> Iterator[Figure]:
    for each in population["numbers"][:MOST_NUMBERS]:
        yield number_figure(content, population["model"], each["parameter"])


def _over(content: Json, population: Json) -> Iterator[Figure]:
    """The dependences that are certain, over properties that are numbers."""
    numeric = [each for each in population["dependence"] if each["certain"] and ": " not in each["property"]]
    for each in numeric[:MOST_NUMBERS]:
        yield number_figure(content, population["model"], each["parameter"], each["property"])


def number_figure(content: Json, model: str, path: str, over: str = "") -> Figure:
    """A number of a model over the specimens, or over one of their properties. ValueError for what none of them has."""
    told = [
        each
        for population in content["populations"]
        if population["model"] == model
        for each in population["numbers"]
        if each["parameter"] == path
    ]
    points = _points(content, model, path, over)
    if not (told and points):
        known = [each["parameter"] for population in content["populations"] for each in population["numbers"]]
        raise ValueError(
            f"expected a parameter of {model}{f' and a property {over}' if over else ''}, got '{path}'; "
            f"parameters are: {', '.join(known)}"
        )
    return figures.number_over(told[0], points, over)


def _points(content: Json, model: str, path: str, over: str = "") -> list[dict[str, Any]]:
    found, named = [], {one["specimen"] for one in content["named"]}
    for one in content["specimens"]:
        fit = one["models"].get(model)
        if fit and path in fit["numbers"] and (not over or over in one["properties"]):
            at = one["properties"][over] if over else one["specimen"]
            marks = {"specimen": one["specimen"], "named": one["specimen"] in named, "at": at}
            found.append({**fit["numbers"][path], **marks})
    return found


def _shared(population: Json) -> Iterator[Part]:
    shared = population["shared"]
    units = {each["parameter"]: each["unit"] for each in population["numbers"]}
    columns = [Column("parameter", "parameter"), Column("value", "value [95 % interval]")]
    rows = [
        {"parameter": path, "value": with_interval(each["value"], each["interval"], units[path])}
        for path, each in shared["numbers"].items()
    ]
    yield Grid("Common parameters", columns, rows, csv_name="shared.csv")
    ratio = shared["error_ratio"]
    told = "" if ratio is None else f" With them the RMSE of the fits is {number(ratio, 4)} times as large."
    if shared["probability"] < CHANCE:
        yield Notice(
            "warning",
            f"The specimens contradict common parameters: by chance they would differ as much with "
            f"probability {number(shared['probability'], 2)}.{told}",
        )
    else:
        yield Notice("good", f"The specimens agree with common parameters.{told}")


def _causes(content: Json) -> Iterator[Part]:
    for model in dict.fromkeys(cause["model"] for cause in content["causes"]):
        yield figures.cause_map(model, [cause for cause in content["causes"] if cause["model"] == model])
