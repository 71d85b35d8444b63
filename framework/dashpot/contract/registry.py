"""All things that plugins provide, by kind and word."""

from __future__ import annotations

import gc
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import TYPE_CHECKING, Any

from dashpot.contract.hooks import PROJECT
from dashpot.contract.loading import KINDS, load_plugins
from dashpot.contract.origin import Origin, PluginFault
from dashpot.text.problem import InputError, Place, nearest

if TYPE_CHECKING:
    from dashpot.contract.cause import Cause
    from dashpot.contract.export import Export
    from dashpot.contract.metric import Metric
    from dashpot.contract.optimizer import Optimizer
    from dashpot.contract.reader import Reader
    from dashpot.contract.rig import Rig
    from dashpot.contract.specimen import Specimen
    from dashpot.model.element import Element

ALLOW_LIST = "DASHPOT_PLUGINS"


@dataclass(frozen=True)
class Registry:
    """What is installed: classes by word for each kind, where each comes from, and the faults that were found."""

    elements: Mapping[str, type[Element]]
    optimizers: Mapping[str, type[Optimizer]]
    formats: Mapping[str, type[Reader]]
    causes: Mapping[str, type[Cause]]
    specimens: Mapping[str, type[Specimen]]
    rigs: Mapping[str, type[Rig]]
    exports: Mapping[str, type[Export]]
    metrics: Mapping[str, type[Metric]]
    origins: Mapping[tuple[str, str], Origin]
    plugins: tuple[Origin, ...]
    faults: tuple[PluginFault, ...]

    def of(self, kind: str) -> Mapping[str, type[Any]]:
        """The things of one kind, e.g. ``elements``."""
        return getattr(self, kind)

    def origin(self, kind: str, word: str) -> Origin:
        """Which plugin brought the thing ``word`` of ``kind``; KeyError if none did."""
        return self.origins[kind, word]


@cache
def load_registry() -> Registry:
    """The registry of the installed plugins, loaded once per process.

    The environment variable ``DASHPOT_PLUGINS`` may hold a comma list of the only plugins to load; InputError if it
    names one that is not installed.

    Examples:
        >>> registry = dp.load_registry()
        >>> "maxwell" in registry.elements
        True
        >>> registry.origin("elements", "maxwell").distribution
        'dashpot'
    """
    entries = entry_points(group=PROJECT)
    allowed = os.environ.get(ALLOW_LIST)
    with _no_collection():
        return build_registry(entries if allowed is None else allow_only(allowed, entries))


@contextmanager
def _no_collection() -> Iterator[None]:
    """Importing hundreds of modules leaves nothing to collect, and looking for it takes a tenth of the time."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


def build_registry(entries: Iterable[EntryPoint]) -> Registry:
    """The registry of the given plugins. Broken ones are among its ``faults``, the rest works."""
    loader = load_plugins(entries)
    things = sorted(loader.things.values(), key=lambda thing: (thing.kind, thing.word))
    return Registry(
        **{kind.name: {thing.word: thing.made for thing in things if thing.kind == kind.name} for kind in KINDS},
        origins={(thing.kind, thing.word): thing.origin for thing in things},
        plugins=tuple(loader.origins),
        faults=tuple(loader.faults),
    )


def allow_only(names: str, entries: Iterable[EntryPoint]) -> list[EntryPoint]:
    """Those entry points that the comma list ``names`` mentions."""
    wanted = [name.strip() for name in names.split(",") if name.strip()]
    installed = {entry.name for entry in entries}
    for name in wanted:
        if name not in installed:
            raise InputError.at(
                Place(ALLOW_LIST),
                f"expected names of installed plugins, got '{name}'",
                nearest(name, installed) or f"installed are: {', '.join(sorted(installed)) or 'none'}",
            )
    return [entry for entry in entries if entry.name in wanted]
