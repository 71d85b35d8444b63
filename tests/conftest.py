"""What all tests share: seeds, and examples of hypothesis, are the same in every run but in ``pytest -m random``."""

from __future__ import annotations

import os
import secrets
import signal
from collections.abc import Iterator

import pytest
import seeds
from hypothesis import settings

settings.register_profile("fixed", derandomize=True)
settings.register_profile("drawn", derandomize=False, print_blob=True)


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("markexpr") == "random":
        os.environ.setdefault("DRAW_SEEDS", str(secrets.randbits(32)))
    settings.load_profile("drawn" if os.environ.get("DRAW_SEEDS") else "fixed")
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        # started in the background of a shell: the commands that tests interrupt would ignore it, too
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_report_header() -> list[str]:
    drawn = os.environ.get("DRAW_SEEDS")
    return [f"seeds drawn anew: DRAW_SEEDS={drawn} repeats them"] if drawn else []


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        module = getattr(item, "module", None)
        if not item.get_closest_marker("slow") and (hasattr(module, "seed_of") or hasattr(module, "given")):
            item.add_marker(pytest.mark.random)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Iterator[None]:
    report = yield
    if report.failed:
        # also what was drawn when the module was imported
        module = getattr(item, "module", None)
        drawn = [*pytest_report_header(), *seeds.DRAWN[getattr(module, "__name__", "")]]
        report.sections.append(("seeds", "\n".join(dict.fromkeys(drawn))))
    return report
