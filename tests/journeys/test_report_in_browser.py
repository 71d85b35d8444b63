"""The report as its reader meets it: opened from the disk in Chromium, looked at, pressed, saved, printed.

Needs Chromium and `pip install playwright`; the environment variable CHROMIUM may name the browser.
"""

from __future__ import annotations

import csv
import io
import os
import re
import shutil
from collections.abc import Iterator

import numpy as np
import pytest
from unit.compare.specimens import sweeps
from unit.report.fit_samples import fit, page_of
from unit.report.report_samples import comparison, comparison_evidence, diagnosis, evidence

from dashpot.compare.look import look
from dashpot.report import comparison_page, diagnosis_page, figures, write_page
from dashpot.report.look import look_page
from dashpot.report.parts import Column, Grid, Page, Section

sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed (pip install playwright)")

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
CHROMIUM = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason=f"no Chromium found (looked for {', '.join(NAMES)})")

SWITCHES = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"]
HOSTILE = "</script><img src=x onerror='window.stolen=1'><b>bold</b>{{ 7 * 7 }}"


@pytest.fixture(scope="module")
def browser() -> Iterator:
    with sync_api.sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=CHROMIUM, args=SWITCHES)
        yield running
        running.close()


@pytest.fixture(scope="module")
def reports(tmp_path_factory) -> dict[str, str]:
    folder = tmp_path_factory.mktemp("reports")
    pages = {
        "diagnosis": diagnosis_page(diagnosis(), evidence()),
        "comparison": comparison_page(comparison(), comparison_evidence()),
        "fit": page_of(fit()),
        "look": seen_page(),
        "hostile": hostile_page(),
    }
    return {name: write_page(folder / f"{name}.html", page).as_uri() for name, page in pages.items()}


def seen_page() -> Page:
    seen = look(sweeps())
    return look_page(seen.as_dict(), seen.evidence())


def hostile_page() -> Page:
    time = np.linspace(0.0, 1.0, 30)
    measured = {HOSTILE: {"time": time, "displacement": time, "force": time}}
    parts = [
        figures.loops(measured, {HOSTILE: {HOSTILE: 2.0 * time}}),
        figures.harmonic_bars({HOSTILE: {HOSTILE: [3.0, 1.0]}}),
        figures.rmse_bars([{"name": HOSTILE, "train": 1.0}]),
        Grid(HOSTILE, [Column("a", HOSTILE)], [{"a": HOSTILE}]),
    ]
    return Page(HOSTILE, HOSTILE, HOSTILE, [Section(HOSTILE, HOSTILE, parts)], [(HOSTILE, HOSTILE)])


class Visit:
    """An open report, and everything it said or asked for."""

    def __init__(self, browser, address: str, **options) -> None:
        options = {"viewport": {"width": 1280, "height": 800}, **options}
        self.page = browser.new_page(accept_downloads=True, **options)
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(f"{message.type}: {message.text}"))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(address)
        self.page.wait_for_function("document.querySelectorAll('.plot .main-svg').length > 0")

    def figure(self, title: str):
        return self.page.locator("figure[data-plot]").filter(
            has=self.page.get_by_role("heading", name=title, exact=True)
        )

    def button(self, title: str, label: str):
        return self.figure(title).get_by_role("button", name=label, exact=True)

    def lines(self, title: str) -> int:
        return self.figure(title).locator(".scatterlayer .trace").count()


@pytest.fixture
def visit(browser, reports) -> Iterator:
    opened = []

    def enter(name: str, **options) -> Visit:
        opened.append(Visit(browser, reports[name], **options))
        return opened[-1]

    yield enter
    for each in opened:
        each.page.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("name", ["diagnosis", "comparison", "fit", "look", "hostile"])
def test_a_report_opens_silently_and_asks_for_nothing(visit, reports, name, theme):
    opened = visit(name, color_scheme=theme)
    assert opened.complaints == []
    assert opened.requests == [reports[name]]


@pytest.mark.parametrize("width", [2560, 1366, 800, 390])
@pytest.mark.parametrize("name", ["diagnosis", "comparison", "fit", "look"])
def test_every_figure_is_drawn_and_nothing_is_wider_than_the_screen(visit, name, width):
    opened = visit(name, viewport={"width": width, "height": 768})
    drawn = opened.page.eval_on_selector_all(
        "figure .plot", "plots => plots.map(p => p.querySelectorAll('.main-svg').length)"
    )
    assert drawn and all(drawn)
    assert opened.page.evaluate("document.documentElement.scrollWidth") <= width


def test_the_one_page_shows_the_answer_and_its_figures_alone(reports, browser):
    page = browser.new_page(viewport={"width": 1280, "height": 800})
    page.goto(reports["diagnosis"] + "#summary")
    shown = page.eval_on_selector_all("h3", "all => all.filter((e) => e.offsetParent).map((e) => e.textContent)")
    assert shown == ["Causes", "Dynamic stiffness and loss angle"]
    assert page.locator(".key-figures > div").count() == 3 and page.locator("h1").is_visible()
    assert not page.locator("td[data-column=evidence]").first.is_visible()
    assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(prefer_css_page_size=True))) == 1
    page.get_by_role("link", name="Whole report").click()
    assert page.locator("td[data-column=evidence]").first.is_visible()
    page.locator("h3", has_text="Residual over time").wait_for()
    page.close()


def test_what_is_folded_is_drawn_in_full_width_when_it_is_opened(visit):
    page = visit("diagnosis").page
    folded = page.locator("details.folded", has_text="Convergence of the fits")
    assert not folded.locator(".main-svg").first.is_visible()
    folded.locator("summary").first.click()
    page.wait_for_timeout(300)
    assert folded.locator(".main-svg").first.bounding_box()["width"] > 900


def test_pressing_a_run_adds_it_and_pressing_twice_shows_it_alone(visit):
    opened = visit("diagnosis")
    title = "Force over displacement and velocity"
    assert opened.lines(title) == 2 * 3  # over displacement and over velocity
    opened.button(title, "a1_p20").click()
    assert opened.lines(title) == 2 * 6
    opened.button(title, "a2_p30").dblclick()
    assert opened.lines(title) == 2 * 3  # over displacement and over velocity
    assert opened.button(title, "a2_p30").get_attribute("aria-pressed") == "true"
    assert opened.button(title, "a1_p20").get_attribute("aria-pressed") == "false"
    opened.button(title, "all").click()
    assert opened.lines(title) == 2 * 36
    assert opened.complaints == []


def test_a_simulation_can_be_taken_out_of_all_runs(visit):
    opened = visit("diagnosis")
    opened.button("Force over displacement and velocity", "simulated before").click()
    assert opened.lines("Force over displacement and velocity") == 2 * 2


def test_the_pointer_shows_values_with_units(visit):
    opened = visit("diagnosis")
    bar = opened.figure("Error of the models").locator(".bars .point").first
    bar.scroll_into_view_if_needed()
    box = bar.bounding_box()
    opened.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    label = opened.figure("Error of the models").locator(".hovertext")
    label.first.wait_for()
    assert "60.1 N on training runs" in label.first.text_content()


def test_a_dragged_box_zooms_and_a_double_click_returns(visit):
    opened = visit("diagnosis")
    plot = opened.figure("Residual over time").locator(".plot")
    plot.scroll_into_view_if_needed()
    ranges = "plot => plot._fullLayout.xaxis.range.slice()"
    whole = plot.evaluate(ranges)
    box = opened.figure("Residual over time").locator(".nsewdrag").bounding_box()
    middle = box["y"] + box["height"] / 2
    opened.page.mouse.move(box["x"] + box["width"] * 0.4, middle)
    opened.page.mouse.down()
    opened.page.mouse.move(box["x"] + box["width"] * 0.6, middle, steps=5)
    opened.page.mouse.up()
    opened.page.wait_for_timeout(500)
    zoomed = plot.evaluate(ranges)
    assert zoomed[1] - zoomed[0] == pytest.approx(0.2 * (whole[1] - whole[0]), rel=0.1)
    opened.button("Residual over time", "simulated after").click()
    assert plot.evaluate(ranges) == zoomed
    opened.page.mouse.dblclick(box["x"] + box["width"] / 2, middle)
    opened.page.wait_for_timeout(500)
    assert plot.evaluate(ranges) == pytest.approx(whole, abs=0.02 * (whole[1] - whole[0]))


def colors_of(opened: Visit) -> tuple[str, str]:
    page = opened.page.evaluate("getComputedStyle(document.body).backgroundColor")
    plot = opened.page.evaluate("document.querySelector('.plot .main-svg').style.background")
    return page, plot


def test_the_button_switches_page_and_plots_between_light_and_dark(visit):
    opened = visit("diagnosis", color_scheme="light")
    light = colors_of(opened)
    opened.page.click("#theme")
    dark = colors_of(opened)
    opened.page.click("#theme")
    assert light == ("rgb(255, 255, 255)", "rgb(255, 255, 255)")
    assert dark == ("rgb(20, 24, 29)", "rgb(20, 24, 29)")
    assert colors_of(opened) == light


def test_page_and_plots_follow_the_system(visit):
    opened = visit("diagnosis", color_scheme="dark")
    assert colors_of(opened) == ("rgb(20, 24, 29)", "rgb(20, 24, 29)")
    opened.page.emulate_media(color_scheme="light")
    opened.page.wait_for_timeout(200)
    assert colors_of(opened) == ("rgb(255, 255, 255)", "rgb(255, 255, 255)")


def saved(opened: Visit, press) -> tuple[str, str]:
    with opened.page.expect_download() as download:
        press()
    with open(download.value.path(), encoding="utf-8-sig", newline="") as file:
        return download.value.suggested_filename, file.read()


def test_the_data_of_a_figure_are_beside_it_and_can_be_saved(visit):
    opened = visit("diagnosis")
    figure = opened.figure("Force over displacement and velocity")
    figure.locator("summary").click()
    figure.locator("details tr").first.wait_for()
    assert figure.locator("details tr").count() == 201
    name, text = saved(opened, figure.get_by_role("button", name="CSV").click)
    header, *rows = csv.reader(io.StringIO(text, newline=""))
    assert name == "force_over_displacement_and_velocity.csv"
    assert header[:5] == ["run", "time (s)", "displacement (mm)", "velocity (m/s)", "measured (N)"]
    measured = {run: dict(zip(*(signals[k] for k in ("time", "force")), strict=True)) for run, signals in forces()}
    assert len(rows) > 5000 and {row[0] for row in rows} == measured.keys()
    for run, time, _, _, force, *_ in rows[::500]:
        assert float(force) == pytest.approx(measured[run][float(time)], rel=1e-5)
    assert opened.complaints == []


def forces() -> list:
    return list(evidence()["loops"]["measured"].items())


def test_a_table_and_the_extended_model_can_be_saved(visit):
    opened = visit("diagnosis")
    name, text = saved(opened, opened.page.locator("a[download='causes.csv']").click)
    assert name == "causes.csv" and "dry friction" in text
    name, text = saved(opened, opened.page.locator(".code a[download]").click)
    assert name == "kelvin_voigt+friction.yaml" and text == evidence()["patch"]["after"]
    assert opened.complaints == []


@pytest.mark.parametrize("name", ["diagnosis", "comparison", "fit"])
def test_every_table_can_be_saved(visit, name):
    opened = unfolded(visit(name))
    for link in opened.page.locator("a.save").all():
        file, text = saved(opened, link.click)
        assert file and len(text.splitlines()) > 1
    assert opened.complaints == []


# apart from the tables, since Chromium holds back the eleventh download of a page
@pytest.mark.parametrize("name", ["diagnosis", "comparison", "fit"])
def test_the_data_of_every_figure_can_be_saved(visit, name):
    opened = unfolded(visit(name))
    for figure in opened.page.locator("figure[data-plot]").all():
        figure.locator("summary").click()
        figure.locator("details tr").first.wait_for()
        file, text = saved(opened, figure.get_by_role("button", name="CSV").click)
        assert file.endswith(".csv") and len(text.splitlines()) > 1
    assert opened.complaints == []


def unfolded(opened: Visit) -> Visit:
    for folded in opened.page.locator("details.folded > summary").all():
        folded.click()
    opened.page.wait_for_timeout(500)  # the plots in it are drawn anew
    return opened


def test_names_from_outside_are_shown_and_never_run(visit):
    opened = visit("hostile")
    assert opened.page.inner_text("h1") == HOSTILE
    assert HOSTILE in opened.page.locator(".toggles button").all_inner_texts()
    assert opened.page.locator("svg text").filter(has_text=HOSTILE).count() > 0
    assert opened.page.evaluate("window.stolen") is None
    assert opened.page.locator("img, svg image, svg a, svg b").count() == 0


def test_it_prints_in_light_colours_with_every_figure_on_the_paper(visit, tmp_path):
    opened = visit("diagnosis", color_scheme="dark")
    opened.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert colors_of(opened) == ("rgb(255, 255, 255)", "rgb(255, 255, 255)")
    widths = opened.page.eval_on_selector_all(".plot .main-svg", "plots => plots.map(p => p.clientWidth)")
    assert max(widths) == 688
    opened.page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert colors_of(opened) == ("rgb(20, 24, 29)", "rgb(20, 24, 29)")
    assert len(opened.page.pdf(prefer_css_page_size=True)) > 20000
    assert opened.complaints == []
