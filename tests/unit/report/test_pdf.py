"""Reports are printed by a browser, or it is told what is missing."""

from __future__ import annotations

import os
import stat

import pytest

from dashpot.report.pdf import find_browser, print_report
from dashpot.text.problem import InputError


def browser(folder, script):
    """A program that stands for a browser."""
    path = folder / "browser"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return str(path)


def test_without_a_browser_the_way_out_is_told(monkeypatch):
    monkeypatch.delenv("CHROMIUM", raising=False)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(InputError, match="expected Chromium, Chrome or Edge .* install one, let CHROMIUM name it"):
        find_browser()
    monkeypatch.setenv("CHROMIUM", "/nowhere/chromium")
    with pytest.raises(InputError, match="'/nowhere/chromium', which CHROMIUM names, is no program"):
        find_browser()


@pytest.mark.skipif(os.name == "nt", reason="the stand-in is a shell script")
def test_a_browser_gets_the_page_and_its_part(monkeypatch, tmp_path):
    script = 'for word; do case "$word" in --print-to-pdf=*) out="${word#*=}";; file:*) page="$word";; esac; done\n'
    monkeypatch.setenv("CHROMIUM", browser(tmp_path, script + 'echo "$page" > "$out"'))
    report = tmp_path / "report.html"
    assert print_report(report, tmp_path / "whole.pdf").read_text().strip() == report.as_uri()
    assert print_report(report, tmp_path / "one.pdf", "summary").read_text().strip() == report.as_uri() + "#summary"


@pytest.mark.skipif(os.name == "nt", reason="the stand-in is a shell script")
def test_a_browser_that_fails_is_quoted(monkeypatch, tmp_path):
    monkeypatch.setenv("CHROMIUM", browser(tmp_path, "echo no display >&2; exit 3"))
    with pytest.raises(InputError, match="the browser could not print; it said: no display"):
        print_report(tmp_path / "report.html", tmp_path / "report.pdf")
