"""From the text of a study to its declaration; all mistakes are told at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from dashpot.contract.bench import option_text
from dashpot.contract.chain import make_optimizer, read_optimizer_options
from dashpot.contract.registry import Registry
from dashpot.fit.refine import OWN_METHOD
from dashpot.fit.study.declaration import DataSource, ModelPlan, SearchStage, Stage, StudySpec, TakeStage
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import read_network
from dashpot.model.shipped import SUFFIXES, read_specification, spec_folder
from dashpot.text.document import Document
from dashpot.text.form import Form, read_choice, read_items, read_number, read_text
from dashpot.text.node import Node, Scalar
from dashpot.text.problem import InputError, Place, Problem, nearest

FORMAT = "dashpot-study/1"
BUDGET = 20_000
TAKEN = ("curves", "ends")
STAGE_RUNS = ("dynamic", "slow", "all")


def shipped_studies() -> dict[str, Path]:
    """The shipped studies by name."""
    return {path.stem: path for path in sorted((spec_folder() / "studies").glob("*.yaml"))}


def find_study(word: str) -> Path:
    """The file of a study given by path or by shipped name. InputError when there is none."""
    path, shipped = Path(word), shipped_studies()
    if path.suffix in SUFFIXES or path.is_file():
        return path
    if word in shipped:
        return shipped[word]
    hint = nearest(word, shipped) or f"shipped studies: {', '.join(shipped) or 'none'}"
    raise InputError.at(Place(word), "there is no such file and no shipped study of that name", hint)


def read_study(path: Path, registry: Registry) -> StudySpec:
    """The study in a file. InputError with all its mistakes and those of its networks.

    Examples:
        >>> from pathlib import Path
        >>> study = dp.read_study(Path("ladder.yaml"), dp.load_registry())
        >>> study.name, len(study.models)
        ('ladder', 1)
    """
    return parse_study(read_specification(path), path.parent, registry)


def parse_study(document: Document, folder: Path, registry: Registry) -> StudySpec:
    """The study that a text declares; paths in it are relative to ``folder``."""
    problems: list[Problem] = []
    form = Form(document.root, problems, "the study")
    form.choice("format", (FORMAT,))
    reader = _Reader(form, folder, registry, problems)
    name = form.name("name")
    study = StudySpec(
        name=name or "",
        about=form.text("about", ""),
        data=reader.data(),
        models=reader.models(),
        seed=form.integer("seed", 0),
        hold_out=read_patterns(form, "hold_out", None),
        weights=form.take("weights", _read_weights, {}),
        amplitude=form.quantity("amplitude", "m", None),
        bootstrap=form.integer("bootstrap", 0),
        profiles=read_patterns(form, "profiles", ()),
        text=document.text,
    )
    form.close()
    if problems:
        raise InputError(problems)
    return study


class _Reader:
    """Reads what a study's models share: where files are, which plugins there are, default stages and budget."""

    def __init__(self, form: Form, folder: Path, registry: Registry, problems: list[Problem]) -> None:
        self._form, self._folder, self._registry, self._problems = form, folder, registry, problems
        self._budget = form.integer("budget", BUDGET) or BUDGET
        self._stages = self._read_stages(form, ())

    def data(self) -> DataSource:
        """A path, or a specimen with its seed."""
        node = self._form.node("data")
        if node is None or isinstance(node, Scalar):
            text = self._form.text("data")
            return DataSource(self._folder / text if text else None)
        form = self._form.form("data")
        specimen = form.choice("specimen", tuple(self._registry.specimens)) if form else None
        seed = form.integer("seed", 0) if form else 0
        if form:
            form.close()
        return DataSource(specimen=specimen or "", seed=seed)

    def models(self) -> tuple[ModelPlan, ...]:
        """The models in the order of the file, each after the one it starts from."""
        plans: list[ModelPlan] = []
        for node in self._form.take("models", _read_models) or ():
            plan = self._model(node, [plan.name for plan in plans])
            if plan:
                plans.append(plan)
        return tuple(plans)

    def _model(self, node: Node, before: list[str]) -> ModelPlan | None:
        if isinstance(node, Scalar):
            network = self._network(read_text(node), node.place)
            return self._new(ModelPlan(network, self._stages) if network else None, before, node.place)
        form = Form(node, self._problems, "the model")
        word = form.text("network")
        start_from = form.choice("start_from", before, None)
        stages = self._read_stages(form, self._stages)
        runs = read_patterns(form, "runs", ("*",))
        parts = form.take("parts", lambda below: _read_parts(below, before), {})
        form.close()
        network = self._network(word, form.place_of("network")) if word else None
        plan = ModelPlan(network, stages, start_from, runs, parts) if network else None
        return self._new(plan, before, node.place)

    def _new(self, plan: ModelPlan | None, before: list[str], place: Place) -> ModelPlan | None:
        if plan is None:
            return None
        if plan.name in before:
            self._problems.append(Problem(place, f"two models are called '{plan.name}'", "give one another name"))
        if not plan.stages:
            self._problems.append(Problem(place, f"the model '{plan.name}' has no stages", "list some under 'stages'"))
        return plan

    def _network(self, word: str, place: Place) -> NetworkSpec | None:
        return network_beside(word, place, self._folder, self._registry, self._problems)

    def _read_stages(self, form: Form, default: tuple[Stage, ...]) -> tuple[Stage, ...]:
        if "stages" not in form:
            return default
        return tuple(stage for below in form.forms("stages") or () if (stage := self._stage(below)))

    def _stage(self, form: Form) -> Stage | None:
        name = form.name("name")
        if "take" in form:
            take: Any = form.choice("take", TAKEN)
            form.close()
            return TakeStage(name, take) if name and take else None
        optimizer = form.text("optimizer", OWN_METHOD)
        runs: Any = form.choice("runs", STAGE_RUNS, "all")
        stage = SearchStage(
            name=name or "",
            free=read_patterns(form, "free", ("*",)),
            fixed=read_patterns(form, "fixed", ()),
            runs=runs,
            optimizer=optimizer,
            options=self._options(form, optimizer),
            budget=_at_least_one(form, "budget", self._budget),
            starts=_at_least_one(form, "starts", 1),
        )
        form.close()
        return stage if name else None

    def _options(self, form: Form, optimizer: str) -> Mapping[str, Any]:
        texts = form.take("options", _read_option_texts, {})
        if optimizer == OWN_METHOD:
            if texts:
                form.complain("options", f"{OWN_METHOD} has no options")
            return {}
        try:
            options = read_optimizer_options(optimizer, self._registry.optimizers, texts or {})
            make_optimizer(optimizer, self._registry.optimizers, options)
        except ValueError as error:
            form.complain("optimizer", f"{form.what}: {error}")
            return {}
        return options


def network_beside(
    word: str, place: Place, folder: Path, registry: Registry, problems: list[Problem]
) -> NetworkSpec | None:
    """The shipped network of a name, or the one in a file of a folder; what is wrong with it is noted."""
    try:
        return read_network(folder / word if Path(word).suffix in SUFFIXES else word, registry.elements)
    except InputError as error:
        problems += [_placed(problem, word, place) for problem in error.problems]
        return None


def _placed(problem: Problem, word: str, place: Place) -> Problem:
    # what is wrong with a name is wrong in the study
    return problem if problem.place.line else replace(problem, place=place, message=f"'{word}': {problem.message}")


def _read_models(node: Node) -> tuple[Node, ...]:
    items = read_items(node)
    for item in items:
        if isinstance(item, Scalar):
            read_text(item)
    return items


def _at_least_one(form: Form, key: str, default: int) -> int:
    number = form.integer(key, default)
    if number is not None and number < 1:
        form.complain(key, f"{form.what}, '{key}': expected at least 1, got {number}")
    return number or default


def read_patterns(form: Form, key: str, default: Any) -> Any:
    """One pattern or a list of them, as a tuple."""

    def read(node: Node) -> tuple[str, ...]:
        return tuple(map(read_text, [node] if isinstance(node, Scalar) else read_items(node)))

    return form.take(key, read, default)


def _read_parts(node: Node, before: list[str]) -> dict[str, str]:
    return {branch: read_choice(model, before) for branch, model in _entries(node, "branch: model").items()}


def _read_weights(node: Node) -> dict[str, float]:
    weights = {name: read_number(value) for name, value in _entries(node, "run: weight").items()}
    if any(weight <= 0.0 for weight in weights.values()):
        raise ValueError("expected weights above 0; runs that should not count are held out")
    return weights


def _read_option_texts(node: Node) -> dict[str, str]:
    return {name: option_text(value) for name, value in _entries(node, "option: value").items()}


def _entries(node: Node, expected: str) -> Mapping[str, Node]:
    from dashpot.text.node import Mapping as MappingNode

    if not isinstance(node, MappingNode):
        raise ValueError(f"expected lines '{expected}', got {node.describe()}")
    return node.entries
