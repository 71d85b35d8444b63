"""A graph as expressions: what is used once stands where it is used, what is used again gets a variable."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping

from dashpot.expr.node import Node, is_logical
from dashpot.kernel.targets.scalar.code import Code

LONGEST = 90  # characters of an expression before it gets a variable of its own


def truth(node: Node, place: str) -> str:
    """A number at a place, or, for a node that is true or false, whether it is not zero."""
    return f"({place} != 0.0)" if is_logical(node) else place


class Writer:
    """Writes the expressions of some roots.

    ``leaf`` answers the text of a node that is there already, or None; ``look_up`` that of a table with an argument.
    """

    def __init__(self, code: Code, roots: Iterable[Node], leaf: Callable[[Node], str | None],
                 look_up: Callable[[Node, str], str] | None = None) -> None:  # fmt: skip
        self.code, self.leaf, self.look_up = code, leaf, look_up
        self.known: dict[int, str] = {}
        self.uses = Counter[int]()
        self._count(list(roots))

    def value(self, root: Node) -> str:
        """The expression of a node, after the variables that it needs."""
        stack = [(root, False)]
        while stack:
            node, ready = stack.pop()
            if node.serial in self.known:
                continue
            if ready:
                self.known[node.serial] = self._named(node, self._expression(node))
                continue
            found = self.leaf(node)
            if found is not None:
                self.known[node.serial] = found
            else:
                stack.append((node, True))
                stack.extend((argument, False) for argument in reversed(node.arguments))
        return self.known[root.serial]

    def number(self, node: Node) -> str:
        """The same, with 1.0 for true."""
        value = self.value(node)
        one, zero = self.code.number(1.0), self.code.number(0.0)
        return self.code.operations["where"].format(value, one, zero) if is_logical(node) else value

    def store(self, places: Mapping[str, Node]) -> None:
        """New values at some places; all are computed before any is stored."""
        found = {place: self.code.new(self.number(node)) for place, node in places.items()}
        for place, value in found.items():
            self.code.set(place, value)

    def _count(self, stack: list[Node]) -> None:
        while stack:
            node = stack.pop()
            self.uses[node.serial] += 1
            if self.uses[node.serial] == 1 and self.leaf(node) is None:
                stack.extend(node.arguments)

    def _expression(self, node: Node) -> str:
        given = [self.known[each.serial] for each in node.arguments]
        if node.operation in ("table", "lookup"):
            assert self.look_up is not None
            return self.look_up(node, *given)
        return self.code.operations[node.operation].format(*given)

    def _named(self, node: Node, text: str) -> str:
        if self.uses[node.serial] == 1 and len(text) < LONGEST:
            return text
        return self.code.new(text, "truth" if is_logical(node) else "number")
