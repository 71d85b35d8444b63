"""The whole drawing of a network: title and remarks, its figure, and large groups in figures of their own."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeAlias

from dashpot.model.network import END, GROUND, Branch, Ends, Group, NetworkSpec
from dashpot.report.schematic.blocks import Block
from dashpot.report.schematic.figure import MakeBlock, figure
from dashpot.report.schematic.graph import Bundle, Graph, Node, graph_of
from dashpot.report.schematic.order import arrange
from dashpot.report.schematic.planning import Owner, Planner
from dashpot.report.schematic.shapes import Box, Shape, Words
from dashpot.report.schematic.sizes import Sizes
from dashpot.report.schematic.wording import equation, measurement_lines, quantity

Twins: TypeAlias = tuple[Group, tuple[str, ...]]  # a group, and the names of those that share its numbers
Draw: TypeAlias = Callable[[Sizes], list[Shape]]
LARGE = 4  # branches; a larger group between two nodes gets a figure of its own


@dataclass(frozen=True)
class Drawing:
    """Shapes in a box whose left upper corner is at zero."""

    name: str
    about: str
    shapes: tuple[Shape, ...]
    box: Box


def drawing_of(spec: NetworkSpec, variants: Sequence[Sizes], width: float = 0.0, large: int = LARGE) -> Drawing:
    """The drawing of a network; every number that has a place of its own stands in it once.

    Each figure takes the one of the ``variants`` in which it is lowest at no more than this ``width``. Groups of more
    than ``large`` branches are drawn in figures of their own.
    """
    shapes: list[Shape] = []
    bottom = 0.0
    for draw in _figures(spec, variants[0], _large(spec, large)):
        part, box = min((_framed(draw(sizes)) for sizes in variants), key=lambda found: _rank(found[1], width))
        shapes += [shape.moved(-box.left, bottom - box.top) for shape in part]
        bottom += box.bottom - box.top + 2 * variants[0].pad
    return Drawing(spec.name, spec.about, tuple(shapes), Box.union([shape.box for shape in shapes]))


def _framed(shapes: list[Shape]) -> tuple[list[Shape], Box]:
    return shapes, Box.union([shape.box for shape in shapes])


def _rank(box: Box, width: float) -> tuple[float, float]:
    return max(box.right - box.left, width), box.bottom - box.top


def _figures(spec: NetworkSpec, sizes: Sizes, large: Sequence[Twins]) -> Iterator[Draw]:
    yield partial(_heading, spec.name, tuple(_notes(spec)))
    for graph in _split(graph_of(spec), sizes):
        yield partial(_main, spec, graph, large)
    for group, twins in large:
        yield partial(_heading, ", ".join((group.name, *twins)), ())
        yield partial(_detail, spec, group, twins)


def _main(spec: NetworkSpec, graph: Graph, large: Sequence[Twins], sizes: Sizes) -> list[Shape]:
    return figure(graph, _maker(spec, sizes, large), sizes)


def _split(graph: Graph, sizes: Sizes) -> list[Graph]:
    """Where forces run to the right only, what lies between nodes of one level is drawn in figures of its own."""
    arrangement = arrange(graph, sideways=True)
    across = [bundle for bundle in graph.bundles if arrangement.sideways(bundle) and not sizes.upright]
    rest = tuple(bundle for bundle in graph.bundles if bundle not in across)
    return [Graph(graph.nodes, rest), *(_between_terminals(bundle, graph) for bundle in across)]


def _between_terminals(bundle: Bundle, graph: Graph) -> Graph:
    ends = {key: Node(key, graph.nodes[key].name, "terminal") for key in (bundle.lower, bundle.upper)}
    return Graph(ends, (bundle,))


def _maker(spec: NetworkSpec, sizes: Sizes, large: Sequence[Twins]) -> MakeBlock:
    boxed = {name for group, twins in large for name in (group.name, *twins)}

    def make(bundle: Bundle, apart: bool, upright: bool, flipped: bool) -> Block:
        planner = Planner(sizes, upright)
        blocks = []
        for member in bundle.members:
            turned = flipped != (member.name in bundle.backward)
            blocks.append(planner.outermost(member, _offset(spec, member), member.name in boxed, turned))
        return _joined(blocks, planner, apart)

    return make


def _joined(blocks: list[Block], planner: Planner, apart: bool) -> Block:
    if len(blocks) == 1:
        return blocks[0]
    return planner.row(blocks) if apart and planner.upright == planner.sizes.upright else planner.fan(blocks)


def _offset(spec: NetworkSpec, member: Branch | Group) -> tuple[str, ...]:
    ends = spec.ends.get(member.name)
    return (equation("x_0", ends.offset),) if ends and ends.offset and not ends.shares else ()


def _large(spec: NetworkSpec, large: int) -> list[Twins]:
    """Groups of more branches than that, each with the names of those that share its numbers."""
    groups = [member for member in spec.root.members if isinstance(member, Group)]
    groups = [group for group in groups if len(list(group.leaves())) > large and (spec.joints or large < LARGE)]
    owners = {group.name: _origin(group) for group in groups}
    return [
        (group, tuple(name for name, origin in owners.items() if origin == group.name and name != group.name))
        for group in groups
        if owners[group.name] == group.name
    ]


def _origin(group: Group) -> str:
    first = next(group.leaves())
    if not first.shares:
        return group.name
    return first.shares.removesuffix(first.name.removeprefix(group.name))


def _detail(spec: NetworkSpec, group: Group, twins: tuple[str, ...], sizes: Sizes) -> list[Shape]:
    ends = [spec.ends.get(name, Ends(END, GROUND)) for name in (group.name, *twins)]
    nodes = {
        key: Node(key, names[0], "terminal", tuple(dict.fromkeys(name for name in names[1:] if name != names[0])))
        for key, names in (("lower", [end.lower for end in ends]), ("upper", [end.upper for end in ends]))
    }
    members = group.members if group.kind == "parallel" else (group,)
    owner = Owner(twins, group.name)

    def make(bundle: Bundle, apart: bool, upright: bool, flipped: bool) -> Block:
        planner = Planner(sizes, upright, owner)
        return _joined([planner.block(member, flipped) for member in bundle.members], planner, apart)

    return figure(Graph(nodes, (Bundle("lower", "upper", tuple(members)),)), make, sizes)


def _notes(spec: NetworkSpec) -> Iterator[str]:
    if spec.gravity:
        yield f"g = {quantity(spec.gravity, 'm/s^2')}"
    if spec.measurement:
        yield f"load cell: {', '.join(measurement_lines(spec))}"
    if any(slot.value.role == "free" for slot in spec.slots()):
        yield "≈ start of a parameter to be identified"


def _heading(name: str, lines: tuple[str, ...], sizes: Sizes) -> list[Shape]:
    name, lines = replace(sizes, filling=0.0).label(name, lines)
    widths = [sizes.width(name, True), *(sizes.width(line, False) for line in lines)]
    return [Words(name, lines, Box(0.0, 0.0, max(widths), sizes.line * len(widths)), ())]
