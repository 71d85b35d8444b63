"""From branches and groups to blocks."""

from __future__ import annotations

from dataclasses import dataclass

from dashpot.model.network import Branch, Group
from dashpot.model.picture import Picture, Series, Symbol
from dashpot.report.schematic.blocks import Block, Chain, Fan, Labelled, Lead, Piece, Row, Scaled
from dashpot.report.schematic.sizes import Sizes
from dashpot.report.schematic.wording import branch_lines, is_curved


@dataclass(frozen=True)
class Owner:
    """Whose symbols are drawn: a branch, the branches that share its drawing, and what its label begins with.

    ``scope`` is the name of the group under which it is drawn and which its own name need not repeat.
    """

    twins: tuple[str, ...] = ()
    scope: str = ""

    def branches(self, name: str) -> tuple[str, ...]:
        """The branch of that name and its likes in the twins of the scope."""
        return (name, *(twin + name.removeprefix(self.scope) for twin in self.twins))

    def title(self, name: str) -> str:
        """The name below the scope."""
        return name.removeprefix(f"{self.scope}.") if self.scope else name


@dataclass(frozen=True)
class Planner:
    """Makes blocks whose force runs up the page or to the right; ``flipped`` where the upper node lies at the start."""

    sizes: Sizes
    upright: bool
    owner: Owner = Owner()

    def outermost(self, member: Branch | Group, more: tuple[str, ...], boxed: bool, flipped: bool) -> Block:
        """The block of a branch of the file with ``more`` lines; ``boxed`` where a group is drawn elsewhere."""
        if isinstance(member, Branch):
            return self.branch(member, more)
        if boxed:
            box = self.box(member.name, ())
            return self.labelled(box, "", more, (member.name,)) if more else box
        block = self.block(member, flipped)
        if not more:
            return block
        note = self.labelled(Lead(self.sizes.lead), "", more, (member.name,))
        return Chain([block, note] if flipped else [note, block])

    def block(self, member: Branch | Group, flipped: bool) -> Block:
        """The block of a branch or of a whole tree."""
        if isinstance(member, Branch):
            return self.branch(member)
        blocks = [self.block(inner, flipped) for inner in member.members]
        if len(blocks) == 1:
            return blocks[0]
        if member.kind == "series":
            return Chain(blocks[::-1] if flipped else blocks)
        return self.fan(blocks)

    def branch(self, branch: Branch, more: tuple[str, ...] = ()) -> Block:
        """Symbols, scaling arrow and label of one element, with ``more`` lines at its end."""
        owners = self.owner.branches(branch.name)
        inner = self._picture(branch.element.picture, branch, owners)
        if branch.scale:
            aside = 0.0 if self.sizes.half else 2 * self.sizes.lead
            inner = Scaled(inner, self.sizes.half * 0.7, aside, len(branch.scale.values), owners)
        return self.labelled(inner, self.owner.title(branch.name), (*branch_lines(branch), *more), owners)

    def labelled(self, inner: Block, name: str, lines: tuple[str, ...], owners: tuple[str, ...]) -> Block:
        """A block with its label."""
        return Labelled(inner, name, lines, owners, self.sizes, self.upright)

    def fan(self, blocks: list[Block]) -> Block:
        """Blocks in parallel, joined at their ends."""
        return Fan(self.row(blocks), self.sizes.lead)

    def row(self, blocks: list[Block]) -> Row:
        """Blocks side by side."""
        return Row(blocks, self.sizes.gap, self.sizes.whole)

    def box(self, word: str, branches: tuple[str, ...]) -> Block:
        """A rectangle with a word in it."""
        width = self.sizes.width(word, False) + 2 * self.sizes.pad - self.sizes.whole
        length, half = (
            (self.sizes.symbol, max(width / 2, self.sizes.half)) if self.upright else (width, self.sizes.half)
        )
        return Piece(Symbol.BOX, length, half, self.sizes.lead, branches, word)

    def _picture(self, picture: Picture, branch: Branch, owners: tuple[str, ...]) -> Block:
        if picture is Symbol.BOX:
            return self.box(branch.element.word, owners)
        if isinstance(picture, Symbol):
            half = self.sizes.half * 1.5 if is_curved(branch) else self.sizes.half
            return Piece(picture, self.sizes.symbol, half, self.sizes.lead, owners, curved=is_curved(branch))
        blocks = [self._picture(part, branch, owners) for part in picture.parts]
        return Chain(blocks) if isinstance(picture, Series) else self.fan(blocks)
