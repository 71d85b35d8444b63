"""A report as PDF, printed by a browser of the Chromium family where one is installed."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from dashpot.text.problem import InputError, Place

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge", "microsoft-edge")
VARIABLE = "CHROMIUM"  # names the browser where it is not on the path
SUMMARY = "summary"  # the part of the address at which a report shows one page
PATIENCE = 120  # s
# nothing is asked of anyone, and time passes as fast as the plots are drawn
SWITCHES = (
    "--headless",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-pdf-header-footer",
    "--virtual-time-budget=30000",
)


def find_browser() -> str:
    """The browser that prints. InputError, with what to do, where there is none."""
    named = os.environ.get(VARIABLE)
    found = next(filter(None, map(shutil.which, [named] if named else NAMES)), None)
    if found is None:
        what = f"'{named}', which {VARIABLE} names, is no program" if named else "there is none of them"
        raise InputError.at(
            Place("--pdf"),
            f"expected Chromium, Chrome or Edge to print with, but {what}",
            f"install one, let {VARIABLE} name it, or print report.html in a browser",
        )
    return found


def print_report(report: Path, target: Path, part: str = "") -> Path:
    """Print a report, or with ``SUMMARY`` its one page; the path of the PDF. InputError where the browser fails."""
    address = report.resolve().as_uri() + (f"#{part}" if part else "")
    with tempfile.TemporaryDirectory() as profile:
        root = ("--no-sandbox",) if getattr(os, "geteuid", lambda: 1)() == 0 else ()
        command = [find_browser(), *SWITCHES, *root, f"--user-data-dir={profile}", f"--print-to-pdf={target.resolve()}"]
        try:
            done = subprocess.run([*command, address], capture_output=True, text=True, timeout=PATIENCE, check=False)
        except subprocess.TimeoutExpired:
            raise InputError.at(
                Place(str(target)), f"the browser did not print within {PATIENCE} s", "print report.html by hand"
            ) from None
    if done.returncode or not target.is_file():
        last = (done.stderr.strip().splitlines() or ["nothing"])[-1]
        raise InputError.at(
            Place(str(target)), f"the browser could not print; it said: {last}", "print report.html by hand"
        )
    return target
