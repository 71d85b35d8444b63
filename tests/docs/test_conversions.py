"""The errors of conversion on the page about exports are those that the export tells."""

from __future__ import annotations

import csv
import re

import pytest
from architecture.source import ROOT

import dashpot as dp

PAGE = (ROOT / "docs" / "how-to" / "use-elsewhere.md").read_text(encoding="utf-8")
HEAD, *ROWS = re.findall(r"^\| (?:error|`\w+` \| \d+ %).*$", PAGE, flags=re.MULTILINE)
SINES = [(float(frequency), 1e-3 * float(size)) for frequency, size in re.findall(r"(\d+) Hz, ([\d.]+) mm", HEAD)]


def told(name: str) -> dict[tuple[float, float], float]:
    frequencies, amplitudes = (tuple(sorted(set(column))) for column in zip(*SINES, strict=True))
    export = dp.load_registry().exports["gbs"](frequencies=frequencies, amplitudes=amplitudes)
    [text] = [text for file, text in export.files(dp.load(name)).items() if file.endswith(".csv")]
    _, _, *rows = csv.reader(text.decode().splitlines())
    return {(float(row[0]), float(row[1])): float(row[-1]) for row in rows}


@pytest.mark.parametrize("row", ROWS)
def test_a_row_is_what_the_export_tells(row):
    name, *errors = (cell.strip(" `") for cell in row.strip("|").split("|"))
    found = told(name)
    assert len(errors) == len(SINES) == 4
    for sine, shown in zip(SINES, errors, strict=True):
        # shown in whole percent
        assert 100.0 * found[sine] == pytest.approx(float(shown.removesuffix(" %")), abs=0.51)


def test_there_are_rows():
    assert len(ROWS) == 6
