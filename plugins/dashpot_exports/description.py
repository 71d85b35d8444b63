"""A network described in HTML, for the documentation that an export carries."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING

from dashpot.model.network import Branch, Group, NetworkSpec

if TYPE_CHECKING:
    from dashpot.kernel.export import Exported

SIGNS = (
    "In the laws x is the deflection of a branch in m, compression positive, v its rate in m/s, a the rate of v, and F "
    "the force in N that presses apart."
)


def described(found: Exported) -> str:
    """Where the network comes from, what lies beside and behind what, and the law of every branch."""
    spec = found.spec
    lines = [f"<p>{escape(found.title)}.</p>"]
    if spec.about:
        lines.append(f"<p>{escape(spec.about)}</p>")
    lines.append(f"<p>{escape(_structure(spec))}</p>")
    lines += [f"<p>{SIGNS}</p>", "<dl>", *map(_law, spec.leaves()), "</dl>"]
    return "\n".join(lines)


def _structure(spec: NetworkSpec) -> str:
    if not spec.ends:
        return f"In {_members(spec.root)}."
    between = (
        f"{_member(member)} between {spec.ends[member.name].lower} and {spec.ends[member.name].upper}"
        for member in spec.root.members
    )
    return f"Branches: {'; '.join(between)}."


def _members(group: Group) -> str:
    return f"{group.kind}: {', '.join(map(_member, group.members))}"


def _member(member: Branch | Group) -> str:
    return f"{member.name} (in {_members(member)})" if isinstance(member, Group) else member.name


def _law(branch: Branch) -> str:
    return f"<dt>{escape(branch.name)}: {escape(branch.element.word)}</dt><dd>{escape(' '.join(_said(branch)))}</dd>"


def _said(branch: Branch) -> Iterator[str]:
    yield " ".join(inspect.cleandoc(branch.element.__doc__ or "").split("\n\n")[0].split()).replace("`", "")
    declared = branch.element.declares
    symbols = [f"{curve.symbol} = {key}" for key, curve in declared.curves.items() if curve.symbol]
    symbols += [f"{number.symbol} = {key}" for key, number in declared.parameters.items() if number.symbol]
    if symbols:
        yield f"Symbols: {', '.join(symbols)}."
    if branch.shares:
        yield f"Its parameters are those of {branch.shares}."
    if branch.scale:
        yield f"Its force is multiplied by {branch.name}.scale, over its deflection."
    if branch.element.source:
        yield f"Source: {branch.element.source}."
