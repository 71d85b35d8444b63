"""How a long computation shows that it goes on."""

from __future__ import annotations

import sys
import time
from threading import RLock, Timer
from types import TracebackType
from typing import TYPE_CHECKING

import click

from dashpot.cli.pace import Pace, shown_left

if TYPE_CHECKING:
    from rich.progress import Progress

PATIENCE = 2.0
PAUSE = 10.0


class ProgressBar:
    """A callable for the layers below: ``progress(stage, done, value, floor)``.

    ``done`` is the share of the work in [0, 1], ``value`` the best misfit so far, ``floor`` the noise floor; each may
    be None. Work in several ``parts`` names each in its stages, `part: stage`, and tells the share of the part.
    ``at_first`` is what goes on before anything was told.

    On a terminal a bar with the time left appears after two seconds, whether there is anything to tell or not.
    Elsewhere each stage is one line, and every ten seconds there is another one. Standard error only.
    """

    def __init__(self, quiet: bool, parts: int = 1, at_first: str = "working") -> None:
        self._quiet = quiet
        self._parts = parts
        self._terminal = sys.stderr.isatty()
        self._began = self._told = time.monotonic()
        self._pace = Pace(time.monotonic)
        self._seen: list[str] = []
        self._stage, self._text = "", at_first
        self._bar: Progress | None = None
        self._closed = False
        self._lock = RLock()
        self._timer: Timer | None = None

    def __call__(
        self, stage: str, done: float | None = None, value: float | None = None, floor: float | None = None
    ) -> None:
        if self._quiet:
            return
        part = self._part(stage)
        self._pace.note(self._overall(part, done))
        self._text = self._numbered(part) + describe(stage, value, floor)
        if self._terminal:
            self._draw()
        else:
            self._write(stage)
        self._stage = stage

    def __enter__(self) -> ProgressBar:
        if self._terminal and not self._quiet:
            self._timer = Timer(PATIENCE, self._draw)
            self._timer.daemon = True
            self._timer.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        if self._timer is not None:
            self._timer.cancel()
        with self._lock:
            self._closed = True
            if self._bar is not None:
                self._bar.stop()

    def _part(self, stage: str) -> int:
        name = stage.partition(":")[0]
        if name not in self._seen:
            self._seen.append(name)
        return min(self._seen.index(name) + 1, self._parts)

    def _overall(self, part: int, done: float | None) -> float | None:
        if self._parts == 1:
            return done
        return max(self._pace.share, (part - 1 + (done or 0.0)) / self._parts)

    def _numbered(self, part: int) -> str:
        return f"{part} of {self._parts}, " if self._parts > 1 else ""

    def _write(self, stage: str) -> None:
        now = time.monotonic()
        if stage != self._stage:
            click.echo(f"{self._numbered(self._part(stage))}{stage} ...", err=True)
        elif now - self._told >= PAUSE:
            click.echo(f"{self._text}: {100.0 * self._pace.share:.0f} %, {shown_left(self._pace.left())}", err=True)
        else:
            return
        self._told = now

    def _draw(self) -> None:
        with self._lock:
            if self._closed or time.monotonic() - self._began < PATIENCE:
                return
            if self._bar is None:
                self._bar = new_bar(self._pace)
                self._bar.add_task(self._text, total=None)
                self._bar.start()
            share = self._pace.share
            self._bar.update(self._bar.task_ids[0], description=self._text, completed=share, total=share and 1.0)


def describe(stage: str, value: float | None, floor: float | None) -> str:
    """One line: what is going on, how good it is, how good it can get."""
    parts = [stage]
    if value is not None:
        parts.append(f"best {value:.4g}")
    if floor is not None:
        parts.append(f"noise floor {floor:.4g}")
    return ", ".join(parts)


def new_bar(pace: Pace) -> Progress:
    """A bar on standard error that vanishes when done; rich itself honours NO_COLOR."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, ProgressColumn, Task, TextColumn, TimeElapsedColumn
    from rich.table import Column
    from rich.text import Text

    class LeftColumn(ProgressColumn):
        """The time left at the pace so far."""

        def render(self, task: Task) -> Text:
            """The text of the column."""
            return Text(shown_left(pace.left()))

    one_line = Column(no_wrap=True, overflow="ellipsis")
    what = TextColumn("{task.description}", markup=False, table_column=one_line)
    columns = (what, BarColumn(20), TimeElapsedColumn(), LeftColumn(table_column=Column(no_wrap=True, min_width=9)))
    return Progress(*columns, console=Console(stderr=True), transient=True)
