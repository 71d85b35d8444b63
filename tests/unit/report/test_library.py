"""Pages have their plotting library without the package plotly, and say what is missing where there is none."""

from __future__ import annotations

import sys

import pytest

from dashpot.report import library
from dashpot.report.library import plotly_js, require_plotly
from dashpot.text.problem import InputError


def test_the_library_is_that_of_an_installed_plotly():
    from plotly.offline import get_plotlyjs

    assert plotly_js() == get_plotlyjs()


def test_the_copy_of_the_wheel_comes_first(tmp_path, monkeypatch):
    (tmp_path / library.FILE).write_text("// from the wheel", encoding="utf-8")
    monkeypatch.setattr(library, "__file__", str(tmp_path / "library.py"))
    assert plotly_js() == "// from the wheel"


def test_neither_copy_nor_package_is_an_error_that_helps(tmp_path, monkeypatch):
    monkeypatch.setattr(library, "__file__", str(tmp_path / "library.py"))
    monkeypatch.setitem(sys.modules, "plotly", None)
    with pytest.raises(InputError, match="pip install plotly"):
        plotly_js()


def test_a_figure_without_the_package_names_its_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "plotly", None)
    with pytest.raises(InputError, match=r"pip install 'dashpot\[plot\]'"):
        require_plotly()
