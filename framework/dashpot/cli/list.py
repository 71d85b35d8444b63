"""``dashpot list``: what is there, and where each thing comes from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from dashpot import __version__
from dashpot.cli.columns import in_columns
from dashpot.cli.complete import beginning
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, switches
from dashpot.contract.origin import Origin
from dashpot.model.shipped import family_of
from dashpot.text.problem import InputError, nearest

if TYPE_CHECKING:
    from dashpot.contract.registry import Registry

KINDS = (
    "elements",
    "networks",
    "optimizers",
    "causes",
    "formats",
    "specimens",
    "rigs",
    "studies",
    "exports",
    "metrics",
    "plugins",
)


ALSO = {"models": "networks"}


@dataclass(frozen=True)
class Entry:
    """A line of a list."""

    word: str
    origin: Origin
    about: str

    def cells(self) -> tuple[str, ...]:
        """The line in columns."""
        return self.word, f"{self.origin.distribution} {self.origin.version}, {self.origin.plugin}", self.about


@dataclass(frozen=True)
class NetworkEntry(Entry):
    """A network, with the family that it belongs to."""

    family: str

    def cells(self) -> tuple[str, ...]:
        """The line in columns."""
        word, *rest = super().cells()
        return word, self.family, *rest


@click.command("list")
@click.argument(
    "kind", required=False, metavar="[KIND]", shell_complete=lambda _, __, typed: beginning((*KINDS, *ALSO), typed)
)
@switches("json")
def verb(kind: str | None, switches: Switches) -> None:
    """List what is installed.

    Each thing stands with the distribution and the plugin that brought it. KIND is elements, networks (or models),
    optimizers, causes, formats, specimens, rigs, studies, exports, metrics or plugins, or a family of networks, such as
    mounts or bushing; without it, everything is listed. `dashpot show MODEL` tells more of a network.

    \b
    Example:
      dashpot list models
      dashpot list elements
      dashpot list bushing
    """
    kind = ALSO.get(kind, kind) if kind else None
    members = family_of(kind) if kind and kind not in KINDS else ()
    if kind is not None and kind not in KINDS and not members:
        hint = nearest(kind, (*KINDS, *ALSO)) or f"there are: {', '.join(KINDS)}"
        raise click.UsageError(f"No list of '{kind}', {hint}")
    session = Session(switches)
    shown = {name: entries_of(name, session) for name in (["networks"] if members else [kind] if kind else KINDS)}
    if members:
        shown["networks"] = [entry for entry in shown["networks"] if entry.word in members]
    session.talk.result(as_text(shown), {"format": "dashpot-list/1", **shown})


def entries_of(kind: str, session: Session) -> list[Entry]:
    """The list of one kind."""
    if kind == "networks":
        return networks(session)
    if kind == "rigs":
        return things(kind, session.registry) + benches(session.registry)
    if kind == "studies":
        return studies(session.registry)
    return plugins(session.registry) if kind == "plugins" else things(kind, session.registry)


def things(kind: str, registry: Registry) -> list[Entry]:
    """Things from plugins, each with what it says about itself."""
    return [Entry(word, registry.origin(kind, word), about_thing(made)) for word, made in registry.of(kind).items()]


def networks(session: Session) -> list[Entry]:
    """The shipped networks, family by family."""
    from dashpot.model.shipped import shipped_networks

    origin = Origin("specs", "dashpot", __version__)
    return [
        NetworkEntry(name, origin, about_network(name, session), path.parent.name)
        for name, path in shipped_networks().items()
    ]


def benches(registry: Registry) -> list[Entry]:
    """The shipped benches: procedures with options, and how they measure."""
    from dashpot.contract.bench import find_bench, shipped_benches

    origin = Origin("specs", "dashpot", __version__)
    return [
        Entry(name, origin, about_or_why(partial(about_file, find_bench, name, registry.rigs)))
        for name in shipped_benches()
    ]


def about_file(read: Callable[..., Any], *where: Any) -> str:
    """What a bench or a study says about itself. InputError when it needs what is not installed."""
    return read(*where).about


def studies(registry: Registry) -> list[Entry]:
    """The shipped studies."""
    from dashpot.fit.study.reading import shipped_studies
    from dashpot.study.sensitivity.reading import read_either

    origin = Origin("specs", "dashpot", __version__)
    return [
        Entry(name, origin, about_or_why(partial(about_file, read_either, path, registry)))
        for name, path in shipped_studies().items()
    ]


def about_network(name: str, session: Session) -> str:
    """What a network says about itself, or why it cannot be used with the plugins at hand."""
    return about_or_why(lambda: session.network(name).about)


def about_or_why(read: Callable[[], str]) -> str:
    """What a file says about itself, or why it cannot be used."""
    try:
        return read()
    except InputError as error:
        return f"cannot be used: {error.problems[0]}"


def plugins(registry: Registry) -> list[Entry]:
    """The installed plugins, each with what is wrong with it and what it brings."""
    entries = []
    for origin in registry.plugins:
        words = ", ".join(word for (_, word), holder in registry.origins.items() if holder == origin)
        faults = [f"set aside: {fault.message}" for fault in registry.faults if fault.origin == origin]
        entries.append(Entry(origin.plugin, origin, "; ".join([*faults, *filter(None, [words])]) or "brings nothing"))
    return entries


def about_thing(made: type[Any]) -> str:
    """What a class says about itself: its ``about``, or the first line of its docstring."""
    return getattr(made, "about", "") or (made.__doc__ or "").strip().partition("\n")[0]


def as_text(shown: dict[str, list[Entry]]) -> str:
    """A block of lines for each kind, with headings when there are several."""
    blocks = {
        kind: in_columns([entry.cells() for entry in entries]) or none_of(kind) for kind, entries in shown.items()
    }
    if len(blocks) == 1:
        return "".join(blocks.values())
    return "\n\n".join(f"{kind}\n{block}" for kind, block in blocks.items())


def none_of(kind: str) -> str:
    """Why a list is empty."""
    return f"There are no {kind}: no plugin gives any."
