"""The command in this process, on plugins of our choice."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import MappingProxyType, SimpleNamespace

import pytest

from dashpot.cli import main
from dashpot.contract import registry as registry_module
from dashpot.contract.origin import Origin, PluginFault
from dashpot.contract.registry import Registry
from dashpot.model.identified import Identified
from dashpot.model.network import Group, NetworkSpec
from dashpot.text.document import Document
from dashpot.text.problem import Place, Problem


class Method:
    """A method with an option."""

    @classmethod
    def missing(cls) -> str:
        return ""

    def __init__(self, particles: int = 96) -> None:
        if particles < 2:
            raise ValueError(f"particles: expected at least 2, got {particles}")


BUILT_IN = Origin("elements", "dashpot", "9.9")
FOREIGN = Origin("strange", "dashpot-strange", "0.3")


@pytest.fixture
def registry(monkeypatch: pytest.MonkeyPatch) -> Registry:
    """A registry with one optimizer and one faulty plugin."""
    empty = MappingProxyType({})
    made = Registry(
        elements=empty,
        optimizers={"swarm": Method},
        formats=empty,
        causes=empty,
        specimens=empty,
        rigs=empty,
        exports=empty,
        metrics=empty,
        origins={("optimizers", "swarm"): BUILT_IN},
        plugins=(BUILT_IN, FOREIGN),
        faults=(PluginFault(FOREIGN, "cannot be loaded: ImportError: no"), PluginFault(FOREIGN, "gave 7")),
    )
    monkeypatch.setattr(registry_module, "load_registry", lambda: made)
    return made


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """``call("list", "elements")`` gives exit code, standard output, standard error."""

    def run(*arguments: str) -> tuple[int, str, str]:
        code = main(list(map(str, arguments)))
        return code, *capsys.readouterr()

    return run


class FakeResult:
    """What a fit, a comparison or a diagnosis gives, without the work."""

    extended_name = "spring+more.yaml"
    extended_text = "name: extended\n"
    fitted_name = "spring.yaml"
    fitted_text = "name: fitted\n"
    corrected_name = None
    remarks: tuple[str, ...] = ()
    identified_text = "name: identified\n"
    model = final = declared = fitted = NetworkSpec(
        "spring", Group("", "parallel", ()), document=Document.parse("a: 1")
    )
    fits = ()
    posterior = None
    dataset = SimpleNamespace(runs=())
    setting = SimpleNamespace(dataset=dataset)

    def as_dict(self) -> dict:
        """The smallest content that satisfies both pages."""
        rmse = {"train": 1.0, "held_out": 2.0, "all": 1.5}
        model = {"name": "spring", "parameters": {}, "rmse": rmse, "nrmse": rmse, "per_run": {}, "status": "ok"}
        return {
            "dataset": {"name": "bench", "digest": "0"},
            "model": {"name": "spring", "digest": "0"},
            "noise_floor": {"value": 0.5, "from": "repeats"},
            "models": [model],
            "verdict": "unexplained",
            "rmse": {"before": rmse, "after": rmse, **rmse},
            "held_out": [],
            "per_run": {},
            "parameters": {},
            "optimizer": "swarm",
            "evaluations": 7,
            "ending": "converged",
            "spread": [],
            "at_bound": [],
            "without_influence": [],
            "misfit": [],
            "causes": [],
            "extended_model": None,
        }

    def datasets(self, folder: Path) -> dict[str, str]:
        """No run is corrected."""
        return {}

    def evidence(self) -> dict:
        """Nothing beside."""
        return {}

    def summary(self) -> str:
        """A line for the terminal."""
        return "identified"


@pytest.fixture
def fake_result() -> type[FakeResult]:
    """The class of every result that the replaced layers give."""
    return FakeResult


@pytest.fixture
def layers(monkeypatch: pytest.MonkeyPatch, registry: Registry) -> list[dict]:
    """The layers below replaced by ones that do nothing; the list tells what they were asked to do."""
    asked: list[dict] = []

    def work(name: str) -> Callable[..., FakeResult]:
        def done(subject: object, dataset: object, **keywords: object) -> FakeResult:
            asked.append({"work": name, "subject": subject, "dataset": dataset, **keywords})
            return FakeResult()

        return done

    dataset = SimpleNamespace(problems=(Problem(Place("a.csv"), "set aside"),), runs=())

    def read(name, elements):
        return SimpleNamespace(name=name, identified=Identified(), slots=tuple)

    replaced = {
        "dashpot.model.reading": {"read_network": read},
        "dashpot.data.dataset": {"read_dataset": lambda path, readers, allow_outside: dataset},
        "dashpot.kernel.compiler.trace": {"trace_network": lambda network: ()},
        "dashpot.triage.examine": {"examined": lambda dataset: dataset},
        "dashpot.fit.api": {"fit_network": work("fit")},
        "dashpot.compare.comparison": {"compare": work("compare"), "comparison_of": lambda fit: fit},
        "dashpot.diagnose.diagnose": {"diagnose": work("diagnose")},
    }
    import_module("dashpot.report.networks")  # what writes reports needs the layers as they are
    for module, names in replaced.items():
        monkeypatch.setitem(sys.modules, module, SimpleNamespace(**names))
    verb = import_module("dashpot.cli.diagnose")
    monkeypatch.setattr(verb, "checked", lambda diagnosis, folder, registry: "check: as told")
    return asked
