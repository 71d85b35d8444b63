"""Repeats: which runs are the same measurement made again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from dashpot.data.declaration import RunDeclaration
from dashpot.data.run import Run
from dashpot.data.trouble import Trouble
from dashpot.text.problem import nearest


def resolve_repeats(
    declarations: Sequence[RunDeclaration], names: Sequence[str]
) -> tuple[list[RunDeclaration], dict[str, Trouble]]:
    """The declarations with every repeat pointing at the very first of its kind, and what is wrong with the others.

    `names` are all runs named in the dataset, also those whose declaration is wrong. A repeat takes over the settings
    and the hold-out of its original where it says nothing itself.
    """
    by_name = {declaration.name: declaration for declaration in declarations}
    resolved: list[RunDeclaration] = []
    troubles: dict[str, Trouble] = {}
    for declaration in declarations:
        root = _root(declaration, by_name)
        if root is None or root not in names:
            troubles[declaration.name] = _tell(declaration, names)
        else:
            resolved.append(_like_original(declaration, by_name.get(root)))
    return resolved, troubles


def _root(declaration: RunDeclaration, by_name: Mapping[str, RunDeclaration]) -> str | None:
    """The name of the first run that a chain of repeats leads to, None when the chain runs in a circle."""
    name = declaration.name
    seen: set[str] = set()
    while name in by_name and (original := by_name[name].repeats):
        if name in seen:
            return None
        seen.add(name)
        name = original
    return name


def _tell(declaration: RunDeclaration, names: Sequence[str]) -> Trouble:
    others = [name for name in names if name != declaration.name]
    if declaration.repeats in names:
        message, hint = f"it repeats '{declaration.repeats}', which repeats it again", "name the first of them"
    else:
        message = f"it repeats '{declaration.repeats}', which is no run here"
        hint = nearest(declaration.repeats or "", others) or f"runs are: {', '.join(others[:12])}"
    return Trouble(message, hint, declaration.place("repeats"))


def _like_original(declaration: RunDeclaration, original: RunDeclaration | None) -> RunDeclaration:
    if original is None or original is declaration:
        return declaration
    return replace(
        declaration,
        repeats=original.name,
        settings={**original.settings, **declaration.settings},
        notes={**original.notes, **declaration.notes},
        units={**original.units, **declaration.units},
        held_out=original.held_out if declaration.held_out is None else declaration.held_out,
    )


def group_repeats(runs: Sequence[Run]) -> list[Run]:
    """Runs with their groups. Where the original was set aside its first repeat takes its place."""
    present = {run.name for run in runs}
    stand_ins: dict[str, str] = {}
    for run in runs:
        if run.repeats and run.repeats not in present:
            stand_ins.setdefault(run.repeats, run.name)
    return [_grouped(run, stand_ins) for run in runs]


def _grouped(run: Run, stand_ins: Mapping[str, str]) -> Run:
    group = stand_ins.get(run.repeats, run.repeats) if run.repeats else run.name
    return replace(run, group=group, repeats=None if group == run.name else group)
