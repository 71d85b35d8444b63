"""The blind benchmark as a command: ``python tests/blind/run.py --cases 60 --seed 7``.

Cases are drawn from seeds; the engine sees a folder, its verdict is recorded, only then the label is opened. Prints the
confusion matrix and the rates, with the seed that repeats them.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

sys.path.insert(0, str(Path(__file__).parent))

from reliability import diagram, reliability
from scenarios import SCENARIOS
from score import Outcome, print_table, summary
from textbook import RIGS, draw_textbook
from truth import KINDS_OF_BASE, Case, draw_case
from truth.design import further

from dashpot.campaign.scheduler import scheduled
from dashpot.kernel.workers import finished

if TYPE_CHECKING:
    from dashpot.contract.registry import Registry
    from dashpot.data.dataset import Dataset
    from dashpot.diagnose.diagnosis import Diagnosis
    from dashpot.fit.result import FitResult
    from dashpot.kernel.workers import Jobs
    from dashpot.model.network import NetworkSpec

FLAGS = ("sensors", "without", "follow", "double")
MOST_FURTHER = 3
NETWORKS = Path(__file__).parent / "networks"


@dataclass(frozen=True)
class Bench:
    """How cases are made and diagnosed.

    ``design``: which runs are driven; ``sensors``: the force channel errs within its data sheet; ``without``: the
    engine is robbed of the cause plugins that would name what is hidden; ``follow``: the runs that the engine asks for
    are driven on the same specimen, one after the other, and what it says then counts; ``double``: two effects are
    hidden; ``model``: the network that is diagnosed, where it is another than that of the specimen.
    """

    design: str = "full"
    model: str | None = None
    sensors: bool = False
    without: bool = False
    follow: bool = False
    double: bool = False
    jobs: int = 1

    def run(self, seed: int, base: str, kind: str | None = None, strength: float | None = None) -> Outcome:
        """Draw, diagnose, record the verdict, open the label."""
        if base in RIGS:
            case, robbed = self.textbook(seed, base, kind, strength), []
        else:
            if kind is None and (self.without or self.double):
                kind = "+".join(random.Random(seed).sample(KINDS_OF_BASE[base], 2 if self.double else 1))
            draw = partial(
                draw_case, seed, base, kind, strength, design=self.design, model=self.model, sensors=self.sensors
            )
            case, robbed = draw(), kind.split("+") if self.without and kind else []
        began, network = time.perf_counter(), self.model or base
        found = diagnose_folder(case.folder, network, self.jobs, robbed)
        seconds, before, more = time.perf_counter() - began, None, ()
        while self.follow and found.next_runs and len(more) < MOST_FURTHER:
            asked = next(iter(found.next_runs.values())).proposal
            more = (*more, further(asked.displacement, asked.dt, len(more) + 1))
            before = before or found.as_dict()
            found = diagnose_folder(draw(further=more).folder, network, self.jobs, robbed)
        verdict = found.as_dict()
        named = [cause["cause"] for cause in verdict["causes"] if cause["accepted"]]
        truth = case.label.open(json.dumps({"verdict": verdict["verdict"], "named": named}))
        return Outcome(seed, base, truth, verdict, seconds, self.without, before, self.oracle(seed, base))

    def oracle(self, seed: int, base: str) -> float | None:
        """The held-out error of a refit to the same runs with nothing hidden in them, where their channels err."""
        if not self.sensors or base == "axle":  # whose channels are exact
            return None
        twin = draw_case(seed, base, "null", design=self.design, sensors=True)
        return fit_folder(twin.folder, base, self.jobs).errors.held_out

    def textbook(self, seed: int, rig: str, kind: str | None, strength: float | None) -> Case:
        """A case of the second kind. ValueError for what only those of the first kind have."""
        if self.design != "full" or self.model or self.sensors or self.without or self.follow:
            raise ValueError(f"{rig}: expected no option but --kind, --strength and --double; take a base for others")
        return draw_textbook(seed, rig, kind, strength, double=self.double)


def diagnose_folder(folder: Path, base: str, jobs: int, without: list[str]) -> Diagnosis:
    """What the engine says of a dataset, from the network of a base, without the plugins of some causes."""
    from dashpot.diagnose.diagnose import diagnose

    spec, dataset, registry = _read(folder, base)
    registry = replace(registry, causes={word: c for word, c in registry.causes.items() if word not in without})
    return diagnose(spec, dataset, jobs=jobs, registry=registry)


def fit_folder(folder: Path, base: str, jobs: int) -> FitResult:
    """The network of a base identified on a dataset."""
    from dashpot.fit.api import fit_network

    spec, dataset, registry = _read(folder, base)
    return fit_network(spec, dataset, jobs=jobs, registry=registry)


def _read(folder: Path, base: str) -> tuple[NetworkSpec, Dataset, Registry]:
    from dashpot.contract.registry import load_registry
    from dashpot.data.dataset import read_dataset
    from dashpot.model.reading import read_network

    registry = load_registry()
    dataset = read_dataset(folder, {word: reader() for word, reader in registry.formats.items()})
    own = [path for path in (folder / "network.yaml", NETWORKS / f"{base}.yaml") if path.exists()]
    return read_network(own[0] if own else base, registry.elements), dataset, registry


def run_scenario(name: str, seed: int, turn: int, bench: Bench, strength: float | None = None) -> Outcome:
    """A case of a scenario, on the specimen whose turn it is."""
    scenario = SCENARIOS[name]
    base = scenario.specimens[turn % len(scenario.specimens)]
    bench = replace(bench, design=scenario.design, model=scenario.model)
    return replace(bench.run(seed, base, scenario.kind, strength), scenario=name)


def command_of(options: argparse.Namespace, seed: int, cases: int) -> str:
    """What repeats the cases of a run."""
    if options.scenario:
        names = " ".join(f"'{name}'" for name in options.scenario)
        strength = f" --strength {options.strength}" if options.strength is not None else ""
        return f"python tests/blind/run.py --cases {cases} --seed {seed}{strength} --scenario {names}"
    words = ["python tests/blind/run.py", f"--cases {cases}", f"--seed {seed}", f"--base {' '.join(options.base)}"]
    words += [f"--{key} {value}" for key in ("kind", "strength") if (value := getattr(options, key)) is not None]
    words += [f"--design {options.design}"] if options.design != "full" else []
    words += [f"--model {options.model}"] if options.model else []
    return " ".join(words + [f"--{flag}" for flag in FLAGS if getattr(options, flag)])


def main() -> None:
    """Run the cases that were asked for."""
    parser = parser_of_options()
    options = parser.parse_args()
    if options.scenario is not None:
        options.scenario = options.scenario or list(SCENARIOS)
        if options.design != "full" or options.model or options.kind or any(getattr(options, flag) for flag in FLAGS):
            parser.error(
                "--scenario: expected no option beside it but --cases, --seed, --strength, --jobs, --output "
                "and --diagram; a scenario has its own design, specimens and kinds"
            )
    first = int.from_bytes(os.urandom(4), "little") if options.seed is None else options.seed
    print(f"seed {first}: --seed {first} repeats this run")
    flags = {flag: getattr(options, flag) for flag in FLAGS}
    bench = Bench(options.design, options.model, **flags, jobs=1 if options.scheduler else options.jobs)
    with workers(options) as jobs:
        found: dict[int, Outcome] = {}
        for number, future in finished(case_of, (options, bench, first), range(options.cases), jobs):
            found[number] = future.result()
            print(found[number].line(), flush=True)
            keep(options, first, [found[k] for k in sorted(found)])
    print_table([found[k] for k in sorted(found)])


@contextmanager
def workers(options: argparse.Namespace) -> Iterator[Jobs]:
    """Who does the cases: this process one after the other, or a scheduler whose workers find this folder."""
    if options.scheduler is None:
        yield options.jobs
        return
    with scheduled(options.scheduler) as client:
        for everywhere in (client.run, client.run_on_scheduler):
            everywhere(find, str(Path(__file__).parent))
        yield client


def find(folder: str) -> None:
    """Let this process find the modules of a folder. By name, as a list that is sent elsewhere is a copy."""
    sys.path.insert(0, folder)


def case_of(shared: tuple[argparse.Namespace, Bench, int], number: int) -> Outcome:
    """The case whose turn it is."""
    options, bench, first = shared
    if options.scenario:
        turn, place = divmod(number, len(options.scenario))
        return run_scenario(options.scenario[place], first + number, turn, bench, options.strength)
    base = options.base[number % len(options.base)]
    return bench.run(first + number, base, options.kind, options.strength)


def keep(options: argparse.Namespace, first: int, outcomes: list[Outcome]) -> None:
    """Write the files that were asked for; what was done stays when the run is interrupted."""
    if options.output:
        kept = {"seed": first, "command": command_of(options, first, len(outcomes)), **summary(outcomes)}
        options.output.write_text(json.dumps(kept, indent=1) + "\n")
    if options.diagram:
        told = [one for outcome in outcomes if not outcome.without for one in outcome.told]
        options.diagram.write_text(diagram(reliability(told)))


def parser_of_options() -> argparse.ArgumentParser:
    """The options of the command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=30)
    parser.add_argument("--seed", type=int, default=None, help="repeats a run; drawn anew without it")
    parser.add_argument("--base", nargs="*", default=list(KINDS_OF_BASE), choices=[*KINDS_OF_BASE, *RIGS])
    parser.add_argument("--kind", default=None, help="a cause word, 'null', 'no_law', or words joined by '+'")
    parser.add_argument(
        "--strength", type=float, default=None, help="effect over noise; drawn from 0.1 to 10 without it"
    )
    parser.add_argument("--design", default="full")
    parser.add_argument("--model", default=None, help="the network that is diagnosed, other than that of the specimen")
    parser.add_argument(
        "--scenario", nargs="*", default=None, choices=list(SCENARIOS), help="designs in turn, all without a name"
    )
    parser.add_argument("--sensors", action="store_true", help="the force channel errs within its data sheet")
    parser.add_argument("--without", action="store_true", help="the engine lacks the plugin of what is hidden")
    parser.add_argument("--follow", action="store_true", help="drive the runs that the engine asks for, and ask again")
    parser.add_argument("--double", action="store_true", help="two effects are hidden, one up to ten times the other")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--scheduler", default=None, help="local:N, or the address of a Dask scheduler: cases at once")
    parser.add_argument("--output", type=Path, default=None, help="a JSON file for all outcomes")
    parser.add_argument("--diagram", type=Path, default=None, help="an SVG file for the reliability diagram")
    return parser


if __name__ == "__main__":
    main()
