"""What the tests of this folder measured is stated at the end of the session."""

from __future__ import annotations

from collections.abc import Callable

import pytest

STATED = pytest.StashKey[list[str]]()


@pytest.fixture(scope="session")
def state(request: pytest.FixtureRequest) -> Callable[[str], None]:
    """``state(line)`` writes a line under the results of the session."""
    return request.config.stash.setdefault(STATED, []).append


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    lines = config.stash.get(STATED, [])
    if lines:
        terminalreporter.section("accuracy")
        for line in lines:
            terminalreporter.write_line(line)
