"""From installed entry points to things: each plugin is loaded on its own; what is faulty is named and set aside."""

from __future__ import annotations

import inspect
import re
import traceback
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import EntryPoint

import pluggy

from dashpot.contract import hooks
from dashpot.contract.origin import Origin, PluginFault

# A thing's word is written in YAML files and on the command line.
WORD = re.compile(r"[a-z][a-z0-9_]*")


@dataclass(frozen=True)
class Kind:
    """A kind of thing that plugins provide: its name, and where its base class lives."""

    name: str
    home: str
    base_name: str

    @property
    def hook(self) -> str:
        """Name of the hook that gives things of this kind."""
        return f"dashpot_{self.name}"

    @property
    def base(self) -> type:
        """The class from which every thing of this kind derives."""
        return getattr(import_module(self.home), self.base_name)


KINDS = (
    Kind("elements", "dashpot.model.element", "Element"),
    Kind("optimizers", "dashpot.contract.optimizer", "Optimizer"),
    Kind("formats", "dashpot.contract.reader", "Reader"),
    Kind("causes", "dashpot.contract.cause", "Cause"),
    Kind("specimens", "dashpot.contract.specimen", "Specimen"),
    Kind("rigs", "dashpot.contract.rig", "Rig"),
    Kind("exports", "dashpot.contract.export", "Export"),
    Kind("metrics", "dashpot.contract.metric", "Metric"),
)


@dataclass(frozen=True)
class Thing:
    """A class brought by a plugin, under its word."""

    kind: str
    word: str
    made: type
    origin: Origin


class PluginLoader:
    """Collects things and faults, one plugin at a time."""

    def __init__(self) -> None:
        self.things: dict[tuple[str, str], Thing] = {}
        self.faults: list[PluginFault] = []
        self.origins: list[Origin] = []
        self._manager = pluggy.PluginManager(hooks.PROJECT)
        self._manager.add_hookspecs(hooks)

    def load(self, entry: EntryPoint) -> None:
        """Import one plugin and take in what it gives."""
        origin = origin_of(entry)
        self.origins.append(origin)
        # A plugin is foreign code: whatever it raises is recorded as its fault.
        try:
            plugin = entry.load()
            self._register(plugin, origin)
        except (Exception, SystemExit) as error:
            self._blame(origin, f"cannot be loaded: {describe(error)}", error)
            return
        for kind in KINDS:
            for made in self._call(plugin, kind, origin):
                self._take(made, kind, origin)

    def _register(self, plugin: object, origin: Origin) -> None:
        name = f"{origin.distribution}:{origin.plugin}"
        self._manager.register(plugin, name)
        try:
            self._manager.check_pending()
        except pluggy.PluginValidationError:
            self._manager.unregister(name=name)
            raise

    def _call(self, plugin: object, kind: Kind, origin: Origin) -> Iterator[object]:
        for hook in getattr(self._manager.hook, kind.hook).get_hookimpls():
            if hook.plugin is not plugin:
                continue
            try:
                made = hook.function()
            except (Exception, SystemExit) as error:
                self._blame(origin, f"failed in {kind.hook}(): {describe(error)}", error)
                continue
            if isinstance(made, list | tuple):
                yield from made
            else:
                self._blame(origin, f"gave {made!r} in {kind.hook}(), expected a list of classes")

    def _take(self, made: object, kind: Kind, origin: Origin) -> None:
        objection = objection_to(made, kind)
        if objection:
            return self._blame(origin, f"gave {objection}")
        assert isinstance(made, type)
        word = made.word  # type: ignore[attr-defined]
        holder = self.things.setdefault((kind.name, word), Thing(kind.name, word, made, origin))
        if holder.made is not made:
            self._blame(origin, f"gave '{word}' in {kind.hook}(), a word already taken by plugin {holder.origin}")

    def _blame(self, origin: Origin, message: str, error: BaseException | None = None) -> None:
        self.faults.append(PluginFault(origin, message, error))


def load_plugins(entries: Iterable[EntryPoint]) -> PluginLoader:
    """Load every plugin of ``entries``: those of dashpot's own distribution first, the others by name.

    The order decides who keeps a word that two plugins give, so it does not depend on how files lie on a disk.
    """
    loader = PluginLoader()
    for entry in sorted(entries, key=_rank):
        loader.load(entry)
    return loader


def _rank(entry: EntryPoint) -> tuple[bool, str, str]:
    origin = origin_of(entry)
    return origin.distribution != hooks.PROJECT, origin.distribution, origin.plugin


def origin_of(entry: EntryPoint) -> Origin:
    """The origin named by an installed entry point."""
    if entry.dist is None:
        return Origin(entry.name, "unknown distribution", "?")
    return Origin(entry.name, entry.dist.name, entry.dist.version)


def objection_to(made: object, kind: Kind) -> str:
    """What is wrong with a thing given for ``kind``, or nothing."""
    base = kind.base
    if not (isinstance(made, type) and issubclass(made, base)):
        return f"{made!r} in {kind.hook}(), expected a class derived from {base.__module__}.{base.__qualname__}"
    if inspect.isabstract(made):
        missing = ", ".join(sorted(getattr(made, "__abstractmethods__", ())))
        return f"{made.__qualname__}, which leaves {missing}() unwritten"
    word = getattr(made, "word", None)
    if not (isinstance(word, str) and WORD.fullmatch(word)):
        return f"{made.__qualname__} with the word {word!r}, expected small letters, digits and '_', such as 'bouc_wen'"
    options = made.options if kind.name == "formats" else {}  # type: ignore[attr-defined]
    if not _are_meanings(options):
        return f"{made.__qualname__} with the options {options!r}, expected the meaning of each key as a text"
    return ""


def _are_meanings(options: object) -> bool:
    texts = [*options, *options.values()] if isinstance(options, Mapping) else [None]
    return all(isinstance(text, str) for text in texts)


def describe(error: BaseException) -> str:
    """An exception in one line, with the place in the plugin where it was raised."""
    text = " ".join(f"{type(error).__name__}: {error}".split())
    frames = [frame for frame in traceback.extract_tb(error.__traceback__)[1:] if "importlib" not in frame.filename]
    return f"{text} ({frames[-1].filename}:{frames[-1].lineno})" if frames else text
