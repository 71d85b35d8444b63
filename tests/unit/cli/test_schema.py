"""A schema takes what the reader takes, and refuses what the reader refuses for its structure."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from architecture.source import manual
from seeds import seed_of

from dashpot.cli.schema import KINDS
from dashpot.contract.bench import read_bench
from dashpot.contract.registry import load_registry
from dashpot.data.description import read_description
from dashpot.data.source import Source
from dashpot.fit.study.reading import parse_study
from dashpot.model.element import Element, Parameter, Response
from dashpot.model.reading import build_network
from dashpot.model.schema import network_schema
from dashpot.model.shipped import spec_folder
from dashpot.study.sensitivity.reading import is_sensitivity, parse_sensitivity
from dashpot.text.document import Document
from dashpot.text.problem import InputError, Problem

MANUAL = manual()
REGISTRY = load_registry()
VALIDATORS = {kind: jsonschema.Draft7Validator(make(REGISTRY)) for kind, make in KINDS.items()}
STUDY = spec_folder() / "studies"
# what a reader says of a structure; all else (names that are not there, counts, ranges) takes more than a schema
STRUCTURE = re.compile(
    r"has no key|lacks '(?!column)|expected (a text|a finite number,|a whole number,|true or false|a list|"
    r"named entries|\[first, last\],|[^,]* as 'key: value'|lines '|some of)|'kind': expected one of|there is no element"
)


def problems_of(kind: str, content: Any) -> tuple[Problem, ...]:
    """What the reader of this kind of file says of a text."""
    document = Document.parse(json.dumps(content))
    try:
        if kind == "network":
            build_network(document, REGISTRY.elements)
        elif kind == "rig":
            read_bench(document, REGISTRY.rigs)
        elif kind == "study":
            parse_study(document, STUDY, REGISTRY)
        elif kind == "sensitivity":
            parse_sensitivity(document, STUDY, REGISTRY)
        else:
            many = isinstance(content, dict) and "runs" in content
            return read_description(document, Source(Path("x.yaml"), Path(), None if many else "x.csv")).problems
    except InputError as error:
        return error.problems
    return ()


def shipped() -> Iterator[Any]:
    files = {"network": ["networks/*/*.yaml", "studies/*/*.yaml"], "rig": ["rigs/*.yaml"], "study": ["studies/*.yaml"]}
    for folder, patterns in files.items():
        for path in sorted(path for pattern in patterns for path in spec_folder().glob(pattern)):
            document = Document.read(path)
            kind = "sensitivity" if is_sensitivity(document) else folder
            yield pytest.param(kind, document.root.plain(), id=f"{kind}-{path.stem}")


def documented() -> Iterator[Any]:
    for block in re.findall(r"```yaml\n(.*?)```", MANUAL, re.DOTALL):
        content = Document.parse(block).root.plain()
        if isinstance(content, dict) and "format" in content and content.get("name") != "wrong":
            kind = re.fullmatch(r"dashpot-(\w+)/1", content["format"])[1]
            yield pytest.param(kind, content, id=f"{kind}-{content['name']}".replace(" ", "_"))


ALONE = {
    "format": "dashpot-dataset/1",
    "kind": "harmonic",
    "sampling": "500 Hz",
    "channels": {"displacement": 1, "force": {"column": "F", "unit": "N"}, "force@hub": 3},
    "settings": {"tire": "205/55 R16", "start": 1},
    "rows": [1, None],
}
GOOD = [*shipped(), *documented(), pytest.param("dataset", ALONE, id="dataset-single")]
every_file = pytest.mark.parametrize("kind, content", GOOD)


@pytest.mark.parametrize("kind", KINDS)
def test_a_schema_is_one(kind):
    jsonschema.Draft7Validator.check_schema(VALIDATORS[kind].schema)


@every_file
def test_every_shipped_and_every_documented_file_is_valid(kind, content):
    assert [error.message for error in VALIDATORS[kind].iter_errors(content)] == []


def test_a_file_with_mistakes_is_not():
    [wrong] = [block for block in re.findall(r"```yaml\n(.*?)```", MANUAL, re.DOTALL) if "name: wrong\n" in block]
    told = [error.message for error in VALIDATORS["network"].iter_errors(Document.parse(wrong).root.plain())]
    assert any("'sprng' is not one of" in message for message in told)
    assert any("'stifness' was unexpected" in message for message in told)
    assert any("'stiffness' is a required property" in message for message in told)


VALUES = [None, True, 7, -1.5, "", "word", "3 mm", "1,5 mm", [], [1.5, 2.5], {}, {"zzz": 1}]


def places(content: Any, path: tuple = ()) -> Iterator[tuple]:
    """The paths of all parts of a content."""
    yield path
    inner = content.items() if isinstance(content, dict) else enumerate(content) if isinstance(content, list) else ()
    for key, value in inner:
        yield from places(value, (*path, key))


def at(content: Any, path: tuple) -> Any:
    for key in path:
        content = content[key]
    return content


def mutations(content: dict, rng: np.random.Generator, count: int) -> Iterator[tuple[str, dict]]:
    """The content with one change each: another value, a key more, less or misspelled."""
    # an unknown reader is told when its file is read, which a declaration alone does not do
    paths = [path for path in places(content) if path and path[-1] != "reader"]
    for _ in range(count):
        path = paths[rng.integers(len(paths))]
        changed = copy.deepcopy(content)
        parent, key = at(changed, path[:-1]), path[-1]
        how = rng.integers(4)
        if how == 0 or isinstance(parent, list):
            parent[key] = VALUES[rng.integers(len(VALUES))]
        elif how == 1:
            parent["zzz"] = VALUES[rng.integers(len(VALUES))]
        elif how == 2:
            del parent[key]
        else:
            parent[key + "x"] = parent.pop(key)
        yield f"{path} {how}: {json.dumps(at(changed, path[:-1]))[:300]}", changed


@every_file
def test_reader_and_schema_agree_about_mutated_files(kind, content):
    seed = seed_of("test_schema")
    print(f"seed {seed}")
    for what, changed in mutations(content, np.random.default_rng(seed), 12):
        problems = [problem for problem in problems_of(kind, changed) if problem.severity == "error"]
        refused = [error.message for error in VALIDATORS[kind].iter_errors(changed)]
        if refused:
            assert problems, f"the schema alone refuses {what}: {refused}"
        elif any(STRUCTURE.search(problem.message) for problem in problems):
            pytest.fail(f"the reader alone refuses {what}: {[str(problem) for problem in problems]}")


class Rubber(Element):
    """A law of somebody else's."""

    word = "rubber"
    softness = Parameter("m/N", "how soft it is")

    def step(self, x, z, p, dt) -> Response:
        return Response(x.new / p.softness)


@pytest.mark.parametrize("key, valid", [("softness", True), ("softnes", False)])
def test_elements_of_plugins_are_known_with_their_parameters(key, valid):
    schema = network_schema({**REGISTRY.elements, "rubber": Rubber})
    content = {"format": "dashpot-network/1", "name": "n", "branches": {"b": {"element": "rubber", key: "1 mm/N"}}}
    assert jsonschema.Draft7Validator(schema).is_valid(content) is valid
    told = schema["definitions"]["element"]["allOf"][-1]["then"]["properties"]["softness"]["description"]
    assert told == "how soft it is (m/N)"


@pytest.fixture
def schema_call(call: Callable) -> Callable:
    return lambda *arguments: call("schema", *arguments)


def test_one_schema_is_printed_and_all_are_written(schema_call, tmp_path):
    code, out, _ = schema_call("network")
    assert code == 0 and json.loads(out)["title"] == "dashpot network"
    assert schema_call("--all", "-o", tmp_path)[0] == 0
    assert {path.name for path in tmp_path.iterdir()} == {f"{kind}.schema.json" for kind in KINDS}
    assert json.loads((tmp_path / "network.schema.json").read_text()) == json.loads(out)


@pytest.mark.parametrize(
    "arguments, hint",
    [
        (["netwrk"], "No schema of 'netwrk', did you mean 'network'?"),
        ([], "Say either a kind (network, dataset, rig, study, sensitivity, joint, campaign) or --all"),
        (["--all"], "say -o FOLDER"),
    ],
)
def test_misuse_is_told(schema_call, arguments, hint):
    code, _, error = schema_call(*arguments)
    assert code == 2 and hint in error
