"""Options that several verbs share."""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from dashpot.cli import complete


@dataclass(frozen=True)
class Switches:
    """The common switches as given, or their defaults where a verb does not have them."""

    seed: int = 0
    jobs: int = 1
    scheduler: str | None = None
    json: bool = False
    quiet: bool = False
    force: bool = False
    backend: str | None = None
    allow_outside: bool = False
    pdf: bool = False


BACKEND = "DASHPOT_BACKEND"


def use_backend(context: click.Context, _: click.Parameter, word: str | None) -> str | None:
    """Let this call, and the workers that it starts, run compiled networks on a backend."""
    if word is not None:
        context.with_resource(environment(BACKEND, word))
    return word


@contextmanager
def environment(name: str, value: str) -> Iterator[None]:
    """An environment variable that is as it was afterwards."""
    before = os.environ.get(name)
    os.environ[name] = value
    try:
        yield
    finally:
        del os.environ[name]
        if before is not None:
            os.environ[name] = before


def available_cores() -> int:
    """How many cores there are."""
    return os.cpu_count() or 1


SWITCHES = {
    "seed": click.option(
        "--seed",
        metavar="N",
        type=click.IntRange(min=0),
        default=0,
        show_default=True,
        help="Same seed, same result files.",
    ),
    "jobs": click.option(
        "--jobs",
        metavar="N",
        type=click.IntRange(min=1),
        default=available_cores,
        help="Workers; all cores by default.",
    ),
    "scheduler": click.option(
        "--scheduler", metavar="WHERE", help="local:N for N processes here, or the address of a Dask scheduler."
    ),
    "json": click.option("--json", is_flag=True, help="Result as JSON on standard output, messages on standard error."),
    "quiet": click.option("--quiet", is_flag=True, help="Only warnings and errors."),
    "backend": click.option(
        "--backend",
        type=click.Choice(["llvm", "numba"]),
        callback=use_backend,
        help="What compiles networks; by default llvm, the faster one.",
    ),
    "allow_outside": click.option(
        "--allow-outside",
        is_flag=True,
        help="Also read measured files outside of the folder of their dataset; for datasets that you trust.",
    ),
    "pdf": click.option("--pdf", is_flag=True, help="Also report.pdf and summary.pdf, of one page, by a browser."),
    "force": click.option("--force", is_flag=True, help="Overwrite existing result files."),
}


def switches(*names: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Give a verb the named switches; it receives them as one argument ``switches``."""

    def decorate(verb: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(verb)
        def gathered(**given: Any) -> Any:
            return verb(switches=Switches(**{name: given.pop(name) for name in names}), **given)

        return functools.reduce(lambda inner, name: SWITCHES[name](inner), reversed(names), gathered)

    return decorate


def optimizer_options(verb: Callable[..., Any]) -> Callable[..., Any]:
    """``--optimizer NAME`` and ``--set KEY=VALUE`` (any number of times)."""
    settings = click.option(
        "--set",
        "settings",
        metavar="KEY=VALUE",
        multiple=True,
        help="An option of the optimizer, e.g. iterations=50.",
        shell_complete=complete.settings,
    )
    optimizer = click.option(
        "--optimizer",
        metavar="NAME",
        help="See `dashpot list optimizers`.",
        shell_complete=complete.installed("optimizers"),
    )
    return optimizer(settings(verb))


# endings that a folder hardly has
ENDINGS = (".csv", ".fmu", ".html", ".json", ".npz", ".pdf", ".svg", ".txt", ".xlsx", ".yaml", ".yml", ".zip")


def output_option(
    about: str, files: tuple[str, ...] = (), **more: Any
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """``-o OUT``, required unless there is a default: a folder, or a file with one of the endings ``files``."""
    more.setdefault("required", "default" not in more)

    def checked(_: click.Context, __: click.Parameter, path: Path | None) -> Path | None:
        if path is not None and path.suffix in set(ENDINGS) - set(files) and not path.is_dir():
            other = f", or a file ending in {' or '.join(files)}" if files else ""
            raise click.UsageError(
                f"-o expected a folder{other}, got '{path}', which looks like a file: say -o {path.with_suffix('')}"
            )
        return path

    return click.option(
        "-o", "--output", metavar="OUT", type=click.Path(path_type=Path), help=about, callback=checked, **more
    )
