"""From the text of a campaign to its declaration; all mistakes are told at once."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

from dashpot.campaign.declaration import VERBS, CampaignSpec, Measured, Verb
from dashpot.campaign.specimens import specimens_of_pattern, specimens_of_table, with_properties
from dashpot.contract.registry import Registry
from dashpot.fit.study.patterns import nameless
from dashpot.fit.study.reading import network_beside, read_patterns
from dashpot.model.network import NetworkSpec
from dashpot.text.document import Document
from dashpot.text.form import Form, read_choice, read_items, read_text
from dashpot.text.node import Node, Scalar
from dashpot.text.problem import InputError, Problem, nearest

FORMAT = "dashpot-campaign/1"
BATCH = "batch"
UNITS = {"B": 1.0, "kB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12, "KiB": 2.0**10, "MiB": 2.0**20, "GiB": 2.0**30}


def read_campaign(path: Path, registry: Registry) -> CampaignSpec:
    """The campaign in a file. InputError with all its mistakes, those of its networks and of its tables.

    Examples:
        >>> from pathlib import Path
        >>> campaign = dp.read_campaign(Path("mounts.yaml"), dp.load_registry())
        >>> [one.name for one in campaign.specimens]
        ['m01', 'm02', 'm03']
    """
    return parse_campaign(Document.read(path), path.parent, registry)


def parse_campaign(document: Document, folder: Path, registry: Registry) -> CampaignSpec:
    """The campaign that a text declares; paths in it are relative to ``folder``."""
    problems: list[Problem] = []
    form = Form(document.root, problems, "the campaign")
    form.choice("format", (FORMAT,))
    specimens = _specimens(form, folder, problems)
    batch = form.text("batch", BATCH)
    campaign = CampaignSpec(
        name=form.name("name") or "",
        about=form.text("about", ""),
        specimens=specimens,
        models=_models(form, folder, registry, problems),
        verbs=form.take("verbs", _read_verbs, ("fit",)),
        seed=form.integer("seed", 0),
        shared=read_patterns(form, "shared", ()),
        dependence=read_patterns(form, "dependence", tuple(_properties(specimens, batch))),
        batch=batch,
        memory=form.take("memory", _read_memory, None),
        reports=form.flag("reports", True),
    )
    _refuse_unknown(form, campaign)
    form.close()
    if problems:
        raise InputError(problems)
    return campaign


def _specimens(form: Form, folder: Path, problems: list[Problem]) -> tuple[Measured, ...]:
    """The rows of a table, or what a pattern names, with the properties of a table."""
    node = form.node("specimens")
    try:
        if node is None or isinstance(node, Scalar):
            table = form.text("specimens")
            return specimens_of_table(folder / table) if table else ()
        below = form.form("specimens", "the specimens")
        pattern, table = below.text("pattern"), below.text("table", "")
        below.close()
        found = specimens_of_pattern(pattern, folder, below.place_of("pattern")) if pattern else ()
        return with_properties(found, folder / table) if table and found else found
    except InputError as error:
        problems += error.problems
        return ()


def _models(form: Form, folder: Path, registry: Registry, problems: list[Problem]) -> tuple[NetworkSpec, ...]:
    nodes = form.take("models", read_items) or ()
    found = [network for node in nodes if (network := _model(node, folder, registry, problems))]
    twice = [name for name, count in Counter(network.name for network in found).items() if count > 1]
    if twice:
        form.complain("models", f"two models are called '{twice[0]}'", "give one another name")
    return tuple(found)


def _model(node: Node, folder: Path, registry: Registry, problems: list[Problem]) -> NetworkSpec | None:
    try:
        word = read_text(node)
    except ValueError as error:
        problems.append(Problem(node.place, f"the campaign, 'models': {error}"))
        return None
    return network_beside(word, node.place, folder, registry, problems)


def _read_verbs(node: Node) -> tuple[Verb, ...]:
    nodes = [node] if isinstance(node, Scalar) else read_items(node)
    asked: list[Any] = [read_choice(each, VERBS) for each in nodes]
    return tuple(dict.fromkeys(asked))


def _read_memory(node: Node) -> float:
    """Bytes from a text such as `2 GB`."""
    number, _, unit = read_text(node).strip().partition(" ")
    try:
        value = float(number) * UNITS[unit.strip() or "B"]
    except (ValueError, KeyError):
        raise ValueError(f"expected an amount of memory such as '2 GB', got {node.describe()}") from None
    if not value > 0.0:
        raise ValueError(f"expected an amount of memory above 0, got {node.describe()}")
    return value


def _properties(specimens: tuple[Measured, ...], batch: str) -> list[str]:
    return [name for name in dict.fromkeys(key for one in specimens for key in one.properties) if name != batch]


def _refuse_unknown(form: Form, campaign: CampaignSpec) -> None:
    known = [*_properties(campaign.specimens, campaign.batch), campaign.batch]
    for name in campaign.dependence:
        if name not in known:
            form.complain("dependence", f"no specimen has a property '{name}'", nearest(name, known))
    paths = {slot.path for model in campaign.models for slot in model.slots() if slot.value.searched}
    wrong = nameless(campaign.shared, [[path] for path in sorted(paths)]) if campaign.models else []
    if wrong:
        hint = nearest(wrong[0], paths) or f"searched parameters are: {', '.join(sorted(paths)[:12])}"
        form.complain("shared", f"expected a pattern of searched parameters, got '{wrong[0]}', which names none", hint)
