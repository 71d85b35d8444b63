"""A report is one harmless file: it runs its own scripts only, asks for nothing, and is always the same bytes."""

from __future__ import annotations

import base64
import csv
import hashlib
import io
import json
import re
import subprocess
import sys
import urllib.parse
from collections.abc import Iterator
from html.parser import HTMLParser

import pytest
from unit.report.report_samples import comparison, comparison_evidence, diagnosis, evidence, friction

from dashpot.report import comparison_page, diagnosis_page, write_page
from dashpot.report.page import render
from dashpot.report.parts import Code, Column, Figure, Grid, KeyFigures, Notice, Page, Picture, Section

HOSTILE = "</script><script>steal()</script><img src=x onerror=steal()>\"'{{ 7 * 7 }}\u2028"


class Reader(HTMLParser):
    """Elements with their attributes, scripts with their text."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.texts: dict[str, list[str]] = {}
        self._open: list[str] = []
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in ("meta", "link", "img"):
            self._open.append(tag)
            self.texts.setdefault(tag, []).append("")

    def handle_endtag(self, tag: str) -> None:
        while self._open.pop() != tag:
            pass

    def handle_data(self, data: str) -> None:
        for tag in self._open[-1:]:
            self.texts[tag][-1] += data

    def all(self, tag: str) -> Iterator[dict[str, str | None]]:
        return (attributes for name, attributes in self.elements if name == tag)


def page_of(*parts, **changes) -> Page:
    return Page(**{"title": "t", "headline": "h", "lead": "l", "sections": [Section("s", parts=parts)]} | changes)


def hostile_page() -> Page:
    columns = {HOSTILE: [HOSTILE, "=1+1"], "y (N)": [1.0, 2.0]}
    plot = {"data": [{"type": "scatter", "name": "a", "y": {"column": "y (N)", "rows": [0, 2]}}], "layout": {}}
    parts = [
        Grid(HOSTILE, [Column("a", HOSTILE, HOSTILE)], [{"a": HOSTILE}], HOSTILE, HOSTILE),
        Figure(HOSTILE, HOSTILE, plot, columns),
        Code(HOSTILE, f"+ {HOSTILE}\n- {HOSTILE}", "diff", HOSTILE),
        Picture(HOSTILE, f"<svg xmlns='http://www.w3.org/2000/svg'><script>{HOSTILE}</script></svg>", HOSTILE),
        Notice("info", HOSTILE),
        KeyFigures([(HOSTILE, HOSTILE, HOSTILE, HOSTILE)]),
    ]
    return Page(HOSTILE, HOSTILE, HOSTILE, [Section(HOSTILE, HOSTILE, parts)], [(HOSTILE, HOSTILE)])


@pytest.fixture(scope="module")
def report() -> str:
    return render(diagnosis_page(diagnosis(), evidence()))


def test_the_same_page_gives_the_same_bytes(tmp_path):
    paths = [write_page(tmp_path / f"{i}.html", diagnosis_page(diagnosis(), evidence())) for i in range(2)]
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_another_process_gives_the_same_bytes(report):
    program = (
        "import sys, hashlib; from unit.report.report_samples import diagnosis, evidence;"
        "from dashpot.report.page import render; from dashpot.report import diagnosis_page;"
        "print(hashlib.sha256(render(diagnosis_page(diagnosis(), evidence())).encode()).hexdigest())"
    )
    path = next(entry for entry in sys.path if entry.endswith("tests"))
    answer = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {path!r}); {program}"],
        capture_output=True,
        text=True,
        check=True,
        env={"PYTHONHASHSEED": "11"},
    )
    assert answer.stdout.strip() == hashlib.sha256(report.encode()).hexdigest()


def test_a_full_report_is_smaller_than_six_megabytes(report):
    assert len(report.encode()) < 6e6


def test_plotly_is_in_the_page_once(report):
    from plotly.offline import get_plotlyjs

    assert report.count(get_plotlyjs()) == 1


def test_a_page_without_a_plot_has_no_plotting_library():
    tables = Page("Title", "Headline.", "Lead.", [Section("Section", parts=[Notice("warning", "Read this.")])])
    text = render(tables)
    assert len(text.encode()) < 1e5 and "plotly.js v" not in text and "<noscript>" not in text


def test_no_element_points_outside_the_page(report):
    for _, attributes in Reader(report).elements:
        for name in ("src", "href", "srcset", "action", "data", "poster"):
            assert re.match(r"data:|#", attributes.get(name) or "#")


def test_only_the_scripts_of_the_page_may_run_and_nothing_may_be_requested(report):
    reader = Reader(report)
    policies = [each["content"] for each in reader.all("meta") if each.get("http-equiv") == "Content-Security-Policy"]
    directives = dict(part.strip().split(" ", 1) for part in policies[0].split(";"))
    scripts = zip(reader.all("script"), reader.texts["script"], strict=True)
    running = [text for attributes, text in scripts if attributes.get("type") != "application/json"]
    hashes = [f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'" for text in running]
    assert directives["default-src"] == "'none'"
    assert directives["script-src"].split() == hashes
    assert "connect-src" not in directives and "unsafe" not in directives["script-src"]


def test_hostile_texts_stay_texts():
    harmless, hostile = (Reader(render(page)) for page in (_harmless_page(), hostile_page()))
    assert [tag for tag, _ in hostile.elements] == [tag for tag, _ in harmless.elements]
    assert [sorted(attributes) for _, attributes in hostile.elements] == [sorted(a) for _, a in harmless.elements]
    assert hostile.texts["h1"] == [HOSTILE]


def _harmless_page() -> Page:
    import dataclasses

    def clean(item):
        if isinstance(item, str):
            return item.replace(HOSTILE, "x")
        if isinstance(item, dict):
            return {clean(key): clean(value) for key, value in item.items()}
        if isinstance(item, list | tuple):
            return type(item)(map(clean, item))
        if dataclasses.is_dataclass(item):
            return type(item)(**{f.name: clean(getattr(item, f.name)) for f in dataclasses.fields(item)})
        return item

    return clean(hostile_page())


def test_the_data_of_a_figure_cannot_end_its_script():
    reader = Reader(render(hostile_page()))
    (data,) = (
        text
        for attributes, text in zip(reader.all("script"), reader.texts["script"], strict=True)
        if attributes.get("type") == "application/json"
    )
    assert HOSTILE in json.loads(data)["columns"]


def test_every_table_can_be_saved_as_csv():
    grid = Grid("t", [Column("a", "a", "N", 2), Column("b", "b")], [{"a": 1.23456, "b": 'ü,"x"'}], "", "t.csv")
    (link,) = (each for each in Reader(render(page_of(grid))).all("a") if "download" in each)
    content = urllib.parse.unquote(link["href"].partition(",")[2]).removeprefix("\ufeff")
    assert link["download"] == "t.csv"
    assert list(csv.reader(io.StringIO(content, newline=""))) == [["a (N)", "b"], ["1.23456", 'ü,"x"']]


def test_added_and_removed_lines_of_a_patch_are_marked():
    html = render(page_of(Code("patch", "  same\n- old\n+ new", "diff")))
    assert re.findall(r'<span class="(\w+)">([-+ ] \w+)', html) == [
        ("same", "  same"),
        ("removed", "- old"),
        ("added", "+ new"),
    ]


def test_the_patch_shows_exactly_what_changed(report):
    added = re.findall(r'<span class="added">\+ (.*)\n', report)
    assert len(added) == 7 and "    friction:" in added and "name: kelvin_voigt+friction" in added


def sections_of(page: Page) -> list[str]:
    return [section.title for section in page.sections]


def test_missing_evidence_leaves_its_section_out():
    assert sections_of(diagnosis_page(diagnosis(), {})) == [
        "Verdict",
        "What is wrong",
        "Why",
        "Before and after",
        "What to measure next",
    ]
    bare = diagnosis(misfit=[], causes=[], rmse={"before": {"held_out": 14.0}}, verdict="nothing_missing")
    assert sections_of(diagnosis_page(bare, {})) == ["Verdict", "Measured and simulated"]


@pytest.mark.parametrize("key", sorted(evidence()))
def test_every_piece_of_evidence_can_be_missing(key, report):
    rest = {name: value for name, value in evidence().items() if name != key}
    assert len(render(diagnosis_page(diagnosis(), rest))) < len(report)


@pytest.mark.parametrize(
    "verdict", ["explained", "nothing_missing", "partly_explained", "unexplained", "ambiguous", "bad_data"]
)
def test_every_verdict_has_a_page(verdict):
    causes = [friction(indistinguishable_from=["end_stop"])]
    page = diagnosis_page(diagnosis(verdict=verdict, causes=causes), evidence())
    assert page.headline in render(page).replace("&#34;", '"')


def test_remarks_stand_right_behind_the_verdict_and_once():
    remark = "The held-out run 'b' has a fault."
    page = diagnosis_page(diagnosis(remarks=[remark]), {"warnings": ["Run 'a' is clipped.", remark]})
    told = [part.text for part in page.sections[0].parts if isinstance(part, Notice)]
    assert told == [
        "Every significant misfit of the training runs has an accepted cause.",
        remark,
        "Run 'a' is clipped.",
    ]


@pytest.mark.parametrize(
    ("explainable", "source", "note"),
    [
        (None, "repeats", "no model gets below"),
        (15.0, "repeats", "no model gets below"),
        (3.0, "repeats", "repeats differ by more than a general model leaves, so repeats hold more than noise"),
        (3.0, "residual", "more than a general model leaves, so it holds more than noise"),
    ],
)
def test_a_noise_floor_above_what_a_general_model_leaves_is_no_bound(explainable, source, note):
    told = diagnosis(explainable={"held_out": explainable}, noise_floor={"value": 14.5, "from": source})
    (shown,) = (part for part in diagnosis_page(told, {}).sections[0].parts if isinstance(part, KeyFigures))
    assert [text for label, _, _, text in shown.figures if label == "noise floor"] == [note]


def test_where_the_report_comes_from_stands_at_its_end():
    page = diagnosis_page(diagnosis(), evidence())
    assert ("seed", "7") in page.colophon
    assert ("dataset digest", "a3e94d" * 10) in page.colophon


def test_a_comparison_shows_every_model_next_to_the_floor():
    page = comparison_page(comparison(), comparison_evidence())
    (models,) = (p for s in page.sections for p in s.parts if isinstance(p, Grid) and p.csv_name == "models.csv")
    assert [row["name"] for row in models.rows][-2:] == ["tire_model_5", "noise floor"]
    assert models.rows[1]["ratio"] == pytest.approx(61.0 / 14.5)


def test_the_shape_of_the_force_comes_right_after_the_result():
    x = [0.0, 1.0]
    shapes = {"residual_maps": [], "conditions": [], "cycles": [], "shaded_by": "amplitude"}
    shapes |= dict.fromkeys(("low_speed", "less_spring", "after_reversals"), [])
    shapes |= {"mid_stroke": [{"run": "a", "label": "measured", "x": x, "y": x}], "runs": [{"run": "a", "shade": 1.0}]}
    page = comparison_page(comparison(), {**comparison_evidence(), "shapes": shapes})
    assert sections_of(page)[:3] == ["Result", "The shape of the force", "Over frequency and amplitude"]


def test_a_failed_model_keeps_its_row_and_says_why():
    failed = {"name": "axle", "parameters": {}, "rmse": None, "nrmse": None, "per_run": {}}
    result = comparison() | {"models": [*comparison()["models"], failed | {"status": "did not converge"}]}
    html = render(comparison_page(result, {}))
    assert "did not converge" in html


def test_of_many_models_only_the_best_is_drawn_at_first():
    page = comparison_page(comparison(), comparison_evidence())
    shown = [
        {
            choice["value"]
            for group in groups
            for choice in group["choices"]
            if group["key"] == "series" and choice["shown"]
        }
        for section in page.sections
        for part in section.parts
        if isinstance(part, Figure) and (groups := part.plot["layout"].get("meta", {}).get("toggles"))
    ]
    assert shown and all(values - {"measured"} == {"tire_model_5"} for values in shown)


def test_importing_the_report_loads_no_heavy_library():
    program = (
        "import sys, dashpot.report; print(sorted({'plotly', 'jinja2', 'rich', 'pint', 'scipy'} & set(sys.modules)))"
    )
    answer = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == "[]"


def test_a_rival_cause_is_not_called_unsupported():
    from dashpot.report.grids import cause_grid

    rivals = {"accepted": False, "indistinguishable_from": ["end_stop"]}
    causes = [friction(**rivals, standing="probable"), friction(accepted=False)]
    grid = cause_grid(diagnosis(verdict="ambiguous", causes=causes))
    assert [row["found"] for row in grid.rows] == ["probable (it or a rival)", "resembles it, less likely than not"]
    assert [row["confused"] for row in grid.rows] == ["end stop", None]
