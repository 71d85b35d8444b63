"""A family of shipped networks in the place of one: its members are fitted and compared."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from dashpot.model.shipped import family_of

if TYPE_CHECKING:
    from pathlib import Path

    from dashpot.cli.session import Session
    from dashpot.data.dataset import Dataset


def with_families(models: Sequence[str], session: Session) -> list[str]:
    """The models with the members of families in their place, each once; says which ones they are."""
    found: dict[str, None] = {}
    for model in models:
        members = family_of(model)
        if members:
            session.talk.say(f"{model}: {', '.join(members)}")
        found |= dict.fromkeys(members or [model])
    return list(found)


def fit_family(word: str, measured: Dataset, output: Path, session: Session) -> None:
    """Fit all members of a family: their comparison, and each identified network in the same folder."""
    from dashpot.cli.results import COMPARISON_FILES, comparison_text, write_comparison
    from dashpot.compare.comparison import compare

    networks = [session.network(name) for name in with_families([word], session)]
    folder = session.claim(output, *COMPARISON_FILES, *(f"{network.name}.yaml" for network in networks))
    found = session.run(compare, networks, measured)
    with session.watch("writing the report"):
        report = write_comparison(found, folder, identified=True)
    session.talk.result(comparison_text(found), found.as_dict())
    session.talk.say(f"identified networks: {folder.path}")
    session.tell_report(report)


def refuse_family(word: str, option: str) -> None:
    """UsageError for a family where an option is for a single network."""
    if members := family_of(word):
        raise click.UsageError(
            f"{option} is for a single network, and '{word}' stands for {', '.join(members)}: name one"
        )
