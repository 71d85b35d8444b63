"""Networks with parts that the same study has identified before."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.contract.registry import Registry
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import use_in_branch
from dashpot.model.reading import parse_network
from dashpot.text.document import Document


def with_parts(
    spec: NetworkSpec, parts: Mapping[str, str], texts: Mapping[str, str], registry: Registry
) -> NetworkSpec:
    """The network whose branches use the identified models of ``parts`` (branch -> model), given by their ``texts``.

    In its text they are called ``<model>.yaml``. Raises InputError for a branch that uses no network.
    """
    text = spec.text
    for branch, model in parts.items():
        text = use_in_branch(text, branch, f"{model}.yaml")
    beside = {f"{model}.yaml": Document.parse(texts[model], f"{model}.yaml") for model in parts.values()}
    return parse_network(text, registry.elements, spec.file, beside)
