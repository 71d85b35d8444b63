"""Reading the branches of a network."""

from __future__ import annotations

import re
from collections.abc import Callable
from collections.abc import Mapping as MappingType
from dataclasses import replace
from typing import Literal

from dashpot.model.curves import read_curve, read_scale
from dashpot.model.element import Element
from dashpot.model.fixing import fixed_as_found
from dashpot.model.joints import read_ends, read_known
from dashpot.model.nesting import TooDeep, height, refuse_too_deep
from dashpot.model.network import Branch, Characteristic, Ends, Group, Joint, NetworkSpec, Value
from dashpot.model.values import ONLY, Copy, Reading, kind_of, read_value
from dashpot.text.form import Form
from dashpot.text.name import shown
from dashpot.text.problem import InputError, Problem, nearest

MAXIMUM_COPIES = 100
MAXIMUM_BRANCHES = 1000  # in a network, with those of the networks that it uses
NAME = re.compile(r"\w[\w+-]{0,119}")
WAYS = ("element", "series", "parallel", "use", "same_as")
FOR_ALL = ("repeat", "about", "scale")


class BranchReader:
    """Reads named branches and notes mistakes in ``problems``; ``use`` finds another network by the word for it.

    ``depth`` is in how many groups and networks all of them lie; ``use`` is told that of the branches it finds.
    ``ends`` gathers which ``joints`` every outermost branch connects, and ``used`` the texts of what was found.
    """

    def __init__(
        self,
        elements: MappingType[str, type[Element]],
        problems: list[Problem],
        use: Callable[[str, int], NetworkSpec],
        joints: MappingType[str, Joint],
        depth: int = 0,
    ) -> None:
        self.elements, self.problems, self.use, self.joints, self._depth = elements, problems, use, joints, depth
        self._count_of_branches, self._unsound = 0, set[str]()
        self.ends: dict[str, Ends] = {}
        self.used: dict[str, None] = {}

    def outermost(self, form: Form) -> tuple[Branch | Group, ...]:
        """The branches of the file."""
        found: list[Branch | Group] = []
        for name, entry in (form.named("branches") or {}).items():
            ends = read_ends(name, entry, self.joints)
            members = self._entry(name, entry, found, ONLY)
            found += members
            if ends and members:
                self._connect(members, ends, entry.text("same_as", ""))
        return tuple(found)

    def _connect(self, members: list[Branch | Group], ends: Ends, model: str) -> None:
        # a twin has the offset of its model unless it has one of its own; copies have that of the first one
        if model in self.ends and not ends.offset:
            ends = replace(self.ends[model], lower=ends.lower, upper=ends.upper)
            ends = replace(ends, shares=ends.shares or model) if ends.offset else ends
        first = members[0].name
        self.ends[first] = ends
        shares = ends.shares or (first if ends.offset else "")
        self.ends |= {member.name: replace(ends, shares=shares) for member in members[1:]}

    def members(self, form: Form, key: str, copy: Copy = ONLY) -> tuple[Branch | Group, ...]:
        """The branches named below a key."""
        found: list[Branch | Group] = []
        for name, entry in (form.named(key) or {}).items():
            found += self._entry(name, entry, found, copy)
        return tuple(found)

    def _entry(self, name: str, form: Form, above: list[Branch | Group], copy: Copy) -> list[Branch | Group]:
        if "same_as" in form:
            return self._twin(name, form, {member.name: member for member in above})
        return self._copies(name, form, copy)

    def _twin(self, name: str, form: Form, known: MappingType[str, Branch | Group]) -> list[Branch | Group]:
        self._refuse_name(name, form)
        form.text("about", "")
        word = form.take("same_as", lambda node: read_known(node, known, "branch"))
        form.close()
        return [_sharing(known[word], word, name)] if word else []

    def _refuse_name(self, name: str, form: Form) -> None:
        if not NAME.fullmatch(name) or name == "measurement":
            form.complain(
                None,
                f"expected a name of letters, digits, '_', '-' and '+' other than 'measurement', got {shown(name)}",
                "rename the branch",
            )

    def _copies(self, name: str, form: Form, outer: Copy) -> list[Branch | Group]:
        self._refuse_name(name, form)
        count = self._count(form, outer)
        first, found = len(self.problems), []
        for number in range(count):
            title = name if count == 1 else f"{name}_{number + 1}"
            member = self._single(title, form, Copy(number, count) if count > 1 else outer)
            if member:
                found.append(_named(member, title, name))
            # every copy would repeat the same complaints
            if len(self.problems) > first:
                break
        return found

    def _count(self, form: Form, outer: Copy) -> int:
        count = form.integer("repeat", 1)
        if not 1 <= count <= MAXIMUM_COPIES:
            form.complain("repeat", f"expected 1 to {MAXIMUM_COPIES} copies, got {count}")
            return 1
        if count > 1 and outer.of > 1:
            form.complain("repeat", "a branch inside a repeated group cannot be repeated again", "write its copies out")
            return 1
        return count

    def _single(self, name: str, form: Form, copy: Copy) -> Branch | Group | None:
        form.text("about", "")
        if "series" in form:
            return self._group(form, "series", copy)
        if "parallel" in form:
            return self._group(form, "parallel", copy)
        return self._used(form) if "use" in form else self._element(name, form, copy)

    def _group(self, form: Form, kind: Literal["series", "parallel"], copy: Copy) -> Group:
        first = len(self.problems)
        refuse_too_deep(self._depth + 1, form.key_place(kind))
        self._depth += 1
        members = self.members(form, kind, copy)
        self._depth -= 1
        if not members and len(self.problems) == first:
            form.complain(kind, "expected at least one branch, got none", "write it, or leave the group out")
        form.close()
        return Group("", kind, members, form.place)

    def _used(self, form: Form) -> Group | None:
        other = form.text("use")
        fixed = form.flag("fixed", False)
        if "fixed" in form and not fixed:
            form.complain(
                "fixed",
                "expected 'true': without the key its parameters are searched as it declares",
                "leave the key out",
            )
        form.close()
        try:
            spec = self._network(other, form) if other and self._count_of_branches <= MAXIMUM_BRANCHES else None
            if spec is None or not self._room_for(len(list(spec.leaves())), form):
                return None
            return Group("", "parallel", (fixed_as_found(spec) if fixed else spec).root.members, form.place)
        except TooDeep:
            raise
        except InputError as error:
            self._complain_of_use(other, form, error)
            return None

    def _network(self, word: str, form: Form) -> NetworkSpec:
        place = form.place_of("use")
        refuse_too_deep(self._depth + 1, place)
        spec = self.use(word, self._depth + 1)
        # it may have been read where it lay less deep
        refuse_too_deep(self._depth + height(spec.root), place)
        self.used |= dict.fromkeys(spec.texts)
        return spec

    def _room_for(self, count: int, form: Form) -> bool:
        # told once: what is beyond the limit need not be counted
        self._count_of_branches, before = self._count_of_branches + count, self._count_of_branches
        if before <= MAXIMUM_BRANCHES < self._count_of_branches:
            form.complain(
                None,
                f"expected {MAXIMUM_BRANCHES} branches at most, with those of used networks, got more",
                "use fewer networks in each other",
            )
        return self._count_of_branches <= MAXIMUM_BRANCHES

    def _complain_of_use(self, other: str, form: Form, error: InputError) -> None:
        for problem in error.problems:
            if problem.place.line is None:
                form.complain("use", f"'{other}' cannot be used: {problem.message}", problem.hint)
        placed = [problem for problem in error.problems if problem.place.line is not None]
        if placed:
            form.complain("use", f"'{other}' cannot be used: it has mistakes of its own", "correct them there")
            self.problems.extend(placed if other not in self._unsound else [])
            self._unsound.add(other)

    def _element(self, name: str, form: Form, copy: Copy) -> Branch | None:
        if not self._room_for(1, form):
            return None
        word = form.text("element")
        law = self.elements.get(word)
        if law is None:
            self._complain_of_element(word, form)
            return None
        reading = Reading(name, self.problems, copy)
        values = {key: value for key in law.declares.parameters if (value := self._value(key, law, form, reading))}
        curves = {key: curve for key in law.declares.curves if (curve := self._curve(key, law, form, reading))}
        node = form.node("scale")
        scale = read_scale(node, reading.named(f"{name}.scale")) if node else None
        form.close()
        return Branch("", law, values, curves, scale, place=form.place)

    def _complain_of_element(self, word: str | None, form: Form) -> None:
        if word:
            names = ", ".join(sorted(self.elements)) or "none"
            known = nearest(word, self.elements) or f"install the plugin that gives it, or take one of: {names}"
            form.complain("element", f"there is no element '{word}'", known)
            return
        for key in form.rest:
            if hint := nearest(key, (*WAYS, *FOR_ALL)):
                self.problems.append(Problem(form.key_place(key), f"{form.what} has no key '{key}'", hint))

    def _value(self, key: str, law: type[Element], form: Form, reading: Reading) -> Value | None:
        parameter, node = law.declares.parameters[key], form.node(key)
        if node is not None:
            return read_value(node, kind_of(parameter), reading.named(f"{reading.what}.{key}"))
        if parameter.default is None:
            form.complain(
                None, f"'{reading.what}' lacks '{key}' ({parameter.about}, {parameter.unit})", f"add '{key}: ...'"
            )
        return None

    def _curve(self, key: str, law: type[Element], form: Form, reading: Reading) -> Characteristic | None:
        curve, node = law.declares.curves[key], form.node(key)
        if node is not None:
            return read_curve(node, curve, reading.named(f"{reading.what}.{key}"))
        form.complain(None, f"'{reading.what}' lacks '{key}' ({curve.about})", f"add '{key}: ...'")
        return None


def _named(member: Branch | Group, name: str, family: str) -> Branch | Group:
    # a member that was read has no name yet, one from a group or another network is called by its path
    if isinstance(member, Branch):
        shares = _join(name, member.shares) if member.shares else ""
        return replace(member, name=_join(name, member.name), family=_join(family, member.family), shares=shares)
    members = tuple(_named(inner, name, family) for inner in member.members)
    return replace(member, name=_join(name, member.name), members=members)


def _join(*names: str) -> str:
    return ".".join(name for name in names if name)


def _sharing(member: Branch | Group, name: str, twin: str) -> Branch | Group:
    # the same part once more, under another name, with the parameters of the first
    renamed = twin + member.name.removeprefix(name)
    if isinstance(member, Branch):
        return replace(member, name=renamed, family=renamed, shares=member.numbers)
    return replace(member, name=renamed, members=tuple(_sharing(inner, name, twin) for inner in member.members))
