"""Parameters without influence, and indistinguishable ones: the rank of the measured signals over the parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from dashpot.model.element import Element
from dashpot.model.lint.law import Array, Law, stand_in
from dashpot.model.lint.outputs import Outputs
from dashpot.model.lint.response import draw_trials
from dashpot.model.network import Branch, NetworkSpec, Slot, Value, branch_slots
from dashpot.model.topology import Topology
from dashpot.text.problem import Place, Problem

FEWEST_TRIALS, TRIALS_PER_NUMBER = 48, 2
STEP = 1e-4  # relative, of a difference quotient
NONE, DEPENDENT, INVOLVED = 1e-6, 1e-5, 1e-3
# the ends of a range, and what is there without any motion
NOT_TRIED = tuple(f"measurement.force.{key}" for key in ("least", "largest", "hum."))
SPREAD = 0.3  # of the parameters at which structure is judged


def find_idle_and_confused(topology: Topology, spec: NetworkSpec) -> Iterator[Problem]:
    """Branches and free parameters without influence, and free parameters that compensate each other."""
    slots = searched_slots(spec)
    outputs, table = _sensitivities(topology, spec, slots, 0)
    idle = [
        edge.branch
        for k, edge in enumerate(topology.edges)
        if np.any(outputs.answers[k].stiffness) and not _is_rigid(edge.branch) and not _is_felt(outputs.share(k))
    ]
    for branch in idle:
        yield Problem(
            branch.place,
            f"nothing that can be measured depends on the branch '{branch.name}'",
            "connect it to a node that moves, or remove it",
            "warning",
        )
    names = {branch.numbers for branch in idle} | _awake_in_runs(spec)
    for slot, column in zip(slots, table.T, strict=True):
        if slot.path.rpartition(".")[0] not in names and not _is_felt(column):
            yield Problem(
                _place(slot),
                f"'{slot.path}' is free, but has no influence on the measured signals",
                "fix it at a value, or remove it",
                "warning",
            )
    groups = _dependencies(table)
    if groups:
        # what is so at other numbers as well is no accident
        also = _dependencies(_sensitivities(topology, spec, slots, 1)[1])
        yield from (_confusion([slots[k] for k in group]) for group in groups if group in also)


def find_equal_starts(topology: Topology) -> Iterator[Problem]:
    """Branches of one element in parallel whose numbers, which are to be found, are the same at the start."""
    known: dict[tuple[object, ...], Branch] = {}
    for edge in topology.edges:
        branch = edge.branch
        numbers = [(slot.path.removeprefix(branch.numbers), slot.value.number) for slot in branch_slots(branch)]
        searched = any(slot.value.searched for slot in branch_slots(branch))
        make = (branch.element, frozenset((edge.lower, edge.upper)), tuple(numbers), len(numbers) > 1 and searched)
        if make[-1] and make in known and not branch.shares:
            yield Problem(
                branch.place,
                f"'{known[make].name}' and '{branch.name}' are alike and in parallel: no "
                "gradient-based search can distinguish them",
                "give them different starts",
                "warning",
            )
        known.setdefault(make, branch)


def searched_slots(spec: NetworkSpec) -> tuple[Slot, ...]:
    """The parameters to be found that show in a small motion; two for a curve that is to come from data."""
    curves = set(spec.data_curves())
    own = [slot for slot in spec.slots() if slot.path.partition("[")[0] not in curves]
    bent = [
        slot
        for branch in spec.leaves()
        if not branch.shares
        for slot in branch_slots(stand_in(branch))
        if slot.path.partition("[")[0] in curves
    ]
    # what a number does over settings shows between runs only
    return tuple(
        slot
        for slot in (*own, *bent)
        if slot.value.searched and slot.of is None and not slot.path.startswith(NOT_TRIED)
    )


def _awake_in_runs(spec: NetworkSpec) -> set[str]:
    """Branches with a number that is zero until a run gives it: what acts with it alone shows in runs only."""
    return {
        slot.path.rpartition(".")[0]
        for slot in spec.slots()
        if slot.of is None and slot.value.number == 0.0 and (slot.value.setting or slot.value.over)
    }


def _is_rigid(branch: Branch) -> bool:
    """Whether a share more or less of the force changes nothing, as what is held does not move."""
    return branch.element.stops is not Element.stops


def _numbers(spec: NetworkSpec) -> dict[str, float]:
    known = {slot.path: slot.value.number for slot in spec.slots()}
    for branch in spec.leaves():
        known |= Law.of(branch).numbers
    return known


def _others(spec: NetworkSpec, seed: int) -> dict[str, float]:
    rng = np.random.default_rng(seed + 1)
    slots = searched_slots(spec)
    factors = np.exp(rng.uniform(-SPREAD, SPREAD, len(slots)))
    return {
        slot.path: _inside(slot.value, slot.value.number * factor) for slot, factor in zip(slots, factors, strict=True)
    }


def _inside(value: Value, number: float) -> float:
    low, high = value.bounds or value.sensible
    return float(np.clip(number, low, high))


def _sensitivities(topology: Topology, spec: NetworkSpec, slots: tuple[Slot, ...], seed: int) -> tuple[Outputs, Array]:
    trials = draw_trials(topology, max(FEWEST_TRIALS, TRIALS_PER_NUMBER * len(slots)))
    numbers = _numbers(spec) | _others(spec, seed)
    outputs = Outputs(spec, topology, trials, numbers | _following(spec, numbers))
    followers = tuple(spec.slots()[rule.slot] for rule in spec.derived.rules)
    steps = {slot.path: STEP * _size(slot, outputs) for slot in (*slots, *followers)}
    table = outputs.changes(steps) / STEP
    own, moved = table[:, : len(slots)], table[:, len(slots) :]
    return outputs, own + moved @ _pull(spec, outputs.numbers, slots, followers, steps)


def _following(spec: NetworkSpec, numbers: Mapping[str, float]) -> dict[str, float]:
    """The numbers that follow from others, by path."""
    slots = spec.slots()
    filled = spec.derived.fill(np.array([[numbers[slot.path] for slot in slots]]))[0]
    return {slots[rule.slot].path: float(filled[rule.slot]) for rule in spec.derived.rules}


def _pull(
    spec: NetworkSpec,
    numbers: Mapping[str, float],
    slots: tuple[Slot, ...],
    followers: tuple[Slot, ...],
    steps: Mapping[str, float],
) -> Array:
    """By how many steps of its own each follower (followers, slots) moves with a step of each slot."""
    found = np.zeros((len(followers), len(slots)))
    own = {slot.path for slot in spec.slots()} if followers else set()
    for column, slot in enumerate(slots):
        if slot.path in own:
            moved = _following(spec, {**numbers, slot.path: numbers[slot.path] + steps[slot.path]})
            found[:, column] = [(moved[other.path] - numbers[other.path]) / steps[other.path] for other in followers]
    return found


def _size(slot: Slot, outputs: Outputs) -> float:
    low, high = slot.value.bounds or slot.value.sensible
    room = high - low if np.isfinite(high - low) and slot.value.scale == "linear" else 1.0
    return abs(outputs.numbers[slot.path]) or room


def _is_felt(change: Array) -> bool:
    return bool(np.max(np.abs(change), initial=0.0) > NONE)


def _dependencies(table: Array) -> list[frozenset[int]]:
    """Each column that is a sum of multiples of others, with these others."""
    lengths = np.linalg.norm(table, axis=0)
    felt = np.flatnonzero(np.max(np.abs(table), axis=0) > NONE)
    if not felt.size:
        return []
    unit = table[:, felt] / lengths[felt]
    # no entry of the diagonal below is smaller than the least singular value
    if np.linalg.svd(unit, compute_uv=False)[-1] > DEPENDENT and felt.size <= table.shape[0]:
        return []
    from scipy.linalg import lstsq, qr

    triangle, order = qr(unit, mode="r", pivoting=True)
    rank = int(np.sum(np.abs(np.diag(triangle)) > DEPENDENT))
    kept, spare = order[:rank], order[rank:]
    shares = [lstsq(unit[:, kept], unit[:, column])[0] for column in spare]
    return [
        frozenset(int(felt[k]) for k in (column, *kept[np.abs(share) > INVOLVED]))
        for column, share in zip(spare, shares, strict=True)
    ]


def _confusion(slots: list[Slot]) -> Problem:
    last = max(slots, key=lambda slot: slot.value.place)
    names = list(dict.fromkeys(f"'{slot.path.partition('[')[0]}'" for slot in sorted(slots, key=lambda s: s.path)))
    listed = (
        f"{', '.join(names[:-1])} and {names[-1]} cannot be distinguished"
        if len(names) > 1
        else (f"the parameters of {names[0]} cannot be distinguished")
    )
    return Problem(
        _place(last),
        f"{listed}: they compensate each other",
        "fix one of them at a value, or remove a branch",
        "warning",
    )


def _place(slot: Slot) -> Place:
    return slot.value.node.place if slot.value.node else Place()
