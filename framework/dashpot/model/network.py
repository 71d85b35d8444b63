"""A network as it is declared: a tree of named branches between two ends or between nodes, and how the rig sees it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal

from dashpot.model.element import Curve, Element, Scale
from dashpot.model.identified import Identified
from dashpot.model.prior import Prior
from dashpot.text.document import Document
from dashpot.text.node import Node
from dashpot.text.problem import Place

if TYPE_CHECKING:
    from dashpot.model.derived import Derived

Role = Literal["fixed", "free", "identified"]
Form = Literal["constant", "polynomial", "table", "data"]
# moved by the rig, loaded by a known force, held still, or moving as the forces on it say
Hold = Literal["driven", "loaded", "ground", "free"]

END, GROUND = "", "ground"  # the nodes of a network that has only two ends
MASSES = ("mass", "added_mass")
# what a number may do over a setting: rise along a line, grow by an exponential, follow factors between places; over a
# temperature: shift by the law of Williams, Landel and Ferry or by that of Arrhenius; over the history of the specimen:
# add up what is kept of each run before
Way = Literal["slope", "rate", "factor", "wlf", "arrhenius", "kept"]
WAYS_OVER: tuple[Way, ...] = ("slope", "rate", "factor", "wlf", "arrhenius", "kept")
LISTED: tuple[Way, ...] = ("factor", "wlf")  # those with several numbers


@dataclass(frozen=True)
class Value:
    """A number of a file: fixed, free (``start``) or identified earlier (``value`` with ``bounds``). SI throughout.

    ``sensible`` is the range in which such a number makes sense at all, ``interval`` how well it is known, ``setting``
    the setting by which a run may give the number itself, ``node`` where it stands. A ``known`` number is fixed, but
    its interval is one to be allowed for: it was weighed or taken from a drawing. With ``over`` it is another number
    in each run, as a setting of the run says. A number with an ``expression`` follows from others. A ``prior`` is
    what was known of a searched number before.
    """

    number: float
    unit: str
    role: Role = "fixed"
    bounds: tuple[float, float] | None = None
    scale: Scale = "log"
    interval: tuple[float, float] | None = None
    sensible: tuple[float, float] = (-math.inf, math.inf)
    setting: str = ""
    known: bool = False
    over: Over | None = None
    expression: str = ""
    prior: Prior | None = None
    node: Node | None = field(default=None, compare=False, repr=False)

    @property
    def place(self) -> int:
        """Where the number stands in the text; before everything when it does not."""
        return self.node.start if self.node else -1

    @property
    def searched(self) -> bool:
        """Whether an identification may move the number."""
        return self.role != "fixed"

    def as_role(self, role: Role) -> Value:
        """The same number in another role."""
        return replace(self, role=role)


@dataclass(frozen=True)
class Over:
    """How a number b depends on a setting s, or on a channel s, which it follows sample by sample.

    ``slope``: b + slope (s - at); ``rate``: b exp(rate (s - at)); ``factor``: b times a factor that goes along straight
    lines between the places ``at`` and stays as it is outside of them. With a temperature s in K, ``wlf``:
    b 10^(-C1 (s - at) / (C2 + s - at)) with numbers C1 and C2, and ``arrhenius``: b exp(E (1 / s - 1 / at)) with an
    activation energy over the gas constant E in K (Ferry, Viscoelastic Properties of Polymers, chapter 11). With a
    setting that tells of the runs before, ``kept``: b + s1 + kept s2 + kept^2 s3 + ..., of the run before, the one
    before that, and so on.
    ``numbers`` are fixed or to be found like all numbers. What comes out is kept inside the sensible range of b.
    """

    word: str
    way: Way
    at: tuple[float, ...]
    numbers: tuple[Value, ...]
    channel: bool = False

    @property
    def endings(self) -> tuple[str, ...]:
        """What stands behind the path of b in the paths of the parameters."""
        if self.way not in LISTED:
            return (f".{self.way}",)
        return tuple(f".{self.way}[{number}]" for number in range(len(self.numbers)))


@dataclass(frozen=True)
class Characteristic:
    """A curve of a file. ``at`` holds the knots of a table; ``data`` names the runs a curve is to be taken from.

    A curve from data is kept as these runs give it, or, with ``refine``, moved together with the other numbers.
    """

    curve: Curve
    form: Form
    values: tuple[Value, ...]
    at: tuple[float, ...] = ()
    data: str = ""
    knots: int = 0
    node: Node | None = field(default=None, compare=False, repr=False)
    refine: bool = False


@dataclass(frozen=True)
class Branch:
    """One element between two ends, with its numbers; ``scale`` multiplies its force, over its deflection.

    ``family`` is the name as it stands in the file: the copies of a repeated branch share it. ``shares`` is the branch
    whose numbers these are, where a second part of the same make is not to have numbers of its own.
    """

    name: str
    element: type[Element]
    values: Mapping[str, Value]
    curves: Mapping[str, Characteristic]
    scale: Characteristic | None = None
    family: str = ""
    shares: str = ""
    place: Place = field(default_factory=Place, compare=False)

    @property
    def numbers(self) -> str:
        """The name of the branch under which its numbers stand."""
        return self.shares or self.name

    def characteristics(self) -> dict[str, Characteristic]:
        """All curves of the branch, the scaling among them."""
        return {**self.curves, "scale": self.scale} if self.scale else dict(self.curves)


@dataclass(frozen=True)
class Group:
    """Branches in parallel or in series."""

    name: str
    kind: Literal["parallel", "series"]
    members: tuple[Branch | Group, ...]
    place: Place = field(default_factory=Place, compare=False)

    def leaves(self) -> Iterator[Branch]:
        """Every branch that holds an element, in the order of the file."""
        for member in self.members:
            if isinstance(member, Group):
                yield from member.leaves()
            else:
                yield member


@dataclass(frozen=True)
class Joint:
    """A node of the network; its motion counts upwards. ``shares`` is the node whose masses it has, if not its own.

    ``mounted`` is the driven node that carries it by a fixture that gives way, where there is one.
    """

    name: str
    hold: Hold
    masses: Mapping[str, Value] = field(default_factory=dict)
    shares: str = ""
    place: Place = field(default_factory=Place, compare=False)
    mounted: str | None = None

    @property
    def numbers(self) -> str:
        """The name of the node under which its masses stand."""
        return self.shares or self.name


@dataclass(frozen=True)
class Ends:
    """The two nodes that a branch of the file connects, the lower one first.

    Its deflection is z_lower - z_upper + offset: ``offset`` is what it is when both nodes stand at zero; None is none.
    ``shares`` is the branch whose offset it has, if not its own.
    """

    lower: str
    upper: str
    offset: Value | None = None
    shares: str = ""


@dataclass(frozen=True)
class Slot:
    """One number of a network with the path by which everybody calls it, e.g. ``maxwell_1.stiffness``.

    ``of`` is the number that it changes over a setting, where it is a slope, a rate or a factor.
    """

    path: str
    value: Value
    of: Value | None = None


@dataclass(frozen=True)
class NetworkSpec:
    """A network, one to one with its text. ``measurement`` says how the load cell sees it (gain, offset and so on).

    A network without ``joints`` has two ends: one is driven, the other held. With joints, ``ends`` says for every
    member of ``root`` what it connects; ``gravity`` in m/s^2 pulls at the masses. ``identified`` tells where
    its numbers came from, ``used`` what stands in the networks that it uses.
    """

    name: str
    root: Group
    measurement: Mapping[str, Value] = field(default_factory=dict)
    joints: Mapping[str, Joint] = field(default_factory=dict)
    ends: Mapping[str, Ends] = field(default_factory=dict)
    gravity: float = 0.0
    about: str = ""
    source: str = ""
    document: Document | None = field(default=None, compare=False, repr=False)
    identified: Identified = field(default_factory=Identified, compare=False, repr=False)
    used: tuple[str, ...] = field(default=(), compare=False, repr=False)

    @property
    def text(self) -> str:
        """The text the network was read from. ValueError for a network made without one."""
        if self.document is None:
            raise ValueError(f"expected a network that was read from a text, got '{self.name}', which was built")
        return self.document.text

    @property
    def texts(self) -> tuple[str, ...]:
        """Its text and those of all networks that it uses: what it says depends on nothing else."""
        return (self.text, *self.used)

    @property
    def file(self) -> str | None:
        """The file of that text: what the network uses lies beside it. None for a text without one."""
        return self.document.file if self.document else None

    def leaves(self) -> tuple[Branch, ...]:
        """Every branch that holds an element, in the order of the file."""
        return tuple(self.root.leaves())

    def slots(self) -> tuple[Slot, ...]:
        """Every number of the network: branch by branch, node by node, then the measurement."""
        return self._slots

    @cached_property
    def _slots(self) -> tuple[Slot, ...]:
        found = [slot for branch in self.leaves() if not branch.shares for slot in branch_slots(branch)]
        moved = ((name, ends.offset) for name, ends in self.ends.items() if not ends.shares)
        found += [Slot(f"{name}.offset", offset) for name, offset in moved if offset]
        heavy = (joint for joint in self.joints.values() if not joint.shares)
        found += [Slot(f"{joint.name}.{key}", value) for joint in heavy for key, value in joint.masses.items()]
        found += [Slot(f"measurement.{key}", value) for key, value in self.measurement.items()]
        return tuple(each for slot in found for each in (slot, *over_slots(slot)))

    @cached_property
    def told_by_runs(self) -> tuple[tuple[int, Slot], ...]:
        """The numbers that a run gives by its settings, or that depend on them, with their places among the slots."""
        return tuple((k, slot) for k, slot in enumerate(self._slots) if slot.value.setting or slot.value.over)

    @cached_property
    def derived(self) -> Derived:
        """How numbers follow from others. Raises InputError for an expression that does not fit the network."""
        from dashpot.model.derived import derived_of

        return derived_of(self.slots())

    def with_values(self, values: Mapping[str, Value]) -> NetworkSpec:
        """The same network with the values of some slots replaced, by path, and all that follow from them.

        KeyError for a path that it has not. Raises InputError for a number that follows and would make no sense.
        """
        unknown = set(values) - {slot.path for slot in self.slots()}
        if unknown:
            raise KeyError(f"'{self.name}' has no slot {', '.join(sorted(unknown))}")
        found = self._renewed(values)
        if not any(slot.value.expression for slot in found.slots()):
            return found
        from dashpot.model.derived import followed

        return found._renewed(followed(found.slots(), found.derived))

    def _renewed(self, values: Mapping[str, Value]) -> NetworkSpec:
        return replace(
            self,
            root=_regroup(self.root, lambda branch: _revalue(branch, values)),
            measurement={key: _renewed(f"measurement.{key}", value, values) for key, value in self.measurement.items()},
            joints={name: _reweigh(joint, values) for name, joint in self.joints.items()},
            ends={name: _replace_offset(name, ends, values) for name, ends in self.ends.items()},
        )

    def with_curve(self, path: str, characteristic: Characteristic) -> NetworkSpec:
        """The same network with the curve at ``branch.curve`` replaced. KeyError for a path that it has not."""
        name, _, key = path.rpartition(".")
        if path not in self.curves():
            raise KeyError(f"'{self.name}' has no curve {path}")

        def swap(branch: Branch) -> Branch:
            if branch.numbers != name:
                return branch
            if key == "scale":
                return replace(branch, scale=characteristic)
            return replace(branch, curves={**branch.curves, key: characteristic})

        return replace(self, root=_regroup(self.root, swap))

    def curves(self) -> dict[str, Characteristic]:
        """Every curve by path, the scalings among them."""
        return {
            f"{branch.name}.{key}": curve
            for branch in self.leaves()
            if not branch.shares
            for key, curve in branch.characteristics().items()
        }

    def data_curves(self) -> dict[str, Characteristic]:
        """The curves that are to be taken from data, by path."""
        return {path: curve for path, curve in self.curves().items() if curve.data}


def over_slots(slot: Slot) -> Iterator[Slot]:
    """The parameters by which the number of a slot depends on a setting."""
    over = slot.value.over
    if over:
        for ending, value in zip(over.endings, over.numbers, strict=True):
            yield Slot(slot.path + ending, value, slot.value)


def branch_slots(branch: Branch) -> Iterator[Slot]:
    """The parameters of one branch, in the order of its declaration; those of a twin have the paths of its model.

    What they do over settings is left out.
    """
    for key in (*branch.element.declares.curves, *branch.element.declares.parameters):
        if key in branch.curves:
            yield from _curve_slots(f"{branch.numbers}.{key}", branch.curves[key])
        elif key in branch.values:
            yield Slot(f"{branch.numbers}.{key}", branch.values[key])
    if branch.scale:
        yield from _curve_slots(f"{branch.numbers}.scale", branch.scale)


def _curve_slots(path: str, curve: Characteristic) -> Iterator[Slot]:
    if curve.form == "constant":
        yield Slot(path, curve.values[0])
        return
    for number, value in enumerate(curve.values):
        yield Slot(f"{path}[{number}]", value)


def _regroup(group: Group, change: Callable[[Branch], Branch]) -> Group:
    members = tuple(_regroup(m, change) if isinstance(m, Group) else change(m) for m in group.members)
    return replace(group, members=members)


def _revalue(branch: Branch, values: Mapping[str, Value]) -> Branch:
    plain = {key: _renewed(f"{branch.numbers}.{key}", value, values) for key, value in branch.values.items()}
    curves = {key: _recurve(f"{branch.numbers}.{key}", curve, values) for key, curve in branch.curves.items()}
    scale = _recurve(f"{branch.numbers}.scale", branch.scale, values) if branch.scale else None
    return replace(branch, values=plain, curves=curves, scale=scale)


def _renewed(path: str, value: Value, values: Mapping[str, Value]) -> Value:
    # the number of a path, and its slope, rate or factors
    found = values.get(path, value)
    if found.over is None:
        return found
    inner = zip(found.over.endings, found.over.numbers, strict=True)
    return replace(
        found, over=replace(found.over, numbers=tuple(values.get(path + end, number) for end, number in inner))
    )


def _reweigh(joint: Joint, values: Mapping[str, Value]) -> Joint:
    return replace(
        joint, masses={k: _renewed(f"{joint.numbers}.{k}", value, values) for k, value in joint.masses.items()}
    )


def _replace_offset(name: str, ends: Ends, values: Mapping[str, Value]) -> Ends:
    if ends.offset is None:
        return ends
    return replace(ends, offset=_renewed(f"{ends.shares or name}.offset", ends.offset, values))


def _recurve(path: str, curve: Characteristic, values: Mapping[str, Value]) -> Characteristic:
    paths = [slot.path for slot in _curve_slots(path, curve)]
    return replace(curve, values=tuple(_renewed(p, v, values) for p, v in zip(paths, curve.values, strict=True)))
