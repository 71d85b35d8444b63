"""What a report shows of networks themselves: schematics, identified curves, and the force of each branch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from dashpot.data.dataset import Dataset
from dashpot.kernel.api import forces_by_name, solve_runs
from dashpot.model.network import Branch, Characteristic, Group, NetworkSpec
from dashpot.report.evidence import Evidence, IdentifiedCurve
from dashpot.report.schematic.svg import svg

Array = NDArray[np.float64]


def with_schematics(evidence: Mapping[str, Any], networks: Mapping[str, NetworkSpec]) -> Evidence:
    """The evidence with the schematics of networks, each under its title."""
    drawn = {title: svg(as_found(network)) for title, network in networks.items()}
    return cast("Evidence", {**evidence, "schematic": drawn})


def with_network(evidence: Mapping[str, Any], title: str, network: NetworkSpec, dataset: Dataset) -> Evidence:
    """The evidence with the schematic, the identified curves and the forces of the branches of the final network."""
    more = {"curves": identified_curves(network), "branches": branch_forces(network, dataset)}
    return with_schematics({**evidence, **more}, {title: network})


def as_found(network: NetworkSpec) -> NetworkSpec:
    """A fitted network whose numbers are no longer starts."""
    searched = {slot.path: slot.value.as_role("identified") for slot in network.slots() if slot.value.searched}
    return network.with_values(searched)


def identified_curves(network: NetworkSpec) -> dict[str, IdentifiedCurve]:
    """The tables of a network that were searched or taken from data, by path."""
    return {
        path: _curve(curve)
        for path, curve in network.curves().items()
        if curve.form == "table" and (curve.data or any(value.searched for value in curve.values))
    }


def branch_forces(network: NetworkSpec, dataset: Dataset) -> dict[str, dict[str, Array]]:
    """The force (n,) in N of every outermost branch in every run, by name; those of a network with two ends alone.

    Such branches act in parallel: their forces add up to that of the network before the load cell.
    """
    members = network.root.members
    if network.joints or len(members) < 2 or any(branch.shares for branch in network.leaves()):
        return {}
    return {member.name: _alone(network, member, dataset) for member in members}


def _alone(network: NetworkSpec, member: Branch | Group, dataset: Dataset) -> dict[str, Array]:
    alone = replace(network, root=Group("", "parallel", (member,)), measurement={})
    return forces_by_name(solve_runs(alone, dataset))


def _curve(curve: Characteristic) -> IdentifiedCurve:
    (over, over_unit), (told, unit) = curve.curve.over, curve.curve.value
    intervals = [value.interval or (np.nan, np.nan) for value in curve.values]
    low, high = np.array(intervals).T
    value = np.array([value.number for value in curve.values])
    return {
        "over": over,
        "over_unit": over_unit,
        "told": told,
        "unit": unit,
        "at": np.array(curve.at),
        "value": value,
        "low": low,
        "high": high,
    }
