"""The built-in causes of misfit, one per file; the name of the file is the word in a diagnosis."""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")


@hookimpl
def dashpot_causes() -> list[type]:
    """Every cause of this package."""
    from dashpot.contract.cause import Cause

    modules = [import_module(f"{__name__}.{found.name}") for found in iter_modules(__path__)]
    members = [(module, member) for module in modules for member in vars(module).values()]
    return [
        member
        for module, member in members
        if isinstance(member, type) and issubclass(member, Cause) and member.__module__ == module.__name__
    ]
