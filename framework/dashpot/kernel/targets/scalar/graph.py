"""A graph as expressions: what is used once stands where it is used, what is used again gets a variable."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping

from dashpot.expr.node import Node, is_logical
from dashpot.kernel.targets.scalar.code import Code

LONGEST = 90  # characters of an expression before it gets a variable of its own
LONG = ("wrightomega", "exp")  # functions that are worth being computed side by side


def truth(node: Node, place: str) -> str:
    """A number at a place, or, for a node that is true or false, whether it is not zero."""
    return f"({place} != 0.0)" if is_logical(node) else place


class Writer:
    """Writes the expressions of some roots.

    ``leaf`` answers the text of a node that is there already, or None; ``look_up`` that of a table with an argument.
    """

    def __init__(
        self,
        code: Code,
        roots: Iterable[Node],
        leaf: Callable[[Node], str | None],
        look_up: Callable[[Node, str], str] | None = None,
    ) -> None:
        self.code, self.leaf, self.look_up = code, leaf, look_up
        self.known: dict[int, str] = {}
        self.uses = Counter[int]()
        self.long: list[Node] = []
        self.powers: dict[tuple[int, float], int] = {}
        self._ranks: dict[int, int] = {}
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

    def compute_together(self, fewest: int = 2) -> None:
        """Functions that are long and do not need each other, side by side, those first that others need."""
        ranks: dict[int, list[Node]] = {}
        for node in self.long:
            ranks.setdefault(self._rank(node), []).append(node)
        for _, nodes in sorted(ranks.items()):
            if len(nodes) >= fewest:
                calls = [(node.operation, self.value(node.arguments[0])) for node in nodes]
                for node, name in zip(nodes, self.code.together(calls), strict=False):
                    self.known[node.serial] = name

    def store(self, places: Mapping[str, Node]) -> None:
        """New values at some places; all are computed before any is stored."""
        found = {place: self._kept(self.number(node)) for place, node in places.items()}
        for place, value in found.items():
            self.code.set(place, value)

    def _kept(self, value: str) -> str:
        return value if value.isidentifier() else self.code.new(value)

    def _count(self, stack: list[Node]) -> None:
        while stack:
            node = stack.pop()
            self.uses[node.serial] += 1
            if self.uses[node.serial] == 1 and self.leaf(node) is None:
                stack.extend(node.arguments)
                self.long += [node] * (node.operation in LONG)

    def _rank(self, root: Node) -> int:
        """How many long functions follow each other until this one."""
        stack = [(root, False)]
        while stack:
            node, ready = stack.pop()
            inner = node.arguments if self.leaf(node) is None else ()
            if ready:
                below = max((self._ranks[each.serial] for each in inner), default=0)
                self._ranks[node.serial] = below + (node.operation in LONG)
            elif node.serial not in self._ranks:
                stack.append((node, True))
                stack.extend((each, False) for each in inner)
        return self._ranks[root.serial]

    def _expression(self, node: Node) -> str:
        given = [self.known[each.serial] for each in node.arguments]
        if node.operation in ("table", "lookup"):
            assert self.look_up is not None
            return self.look_up(node, *given)
        lower = self._power_below(node)
        return f"({lower} * {given[0]})" if lower else self.code.operations[node.operation].format(*given)

    def _power_below(self, node: Node) -> str:
        """The variable of the power by one less, where there is one: series need many powers of one number."""
        if node.operation != "power" or node.arguments[1].operation != "constant":
            return ""
        base, exponent = node.arguments[0].serial, float(node.arguments[1].payload)
        self.powers[base, exponent] = node.serial
        lower = self.known.get(self.powers.get((base, exponent - 1.0), -1), "")
        return lower if exponent > 1.0 and lower.isidentifier() else ""

    def _named(self, node: Node, text: str) -> str:
        if self.uses[node.serial] == 1 and len(text) < LONGEST:
            return text
        return self.code.new(text, "truth" if is_logical(node) else "number")
