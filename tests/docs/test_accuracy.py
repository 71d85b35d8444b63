"""The page on the accuracy of simulations: what it shows runs, and the table has all of its cases."""

from __future__ import annotations

import re

from architecture.source import ROOT

PAGE = (ROOT / "docs" / "explanation" / "accuracy.md").read_text(encoding="utf-8")


def test_the_bounds_of_a_simulation_are_shown_as_they_come():
    [block] = re.findall(r"^```python\n(.*?)^```$", PAGE, flags=re.MULTILINE | re.DOTALL)
    known: dict[str, object] = {}
    exec(compile(block, "accuracy.md", "exec"), known)
    found, [node] = known["found"], known["found"].force
    assert 0.0 < found.error[node] < found.peak[node]
    assert found.error[node] <= 1e-3 * (found.force[node] ** 2).mean() ** 0.5


def test_the_table_has_hundreds_of_cases_and_says_how_many_were_set_aside():
    written = PAGE.split("<!-- written: conformance -->")[1].split("<!-- end: conformance -->")[0]
    count, aside = map(int, re.findall(r"(\d+) cases; (\d+) draws were set aside", written)[0])
    assert count >= 300 and aside > 0
    assert len(re.findall(r"^\| with `\w+` ", written, flags=re.MULTILINE)) >= 12
