"""The order of arguments that all verbs share: MODEL... DATASET."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from dashpot.cli import complete

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]


def model_and_dataset(optional: bool = False) -> Decorator:
    """One MODEL and a DATASET, which may be left out where it is ``optional``; ``--data`` names it, too.

    The verb gets them as ``model`` and ``dataset``.
    """
    return _arguments("model", "MODEL", complete.networks, one=True, optional=optional)


def models_and_dataset() -> Decorator:
    """MODEL... DATASET; ``--data`` names the dataset, too. The verb gets them as ``models`` and ``dataset``."""
    return _arguments("models", "MODEL...", complete.networks, one=False, optional=False)


def study_and_dataset() -> Decorator:
    """STUDY [DATASET]; ``--data`` names the dataset, too. The verb gets them as ``study`` and ``dataset``."""
    return _arguments("study", "STUDY", complete.studies, one=True, optional=True)


def _arguments(name: str, shown: str, completion: complete.Complete, one: bool, optional: bool) -> Decorator:
    def split(context: click.Context, _: click.Parameter, words: tuple[str, ...]) -> str | tuple[str, ...]:
        # --data is eager: it is known when the words are
        models = words
        if context.params.get("dataset") is None:
            models, context.params["dataset"] = _without_dataset(words, optional)
        if one and len(models) != 1:
            raise click.UsageError(f"expected one {shown} and one DATASET, got {' '.join(words)}")
        return models[0] if one else models

    words = click.argument(
        name,
        nargs=-1,
        required=True,
        metavar=f"{shown} {'[DATASET]' if optional else 'DATASET'}",
        callback=split,
        shell_complete=completion,
    )
    data = click.option(
        "--data",
        "dataset",
        metavar="DATASET",
        is_eager=True,
        shell_complete=complete.datasets,
        help="The same as DATASET at the end of the arguments.",
    )
    return lambda verb: words(data(verb))


def _without_dataset(words: tuple[str, ...], optional: bool) -> tuple[tuple[str, ...], str | None]:
    if len(words) > 1:
        return words[:-1], words[-1]
    if not optional:
        raise click.UsageError("Missing argument 'DATASET': it stands behind the models")
    return words, None
