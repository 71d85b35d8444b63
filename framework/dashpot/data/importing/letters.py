"""Columns called by a single letter: a symbol, as `x` and `F`, or no more than a place, as `a, b, c, d`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from string import ascii_lowercase

import numpy as np

from dashpot.data.importing.pairs import MOSTLY, explained, is_clearly_better, loses_work
from dashpot.data.importing.roles import GUESSED, LIKELY, Role, motion_roles

Roles = Mapping[str, Role]

_PAIR = ("displacement", "force")


def symbols(roles: Roles, columns: Sequence[str]) -> dict[str, Role]:
    """The roles without those that letters tell where these, but for the time, are a, b, c ... in order."""
    time = roles["time"].column if "time" in roles else None
    lettered = [column for column in columns if len(column) == 1 and column.isalpha() and column != time]
    if len(lettered) > 1 and "".join(lettered).lower() == ascii_lowercase[: len(lettered)]:
        return {channel: role for channel, role in roles.items() if channel == "time" or not is_letter(role)}
    return dict(roles)


def weighed_roles(columns: Mapping[str, np.ndarray], taken: Roles, step: float | None = None) -> dict[str, Role]:
    """Displacement and force as `motion_roles` finds them, with a letter as the name of one only if the numbers agree.

    It names none where without it there is a pair that loses work, and the motion that it names explains less than half
    of the force, or a nameless force clearly worse than the other motion does. The pair is then a guess, with the
    lettered column as a namesake. Letters for both displacement and force confirm each other.
    """
    named = motion_roles(columns, taken, step)
    doubted = [channel for channel in _PAIR if channel in taken and is_letter(taken[channel])]
    if len(doubted) != 1:
        return named
    free = motion_roles(columns, {channel: role for channel, role in taken.items() if channel not in doubted}, step)
    (lossy, share), (_, by_name) = _score(columns, free), _score(columns, named)
    other = "force" not in taken and free["displacement"].column != named["displacement"].column
    if lossy and (by_name < MOSTLY or (other and is_clearly_better(share, by_name))):
        return _asked(free, taken[doubted[0]])
    return named


def beside(roles: Roles, known: Roles) -> dict[str, Role]:
    """Known displacement and force, and the other channels that names tell of other columns."""
    used = {role.column for role in known.values()}
    free = {channel: role for channel, role in roles.items() if channel in known or role.column not in used}
    return {**free, **known}


def is_letter(role: Role) -> bool:
    """Whether a single letter is all that tells a channel."""
    return role.by == LIKELY and len(role.column) == 1


def _score(columns: Mapping[str, np.ndarray], roles: Roles) -> tuple[bool, float]:
    """Whether a force loses work over a motion that explains most of it, and the share that it explains."""
    if not all(channel in roles and roles[channel].column in columns for channel in _PAIR):
        return False, 0.0
    motion, force = (columns[roles[channel].column] for channel in _PAIR)
    share = explained(motion, force)
    return share > MOSTLY and loses_work(motion, force), share


def _asked(roles: Roles, lettered: Role) -> dict[str, Role]:
    found = roles[lettered.channel]
    namesakes = () if found.column == lettered.column else (lettered.column,)
    return {**roles, lettered.channel: replace(found, by=GUESSED, namesakes=(*found.namesakes, *namesakes))}
