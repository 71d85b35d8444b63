"""The code of the page on inspection tests runs, and its bands fall with the damping."""

from __future__ import annotations

import re
from typing import Any

import pytest
from architecture.source import ROOT

PAGE = ROOT / "docs" / "how-to" / "inspection-tests.md"


def test_the_bands_of_worn_cars_lie_below_those_of_new_ones():
    [code] = [block for block in re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL) if "DRAWS" in block]
    names: dict[str, Any] = {}
    exec(code.replace("DRAWS = 60", "DRAWS = 2"), names)
    for word in names["TESTS"]:
        middle = [band[word][1] for band in names["bands"].values()]
        assert middle == sorted(middle, reverse=True)
    # the table of the page: medians of sixty cars; two cars of 5 % scatter lie within its bands, widened by a third
    assert names["bands"][1474]["phase_shift"][1] == pytest.approx(85.0, abs=10.0)
    assert names["bands"][600]["eusama"][1] == pytest.approx(43.0, abs=11.0)
