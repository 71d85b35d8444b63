"""Where an element could be added to a network with nodes, and adding one there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from dashpot.model.network import Branch, Ends, Group, NetworkSpec
from dashpot.model.patch import add_branch, add_to_branch, branch_names
from dashpot.text.problem import InputError, Place
from dashpot.text.quantity import pretty

Pair = tuple[str, str]


@dataclass(frozen=True)
class Site:
    """A pair of nodes, the lower one first, and the pairs of its twins, where the same is added with the same numbers.

    ``endings`` are those of the names of what is added at the twins. ``members`` lie there already, ``offset`` is
    their deflection in m where both nodes stand at zero.
    """

    pairs: tuple[Pair, ...]
    endings: tuple[str, ...] = ()
    members: tuple[Branch | Group, ...] = field(default=(), compare=False)
    offset: float = 0.0

    @property
    def words(self) -> str:
        """The site as it is told."""
        first, *twins = (f"{lower} and {upper}" for lower, upper in self.pairs)
        return f"between {first}" + "".join(f", likewise {twin}" for twin in twins)


def sites_of(spec: NetworkSpec) -> tuple[Site, ...]:
    """Every pair of nodes that a branch of the file connects; none in a network that has only two ends."""
    found: dict[Pair, _Gathered] = {}
    home: dict[str, Pair] = {}
    for member in spec.root.members if spec.joints else ():
        ends = spec.ends[member.name]
        model = _model_of(member)
        if model in home:
            site = found[home[model]]
            site.add_twin(_along((ends.lower, ends.upper), spec.ends[model], home[model]), _ending(member.name, model))
            continue
        pair = (ends.lower, ends.upper)
        home[member.name] = pair[::-1] if pair[::-1] in found else pair
        found.setdefault(home[member.name], _Gathered(ends)).members.append(member)
    twins = {pair for site in found.values() for pair in site.twins}
    return tuple(site.at(pair) for pair, site in found.items() if pair not in twins and pair[::-1] not in twins)


def rig_site(spec: NetworkSpec) -> Site | None:
    """From every driven node to a node that is held; None where nothing is held."""
    held = next((joint.name for joint in spec.joints.values() if joint.hold == "ground"), None)
    driven = [joint.name for joint in spec.joints.values() if joint.hold == "driven"]
    if held is None or not driven:
        return None
    return Site(tuple((name, held) for name in driven), tuple(f"_{name}" for name in driven[1:]))


@dataclass(frozen=True)
class At:
    """Writes into the text of a network what ``extend`` adds, connected to the nodes of a site."""

    site: Site | None
    extend: Callable[[str, Sequence[Any]], str]

    def __call__(self, text: str, atoms: Sequence[Any]) -> str:
        """The extended text. Raises InputError for a branch where there is no site."""
        known = set(branch_names(text))
        text = self.extend(text, atoms)
        for name in [name for name in branch_names(text) if name not in known]:
            if self.site is None:
                raise InputError.at(
                    Place(),
                    f"the branch '{name}' would lie between a driven node and ground, and no "
                    "node of the network is held",
                    "name one under 'nodes:'",
                )
            text = _connect(text, name, self.site)
        return text


def _connect(text: str, name: str, site: Site) -> str:
    (lower, upper), *twins = site.pairs
    offset = f"\noffset: {pretty(site.offset, 'm', 8)}" if site.offset else ""
    text = add_to_branch(text, name, f"between: [{lower}, {upper}]{offset}")
    for (below, above), ending in zip(twins, site.endings, strict=True):
        taken = branch_names(text)
        wanted = f"{name}{ending}"
        free = next(
            word
            for number in range(1, len(taken) + 2)
            if (word := wanted if number == 1 else f"{wanted}_{number}") not in taken
        )
        text = add_branch(text, f"{free}: {{same_as: {name}, between: [{below}, {above}]}}")
    return text


class _Gathered:
    """What is known of a site while the branches are read."""

    def __init__(self, ends: Ends) -> None:
        self.offset = ends.offset.number if ends.offset else 0.0
        self.members: list[Branch | Group] = []
        self.twins: dict[Pair, str] = {}

    def add_twin(self, pair: Pair, ending: str) -> None:
        self.twins.setdefault(pair, ending or f"_{len(self.twins) + 2}")

    def at(self, pair: Pair) -> Site:
        return Site((pair, *self.twins), tuple(self.twins.values()), tuple(self.members), self.offset)


def _along(pair: Pair, model: Ends, site: Pair) -> Pair:
    # a twin is turned as its model is
    return pair if (model.lower, model.upper) == site else pair[::-1]


def _ending(name: str, model: str) -> str:
    return name.removeprefix(model) if name.startswith(model) else ""


def _model_of(member: Branch | Group) -> str:
    """The outermost branch whose numbers a member has; empty for one with numbers of its own."""
    leaf = member if isinstance(member, Branch) else next(member.leaves())
    rest = leaf.name.removeprefix(member.name)
    return leaf.shares.removesuffix(rest) if leaf.shares.endswith(rest) else ""
