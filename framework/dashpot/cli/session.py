"""What every verb needs: the plugins, what was named on the command line, the result folder and the progress."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, nullcontext
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from dashpot.cli.output import OutputFolder
from dashpot.cli.progress import ProgressBar
from dashpot.cli.switches import Switches
from dashpot.cli.talk import Talk

if TYPE_CHECKING:
    from dashpot.contract.reader import Reader
    from dashpot.contract.registry import Registry
    from dashpot.data.dataset import Dataset
    from dashpot.data.stream import RunStream
    from dashpot.kernel.workers import Jobs
    from dashpot.model.network import NetworkSpec
    from dashpot.text.problem import Problem

Result = TypeVar("Result")
PDF_FILES = ("report.pdf", "summary.pdf")


class Session:
    """One call of a verb. Opening it loads the plugins; those set aside are mentioned in one line."""

    def __init__(self, switches: Switches, optimizer: str | None = None, settings: Iterable[str] = ()) -> None:
        from dashpot.contract.registry import load_registry

        self.switches = switches
        self.talk = Talk(switches)
        self.registry = load_registry()
        if self.registry.faults:
            names = sorted({str(fault.origin) for fault in self.registry.faults})
            self.talk.warn(f"set aside, at least in part: plugin {', '.join(names)}. `dashpot list plugins` says why")
        self.optimizer = optimizer
        self.options = read_options_of(optimizer, settings, self.registry)

    def network(self, spec: str) -> NetworkSpec:
        """The network of a file or of a shipped name."""
        from dashpot.model.reading import read_network
        from dashpot.text.problem import InputError, Place

        try:
            return read_network(spec, self.registry.elements)
        except InputError:
            if spec in self.registry.elements:
                raise InputError.at(
                    Place(spec),
                    "expected a network, got the name of an element",
                    "`dashpot list models` lists networks",
                ) from None
            if self._is_data(Path(spec)):
                raise InputError.at(
                    Place(spec), "expected a network, got measured data", "the models stand first: MODEL... DATASET"
                ) from None
            raise

    def _is_data(self, path: Path) -> bool:
        """Whether a path that is no network is a dataset, or ends as a measured file does."""
        from dashpot.data.description import is_dataset

        endings = {ending for reader in self.registry.formats.values() for ending in reader.suffixes}
        return path.suffix in endings or is_dataset(path)

    def readers(self) -> dict[str, Reader]:
        """The readers of measured files by their word."""
        return {word: reader() for word, reader in self.registry.formats.items()}

    def dataset(self, path: str | Path) -> Dataset:
        """The dataset at ``path``; what is wrong with single runs is warned of."""
        from dashpot.data.dataset import read_dataset

        refuse_network(path)
        with self.watch(f"reading {path}"):
            dataset = read_dataset(path, self.readers(), self.switches.allow_outside)
        self.warn_of(dataset.problems)
        return dataset

    def sound_dataset(self, path: str | Path) -> Dataset:
        """The dataset at ``path`` as triage leaves it; what is wrong with runs, and what was done, is warned of."""
        from dashpot.triage.examine import examined

        dataset = self.dataset(path)
        with self.watch("looking for faults of the measurement"):
            sound = examined(dataset)
        self.warn_of(sound.problems[len(dataset.problems) :])
        return sound

    def runs(self, path: str | Path) -> RunStream:
        """The runs of the dataset at ``path`` one at a time; ``warn_of`` its problems when they were read."""
        from dashpot.data.stream import open_dataset

        refuse_network(path)
        return open_dataset(path, self.readers(), self.switches.allow_outside)

    def warn_of(self, problems: Iterable[Problem]) -> None:
        """Tell what is wrong with single runs."""
        from dashpot.text.problem import problem_lines

        for line in problem_lines(problems):
            self.talk.warn(line)

    def claim(self, output: Path, *patterns: str) -> OutputFolder:
        """The folder ``output``, into which files of these names may be written, by this call alone until it ends."""
        if self.switches.pdf:
            from dashpot.report.pdf import find_browser

            find_browser()
            patterns = (*patterns, *PDF_FILES)
        folder = OutputFolder(output, self.switches.force)
        click.get_current_context().with_resource(folder.locked())
        folder.claim(*patterns)
        return folder

    def claim_beside(self, file: Path, *others: str) -> OutputFolder:
        """The folder of ``file``, which may be written, as may files of other names, while other calls write theirs."""
        folder = OutputFolder(file.parent, self.switches.force)
        folder.claim(escape(file.name), *others)
        return folder

    def watch(self, what: str, parts: int = 1) -> ProgressBar:
        """The progress of what is done in a ``with`` block; ``what`` says it as long as nobody else does."""
        return ProgressBar(self.switches.quiet, parts, what)

    def tell_report(self, report: Path) -> None:
        """Tell where a report is and how large, and print it where that was asked for."""
        self.talk.say(f"report: {report} ({_size(report.stat().st_size)})")
        if self.switches.pdf:
            from dashpot.report.pdf import SUMMARY, print_report

            for name, part in zip(PDF_FILES, ("", SUMMARY), strict=True):
                with self.watch(f"printing {name}"):
                    printed = print_report(report, report.with_name(name), part)
                self.talk.say(f"printed: {printed}")

    @contextmanager
    def workers(self, memory: float | None = None, parts: int = 1) -> Iterator[Jobs]:
        """Who does the work: threads of this process, or the workers of ``--scheduler``, a piece in ``memory`` bytes.

        Several ``parts`` that do not need each other are done by processes. InputError where no such scheduler answers.
        """
        if self.switches.scheduler is None:
            from dashpot.kernel.workers import processes

            count = min(self.switches.jobs, parts)
            with processes(count) if count > 1 else nullcontext(self.switches.jobs) as jobs:
                yield jobs
            return
        from dashpot.campaign.scheduler import scheduled

        with ExitStack() as open_until_the_end:
            with self.watch("looking for workers"):
                client = open_until_the_end.enter_context(scheduled(self.switches.scheduler, memory))
            yield client

    def run(self, work: Callable[..., Result], subject: Any, dataset: Dataset) -> Result:
        """Do the work of a verb on a network (or several) and a dataset, showing its progress.

        Several networks are fitted in copies of this process; where it cannot be copied, in processes of their own.
        """
        from dashpot.kernel.workers import forks

        parts = len(subject) if isinstance(subject, list) else 1
        apart = 1 if forks(self.switches.jobs, parts) > 1 else parts
        with self.workers(parts=apart) as jobs, self.watch("compiling", parts) as progress:
            return work(
                subject,
                dataset,
                optimizer=self.optimizer,
                options=self.options,
                seed=self.switches.seed,
                jobs=jobs,
                registry=self.registry,
                progress=progress,
            )


def refuse_network(path: str | Path) -> None:
    """InputError for the name of a shipped network where a dataset is wanted."""
    from dashpot.model.shipped import shipped_networks
    from dashpot.text.problem import InputError, Place

    if str(path) in shipped_networks() and not Path(path).exists():
        raise InputError.at(
            Place(str(path)),
            "expected a dataset, got the name of a network",
            "the dataset stands last: MODEL... DATASET",
        )


def read_options_of(optimizer: str | None, settings: Iterable[str], registry: Registry) -> dict[str, Any]:
    """The options given with ``--set`` in the types of the optimizer; click.UsageError if they do not fit it."""
    from dashpot.contract.chain import make_optimizer, read_optimizer_options

    texts = dict(split_setting(setting) for setting in settings)
    if optimizer is None:
        if texts:
            raise click.UsageError("--set gives an option of an optimizer: name it with --optimizer")
        return {}
    try:
        options = read_optimizer_options(optimizer, registry.optimizers, texts)
        make_optimizer(optimizer, registry.optimizers, options)
    except ValueError as error:
        raise click.UsageError(str(error)) from error
    return options


def split_setting(setting: str, option: str = "--set") -> tuple[str, str]:
    """Key and value of ``--set KEY=VALUE``; click.UsageError for anything else."""
    key, equals, value = setting.partition("=")
    if not (key and equals):
        raise click.UsageError(f"{option} expected KEY=VALUE, got '{setting}'")
    return key.strip(), value.strip()


def _size(count: int) -> str:
    """The bytes of a file as people say them."""
    return f"{count / 1e6:.1f} MB" if count >= 1e5 else f"{max(count / 1e3, 1.0):.0f} kB"
