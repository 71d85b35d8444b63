"""The tables of a PEtab problem: parameters, observables, conditions, measurements.

PEtab (Schmiester et al., PLOS Computational Biology 17 (2021) e1008646) describes parameter estimation problems in
tables, version 1. The model itself stays a network file.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from dashpot.contract.export import Export
from dashpot.contract.registry import load_registry
from dashpot.data.dataset import Dataset, read_dataset
from dashpot.data.run import Run
from dashpot.model.network import NetworkSpec, Slot, Value
from dashpot.text.problem import InputError, Place

if TYPE_CHECKING:
    from dashpot.fit.api import Setting

Row = Mapping[str, Any]

MEASURED = ("force", "displacement")
PARAMETERS = (
    "parameterId",
    "parameterName",
    "parameterScale",
    "lowerBound",
    "upperBound",
    "nominalValue",
    "estimate",
    "objectivePriorType",
    "objectivePriorParameters",
)
PROBLEM = """\
# The tables are those of PEtab 1, numbers in SI. The model is the network {name}.yaml of dashpot; PEtab expects SBML.
format_version: 1
parameter_file: parameters.tsv
problems:
  - sbml_files: []
    condition_files: [conditions.tsv]
    observable_files: [observables.tsv]
    measurement_files: [measurements.tsv]
"""


class Petab(Export):
    """The tables of a PEtab problem (version 1), numbers in SI, with the network file as the model.

    Bounds, scales and priors of parameters map; an expression, a curve from data and the motion between samples stay in
    the network. Displacements stand among the measurements, as they drive the model.

    data: the dataset whose runs become conditions and measurements. noise: standard deviation of the force; by default
    the noise floor of the data, and where that is unknown a parameter `noise_force` to be estimated.
    """

    word = "petab"

    def __init__(self, data: str = "", noise: Annotated[float, "N"] = 0.0):
        if not (0.0 <= noise < np.inf):
            raise ValueError(f"noise: expected a standard deviation, got {noise:g} N")
        self.data, self.noise = data, noise

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``problem.yaml``, the four tables and the network file."""
        from dashpot.fit.api import prepare
        from dashpot.fit.ranges import natural_sizes, with_ranges
        from dashpot.kernel.settings import require_settings

        if not self.data:
            message = "expected the dataset whose runs are the measurements, got none"
            raise InputError.at(Place(network.file), message, "say --set data=my/dataset.yaml")
        readers = {word: reader() for word, reader in load_registry().formats.items()}
        setting = prepare(read_dataset(Path(self.data), readers))
        require_settings(network, {name: run.excitation.settings for name, run in setting.scored.items()})
        noise = self.noise or setting.floor.value
        channels = _channels(setting.dataset.runs, network)
        ranged = with_ranges(network, natural_sizes(setting.train))
        tables: dict[str, tuple[Sequence[str], Iterable[Row]]] = {
            "parameters": (PARAMETERS, [*parameter_rows(ranged), *_noise_rows(noise, setting)]),
            "observables": (("observableId", "observableFormula", "noiseFormula"), list(_observables(channels, noise))),
            "conditions": _conditions(network, setting.dataset),
            "measurements": (
                ("observableId", "simulationConditionId", "measurement", "time", "datasetId"),
                _measurements(setting, channels),
            ),
        }
        found = {f"{name}.tsv": _tsv(columns, rows) for name, (columns, rows) in tables.items()}
        problem = PROBLEM.format(name=network.name).encode()
        return {"problem.yaml": problem, f"{network.name}.yaml": network.text.encode(), **found}


def parameter_rows(network: NetworkSpec) -> list[dict[str, Any]]:
    """A row for every number of a network with bounds; those that follow from others or that runs give are left out."""
    ids = identifiers(slot.path for slot in network.slots())
    return [
        _parameter(slot, ids[slot.path])
        for slot in network.slots()
        if not slot.value.expression and not slot.value.setting
    ]


def identifiers(names: Iterable[str]) -> dict[str, str]:
    """For each name an identifier of letters, digits and underscores, different from all others."""
    found: dict[str, str] = {}
    for name in dict.fromkeys(names):
        word = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_")
        word = word if word[:1].isalpha() else f"n_{word}"
        number = 1
        while (free := word if number == 1 else f"{word}_{number}") in found.values():
            number += 1
        found[name] = free
    return found


def _parameter(slot: Slot, identifier: str) -> dict[str, Any]:
    value = slot.value
    row: dict[str, Any] = {
        "parameterId": identifier,
        "parameterName": slot.path,
        "parameterScale": "log" if value.scale == "log" and value.number > 0.0 else "lin",
        "nominalValue": repr(value.number),
        "estimate": int(value.searched),
    }
    if value.searched and value.bounds:
        row |= {"lowerBound": repr(value.bounds[0]), "upperBound": repr(value.bounds[1])}
    return row | (_prior(slot.path, value) if value.searched and value.prior else {})


def _prior(path: str, value: Value) -> dict[str, str]:
    prior = value.prior
    assert prior is not None
    if prior.law == "normal":
        return {
            "objectivePriorType": "normal",
            "objectivePriorParameters": f"{prior.middle!r};{prior.deviation!r}",
        }
    if value.scale != "log":
        raise InputError.at(
            value.node.place if value.node else Place(),
            f"the lognormal prior of '{path}' has no equal in PEtab, as it is searched on a linear scale: the density "
            "that PEtab calls logNormal has its largest value elsewhere",
            "write scale: log, or a normal prior",
        )
    middle = float(np.log(prior.middle))
    return {
        "objectivePriorType": "parameterScaleNormal",
        "objectivePriorParameters": f"{middle!r};{prior.deviation!r}",
    }


def _noise_rows(noise: float | None, setting: Setting) -> list[dict[str, Any]]:
    if noise:
        return []
    swing = setting.swing
    row = {"parameterId": "noise_force", "parameterName": "standard deviation of the force", "parameterScale": "log"}
    bounds = {"lowerBound": repr(1e-6 * swing), "upperBound": repr(swing), "nominalValue": repr(1e-2 * swing)}
    return [{**row, **bounds, "estimate": 1}]


def _observables(channels: Sequence[str], noise: float | None) -> Iterator[Row]:
    for channel, identifier in identifiers(channels).items():
        force = channel.startswith("force")
        yield {
            "observableId": f"measured_{identifier}",
            "observableFormula": identifier,
            "noiseFormula": (repr(noise) if noise else "noise_force") if force else "1",
        }


def _channels(runs: Sequence[Run], network: NetworkSpec) -> list[str]:
    """What is written of the runs: forces, motions, and the channels that numbers of the network follow."""
    overs = (slot.value.over for slot in network.slots())
    followed = {over.word for over in overs if over and over.channel}
    names = dict.fromkeys(name for run in runs for name in run.channels)
    return [name for name in names if name.partition("@")[0] in MEASURED or name in followed]


def _conditions(network: NetworkSpec, dataset: Dataset) -> tuple[tuple[str, ...], list[Row]]:
    """A row for each run, with a column for each setting that the network refers to."""
    given = (slot.value.setting for slot in network.slots())
    over = (slot.value.over.word for slot in network.slots() if slot.value.over and not slot.value.over.channel)
    words = [word for word in dict.fromkeys((*given, *over)) if word]
    ids = identifiers(words)
    names = identifiers(run.name for run in dataset.runs)
    rows: list[Row] = [
        {
            "conditionId": names[run.name],
            "conditionName": run.name,
            **{ids[word]: repr(run.settings[word]) for word in words if word in run.settings},
        }
        for run in dataset.runs
    ]
    return ("conditionId", "conditionName", *ids.values()), rows


def _measurements(setting: Setting, channels: Sequence[str]) -> Iterator[Row]:
    names = identifiers(run.name for run in setting.dataset.runs)
    written = identifiers(channels)
    for run in setting.dataset.runs:
        share = "held_out" if run.name in setting.split.held_out else "training"
        for channel, identifier in written.items():
            common = {"observableId": f"measured_{identifier}", "simulationConditionId": names[run.name]}
            for time, number in zip(run.time.tolist(), run.channels.get(channel, np.empty(0)).tolist(), strict=False):
                yield {**common, "measurement": repr(number), "time": repr(time), "datasetId": share}


def _tsv(columns: Sequence[str], rows: Iterable[Row]) -> bytes:
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, columns, delimiter="\t", lineterminator="\n", restval="")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue().encode()
