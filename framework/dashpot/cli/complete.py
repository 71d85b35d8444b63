"""What a shell may complete at an argument or option: names that are installed, and files.

Each function answers click's ``shell_complete``. Only names of plugged-in things load the plugins; nothing compiles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from click import Context, Parameter
from click.shell_completion import CompletionItem

if TYPE_CHECKING:
    from dashpot.contract.registry import Registry

Complete = Callable[[Context, Parameter, str], list[CompletionItem]]


def beginning(names: Iterable[str], typed: str) -> list[CompletionItem]:
    """The names that begin as it was typed."""
    return [CompletionItem(name) for name in names if name.startswith(typed)]


def files(typed: str) -> list[CompletionItem]:
    """Whatever files there are; the shell looks for them."""
    return [CompletionItem(typed, type="file")]


def datasets(_: Context, __: Parameter, typed: str) -> list[CompletionItem]:
    """Folders and files."""
    return files(typed)


def networks(_: Context, __: Parameter, typed: str) -> list[CompletionItem]:
    """Shipped networks, and files."""
    from dashpot.model.shipped import shipped_networks

    return beginning(shipped_networks(), typed) + files(typed)


def studies(_: Context, __: Parameter, typed: str) -> list[CompletionItem]:
    """Shipped studies, and files."""
    from dashpot.model.shipped import spec_folder

    return beginning(sorted(path.stem for path in (spec_folder() / "studies").glob("*.yaml")), typed) + files(typed)


def campaigns(_: Context, __: Parameter, typed: str) -> list[CompletionItem]:
    """Files."""
    return files(typed)


def rigs(_: Context, __: Parameter, typed: str) -> list[CompletionItem]:
    """Test procedures, shipped benches, and files."""
    from dashpot.contract.bench import shipped_benches

    return beginning((*_registry().rigs, *shipped_benches()), typed) + files(typed)


def installed(kind: str) -> Complete:
    """The words of all installed things of a kind; of optimizers joined by `+` the last one is completed."""

    def complete(_: Context, __: Parameter, typed: str) -> list[CompletionItem]:
        before, joint, last = typed.rpartition("+")
        return [CompletionItem(before + joint + item.value) for item in beginning(_registry().of(kind), last)]

    return complete


def settings(ctx: Context, _: Parameter, typed: str) -> list[CompletionItem]:
    """The options, `name=`, of the optimizer or the rig that was named before."""
    from dashpot.contract.options import options_of

    registry = _registry()
    words = (ctx.params.get("optimizer") or "").split("+")
    optimizers = [(word, registry.optimizers[word]) for word in words if word in registry.optimizers]
    names = [
        f"{word}.{name}=" if len(words) > 1 else f"{name}=" for word, made in optimizers for name in options_of(made)
    ]
    rig = registry.rigs.get(ctx.params.get("rig") or "")
    names += [f"{name}=" for name in options_of(rig)] if rig else []
    return beginning(names, typed)


def _registry() -> Registry:
    from dashpot.contract.registry import load_registry

    return load_registry()
