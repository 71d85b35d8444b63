"""Sorting a graph by what it depends on, so that the inner loop holds only what must be in it.

A node that depends on the drive alone is computed once per sample for all lanes, one that depends on parameters alone
once per lane; both by the numpy interpreter. Products and sums are regrouped first, so that in k * |dx| / F_c the
quotient k / F_c leaves the loop and the division with it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from dashpot.expr.node import Node, apply, constant, symbol, symbols_of, walk, with_arguments
from dashpot.kernel.compiler.events import DRIVE_SYMBOLS, Correction, find_followers, merge_followers, split_events
from dashpot.kernel.compiler.trace import TracedBranch
from dashpot.kernel.following import channel_symbols
from dashpot.kernel.ir.program import Lookup, Program

ONE, ZERO = constant(1.0), constant(0.0)


Tier = int  # what a node depends on, as bits
NOTHING, LANE, DRIVE, STATE = 0, 1, 2, 7  # nothing: a constant or the step; LANE | DRIVE: part of the inner loop
INNER = (LANE | DRIVE, STATE)


def sort_tiers(branches: Sequence[TracedBranch]) -> Program:
    """Regroup the laws of a network and decide what leaves the inner loop."""
    total = ZERO
    for branch in branches:
        total = total + branch.force
    laws = {name: node for branch in branches for name, node in branch.states.items()}
    followers = find_followers(laws)
    states = tuple(name for name in laws if name not in followers)
    roots = merge_followers([total, *(laws[name] for name in states)], followers)
    channels = channel_symbols(name for root in roots for name in symbols_of(root))
    known = {*DRIVE_SYMBOLS, *followers, *channels}
    roots, corrections = split_events(roots, known)
    events = _unique(correction.condition for correction in corrections)
    before = [_corrected(correction, len(events) > 1) for correction in corrections]
    regroup = Regrouping(set(states), known, shared_nodes([*roots, *before]))
    force, *updates = [regroup(root) for root in roots]
    corrected = {correction.state: regroup(node) for correction, node in zip(corrections, before, strict=True)}
    for event in events:
        regroup.settle(event)
    everything = [force, *updates, *corrected.values()]
    columns, constants, lookups = hoist(everything, events, regroup.tiers)
    turning = {name for branch in branches if branch.sight == "monotone" for name in branch.states}
    return Program(
        columns,
        constants,
        lookups,
        followers,
        force,
        dict(zip(states, updates, strict=True)),
        tuple(name for name in states if name in turning),
        events,
        corrected,
    )


def _corrected(correction: Correction, among_others: bool) -> Node:
    if not among_others:
        return correction.then
    return apply("where", correction.condition, correction.then, symbol(correction.state))


def hoist(
    roots: Sequence[Node], events: Sequence[Node], tiers: Mapping[int, Tier]
) -> tuple[tuple[Node, ...], tuple[Node, ...], tuple[Lookup, ...]]:
    """The nodes that leave the inner loop: once per sample, once per lane, and the tables along the drive."""
    inner = [node for node in walk(roots) if _is_inner(tiers[node.serial])]
    edges = [argument for node in inner if node.operation != "table" for argument in node.arguments]
    edges += [root for root in roots if not _is_inner(tiers[root.serial])]
    return (
        _unique([*(node for node in edges if tiers[node.serial] == DRIVE), *events]),
        _unique(node for node in edges if _is_lane(node, tiers[node.serial])),
        tuple(Lookup(node.payload[0], node.arguments[0]) for node in inner if node.operation == "table"),
    )


def shared_nodes(roots: Sequence[Node]) -> set[int]:
    """The serials of nodes with more than one use: dissolved by regrouping, their work would be done twice."""
    uses = Counter(root.serial for root in roots)
    for node in walk(roots):
        uses.update(argument.serial for argument in node.arguments)
    return {serial for serial, count in uses.items() if count > 1}


def _is_inner(tier: Tier) -> bool:
    return tier in INNER


def _is_lane(node: Node, tier: Tier) -> bool:
    return node.operation != "constant" and tier in (LANE, NOTHING)


def _unique(nodes: Iterable[Node]) -> tuple[Node, ...]:
    return tuple({node.serial: node for node in nodes}.values())


class Regrouping:
    """Rebuilds a graph bottom up with the factors and terms of each tier together."""

    def __init__(self, states: set[str], known: set[str], shared: set[int]) -> None:
        self.states, self.known, self.shared = states, known, shared
        self.kept: set[int] = set()
        self.tiers: dict[int, Tier] = {}
        self.done: dict[int, Node] = {}

    def __call__(self, root: Node) -> Node:
        for node in walk([] if root.serial in self.done else [root], self.done):
            self.done[node.serial] = self.settle(self.rebuild(node))
            if node.serial in self.shared:
                self.kept.add(self.done[node.serial].serial)
        return self.done[root.serial]

    def settle(self, node: Node) -> Node:
        """Note the tiers of a node and everything below it."""
        stack = [] if node.serial in self.tiers else [node]
        while stack:
            new = [argument for argument in stack[-1].arguments if argument.serial not in self.tiers]
            if new:
                stack.extend(new)
            else:
                inner = stack.pop()
                self.tiers[inner.serial] = self.tier(inner)
        return node

    def tier(self, node: Node) -> Tier:
        if node.operation == "symbol":
            if node.payload in self.states:
                return STATE
            return NOTHING if node.payload == "dt" else DRIVE if node.payload in self.known else LANE
        found = LANE if node.operation in ("table", "lookup") else NOTHING
        for argument in node.arguments:
            found |= self.tiers[argument.serial]
        return found

    def rebuild(self, node: Node) -> Node:
        arguments = tuple(self.done[argument.serial] for argument in node.arguments)
        if not arguments:
            return node
        plain = with_arguments(node, arguments)
        if plain.serial in self.kept:
            return plain
        if node.operation in ("multiply", "divide", "negative"):
            return self.product(plain)
        return self.sum(plain) if node.operation in ("add", "subtract") else plain

    def product(self, node: Node) -> Node:
        above: dict[Tier, Node] = {}
        below: dict[Tier, Node] = {}
        self.collect_factors(node, above, below)
        hoisted = [tier for tier in (NOTHING, LANE, DRIVE) if tier in above or tier in below]
        groups = [apply("divide", above.pop(tier, ONE), below.pop(tier, ONE)) for tier in hoisted]
        for group in groups:
            self.settle(group)
        inner = [part for part in above.values() if part is not ONE]
        if len(inner) == 1 and LANE in hoisted and not below:
            spread = self.spread(groups[hoisted.index(LANE)], inner[0])
            if spread is not None:
                groups.pop(hoisted.index(LANE))
                inner = [spread]
        total = groups[0] if groups else ONE
        for part in (*groups[1:], *inner):
            total = apply("multiply", total, part)
        for part in below.values():
            total = apply("divide", total, part)
        return total

    def spread(self, factor: Node, total: Node) -> Node | None:
        """A lane's factor times a sum, where every term holds a number of the lane that can take the factor in."""
        self.settle(total)
        if total.operation in ("add", "subtract") and total.serial not in self.kept:
            first, second = (self.spread(factor, argument) for argument in total.arguments)
            return None if first is None or second is None else apply(total.operation, first, second)
        if not _is_inner(self.tiers[total.serial]):
            return None if self.tiers[total.serial] & DRIVE else self.settle(apply("multiply", factor, total))
        if total.operation == "negative":
            rest = self.spread(factor, total.arguments[0])
            return None if rest is None else apply("negative", rest)
        if total.operation != "multiply" or self.tiers[total.arguments[0].serial] not in (NOTHING, LANE):
            return None
        lane, rest = total.arguments
        return apply("multiply", self.settle(apply("multiply", factor, lane)), rest)

    def collect_factors(self, node: Node, above: dict[Tier, Node], below: dict[Tier, Node]) -> None:
        self.settle(node)
        if node.serial in self.kept and _is_inner(self.tiers[node.serial]):
            self.count_factor(node, above)
        elif node.operation == "negative":
            above[NOTHING] = apply("multiply", above.get(NOTHING, ONE), constant(-1.0))
            self.collect_factors(node.arguments[0], above, below)
        elif node.operation == "multiply":
            for argument in node.arguments:
                self.collect_factors(argument, above, below)
        elif node.operation == "divide":
            self.collect_factors(node.arguments[0], above, below)
            self.collect_factors(node.arguments[1], below, above)
        else:
            self.count_factor(node, above)

    def count_factor(self, node: Node, above: dict[Tier, Node]) -> None:
        tier = self.tiers[node.serial]
        above[tier] = apply("multiply", above.get(tier, ONE), node)

    def sum(self, node: Node) -> Node:
        terms: dict[Tier, Node] = {}
        self.collect_terms(node, 1.0, terms)
        groups = [terms[tier] for tier in sorted(terms)]
        total = groups[0]
        for group in groups[1:]:
            self.settle(group)
            total = apply("add", total, group)
        return total

    def collect_terms(self, node: Node, side: float, terms: dict[Tier, Node]) -> None:
        self.settle(node)
        kept = node.serial in self.kept and _is_inner(self.tiers[node.serial])
        if node.operation in ("add", "subtract") and not kept:
            first, second = node.arguments
            self.collect_terms(first, side, terms)
            self.collect_terms(second, side if node.operation == "add" else -side, terms)
            return
        tier = self.tiers[node.serial]
        if tier in terms:
            terms[tier] = apply("add" if side > 0.0 else "subtract", terms[tier], node)
        else:
            terms[tier] = node if side > 0.0 else apply("negative", node)
