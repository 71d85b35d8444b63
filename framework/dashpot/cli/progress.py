"""How a long computation shows that it goes on."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from rich.progress import Progress

PATIENCE = 2.0


class ProgressBar:
    """A callable for the layers below: ``progress(stage, done, value, floor)``.

    ``done`` is the share of the stage in [0, 1], ``value`` the best misfit so far, ``floor`` the noise floor; each may
    be None. On a terminal a bar appears after two seconds; elsewhere each stage is one line. Standard error only.
    """

    def __init__(self, quiet: bool) -> None:
        self._quiet = quiet
        self._terminal = sys.stderr.isatty()
        self._began = time.monotonic()
        self._stage = ""
        self._bar: Progress | None = None

    def __call__(
        self, stage: str, done: float | None = None, value: float | None = None, floor: float | None = None
    ) -> None:
        if self._quiet:
            return
        if self._terminal:
            self._draw(stage, done, describe(stage, value, floor))
        elif stage != self._stage:
            click.echo(f"{stage} ...", err=True)
        self._stage = stage

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        if self._bar is not None:
            self._bar.stop()

    def _draw(self, stage: str, done: float | None, text: str) -> None:
        if time.monotonic() - self._began < PATIENCE:
            return
        if self._bar is None:
            self._bar = new_bar()
        if stage != self._stage or not self._bar.tasks:
            for task in self._bar.task_ids:
                self._bar.remove_task(task)
            self._bar.update(self._bar.add_task(text, start=False), completed=done or 0.0)
            self._bar.start_task(self._bar.task_ids[0])
        task = self._bar.task_ids[0]
        self._bar.update(task, description=text, completed=done or 0.0, total=None if done is None else 1.0)


def describe(stage: str, value: float | None, floor: float | None) -> str:
    """One line: what is going on, how good it is, how good it can get."""
    parts = [stage]
    if value is not None:
        parts.append(f"best {value:.4g}")
    if floor is not None:
        parts.append(f"noise floor {floor:.4g}")
    return ", ".join(parts)


def new_bar() -> Progress:
    """A bar on standard error that vanishes when done; rich itself honours NO_COLOR."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    times = (TimeElapsedColumn(), TextColumn("left"), TimeRemainingColumn())
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), *times)
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    bar.start()
    return bar
