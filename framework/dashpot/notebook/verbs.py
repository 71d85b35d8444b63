"""What one calls in a notebook. A model may be given by name, a dataset by its path."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dashpot.campaign.reading import read_campaign
from dashpot.campaign.run import run_campaign
from dashpot.compare.comparison import compare as compare_networks
from dashpot.compare.look import look as look_at
from dashpot.contract.bench import find_bench
from dashpot.contract.registry import Registry, load_registry
from dashpot.data.dataset import Dataset, read_dataset
from dashpot.data.writing import dataset_files
from dashpot.diagnose.diagnose import diagnose as diagnose_network
from dashpot.fit.api import Progress, fit_network
from dashpot.fit.posterior import STEPS
from dashpot.fit.prior import with_earlier
from dashpot.fit.result import FitResult
from dashpot.fit.virtual_test import virtual_test
from dashpot.kernel.api import TOLERANCE, forces_by_name, solve_runs
from dashpot.model.network import Group, NetworkSpec
from dashpot.model.reading import FORMAT, parse_network, read_network
from dashpot.notebook.beyond import warn_of_range
from dashpot.notebook.campaign import Campaign
from dashpot.notebook.comparison import Comparison
from dashpot.notebook.data import Data
from dashpot.notebook.diagnosis import Diagnosis
from dashpot.notebook.fit import Fit
from dashpot.notebook.look import Look
from dashpot.notebook.model import Model
from dashpot.notebook.progress import hearing
from dashpot.notebook.promoted import promoted
from dashpot.text.document import Document
from dashpot.text.problem import InputError, Place
from dashpot.text.written import flow
from dashpot.triage.examine import examined

if TYPE_CHECKING:
    import numpy as np

    from dashpot.kernel.workers import Jobs

AnyModel = NetworkSpec | str | Path
AnyData = Dataset | str | Path


def load(name: str | Path, *, registry: Registry | None = None) -> Model:
    """The network in a file, or the shipped one of that name. InputError with every mistake of the file.

    Examples:
        >>> model = dp.load("kelvin_voigt")
        >>> model.name, len(model.leaves())
        ('kelvin_voigt', 2)
    """
    return promoted(Model, read_network(name, (registry or load_registry()).elements))


def declare(text: str, *, registry: Registry | None = None) -> Model:
    """The network that a YAML text declares. InputError with every mistake of the text.

    Examples:
        >>> mount = dp.declare('''
        ... format: dashpot-network/1
        ... name: mount
        ... branches:
        ...   rubber: {element: spring, stiffness: 220 N/mm}
        ...   damping: {element: damper, damping: {start: 0.5 N*s/mm}}
        ... ''')
        >>> [slot.path for slot in mount.slots() if slot.value.searched]
        ['damping.damping']
    """
    return promoted(Model, parse_network(text, (registry or load_registry()).elements))


def Network(  # noqa: N802
    name: str,
    branches: Mapping[str, Mapping[str, Any]] | None = None,
    *,
    registry: Registry | None = None,
    **keys: Any,
) -> Model:
    """A network out of Python values: ``branches`` and ``keys`` (``about``, ``nodes``, ...) are those of a file.

    Branches can be added later, with ``add``. InputError with every mistake.

    Examples:
        >>> mount = dp.Network("mount", {"rubber": {"element": "spring", "stiffness": "220 N/mm"}})
        >>> mount.add("damping", "damper", damping={"start": "0.5 N*s/mm"})
        >>> mount["rubber"].stiffness *= 1.1
        >>> mount.save("built.yaml").name
        'built.yaml'
        >>> bool(np.isclose(dp.load("built.yaml")["rubber"].stiffness, 242e3))
        True
    """
    head = {"format": FORMAT, "name": name, **keys}
    lines = [*(f"{key}: {flow(value)}" for key, value in head.items()), "branches:"]
    text = "\n".join([*lines, *(f"  {flow(word)}: {flow(entry)}" for word, entry in (branches or {}).items())]) + "\n"
    if branches:
        return declare(text, registry=registry)
    return Model(name, Group("", "parallel", ()), document=Document.parse(text))


def load_dataset(path: str | Path, *, allow_outside: bool = False, registry: Registry | None = None) -> Data:
    """The dataset of a folder, of its ``dataset.yaml``, or of a single file with a sidecar.

    Runs with a fault are excluded and listed in ``problems``. ``allow_outside`` also reads files outside of the
    folder of the dataset. InputError when no run is left.

    Examples:
        >>> data = dp.load_dataset("mount")
        >>> len(data.runs), len(data.problems)
        (8, 0)
    """
    readers = {word: reader() for word, reader in (registry or load_registry()).formats.items()}
    return promoted(Data, read_dataset(path, readers, allow_outside))


def look(data: AnyData, *, seed: int = 0, registry: Registry | None = None) -> Look:
    """Look at measured runs before any model: their shapes, the work of their cycles, repeats, what is explainable.

    Examples:
        >>> seen = dp.look(data)
        >>> "Force over velocity at mid stroke" in seen.pictures
        True
    """
    return promoted(Look, look_at(_data(data, registry), seed, (registry or load_registry()).metrics.values()))


def simulate(
    model: AnyModel,
    data: AnyData,
    *,
    tolerance: float = TOLERANCE,
    refine: int | None = None,
    registry: Registry | None = None,
) -> dict[str, np.ndarray]:
    """The force (n,) in N along the motion of every run, as the load cell would show it, by the name of the run.

    A run with several driven nodes has an entry ``run@node`` for each. Where nodes are free to move, so many steps
    lie between two samples that the error of each force is at most the ``tolerance``, a share of its RMS; or, by hand,
    ``refine`` times as many as usual. A run beyond the range with which the model was identified gives a UserWarning.
    InputError for a model whose curves are not identified yet, and for a run that lacks a motion.

    Examples:
        >>> forces = dp.simulate("mount.yaml", data)
        >>> forces["a1_p2_up"].shape == data.run("a1_p2_up").force.shape
        True
    """
    runs, spec = _data(data, registry), _model(model, registry)
    found = forces_by_name(solve_runs(spec, runs, refine=refine, tolerance=tolerance))
    warn_of_range(spec, {run.name: run for run in runs.runs})
    return found


def measure(model: AnyModel, rig: str, *, seed: int = 0, registry: Registry | None = None, **options: object) -> Data:
    """The model on a virtual test rig: a test procedure with its options, or a bench, shipped or as a file.

    Options are texts as on the command line (``depth="20 mm"``). The same seed gives the same noise. A run beyond the
    range with which the model was identified gives a UserWarning. InputError for an unknown rig or a model whose
    curves are not identified yet, ValueError for options that do not fit.

    Examples:
        >>> loop = dp.measure("mount.yaml", "triangle", depth="2 mm", loops=1)
        >>> loop.runs[0].kind
        'quasi_static'
    """
    found, spec = registry or load_registry(), _model(model, registry)
    bench = find_bench(rig, found.rigs, {key: str(value) for key, value in options.items()})
    measured = Data(f"{spec.name} on {bench.name} (virtual)", tuple(virtual_test(spec, bench, seed)))
    warn_of_range(spec, {planned.name: planned.excitation() for planned in bench.runs()})
    return measured


def write_dataset(data: Dataset, folder: str | Path) -> Path:
    """Write the runs as CSV files with their ``dataset.yaml``; the path of the latter.

    Examples:
        >>> loop = dp.measure("mount.yaml", "triangle", depth="2 mm", loops=1)
        >>> path = dp.write_dataset(loop, "loop")
        >>> dp.load_dataset(path).name
        'mount on triangle (virtual)'
    """
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    for name, text in dataset_files(data.name, data.runs).items():
        (target / name).write_text(text, encoding="utf-8")
    return target / "dataset.yaml"


def fit(
    model: AnyModel,
    data: AnyData,
    *,
    optimizer: str | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 0,
    jobs: Jobs = 1,
    prior: AnyModel | None = None,
    sampler: str | None = None,
    sampler_steps: int = STEPS,
    registry: Registry | None = None,
    progress: Progress | bool = False,
    cancel: Callable[[], bool] | None = None,
) -> Fit:
    """Identify the free parameters of a model, with 95 % intervals. The same seed gives the same result.

    Runs with a fault of the measurement are corrected or left out first; ``fit.dataset.problems`` lists them. ``jobs``
    are threads, or a pool or cluster that does it: an Executor of ``concurrent.futures``, or a client of Dask.

    ``optimizer`` and its ``options`` as on the command line; without one the framework's own Gauss-Newton from several
    starts. The intervals of a ``prior``, identified on other data, become priors of the parameters of the same path.
    InputError for a model that does not compile, and for a prior from the same data or without a parameter in common.

    With ``sampler="emcee"`` (extra ``sampler``) ``fit.posterior`` has draws from the posterior, of ``sampler_steps``
    steps at most; it ends sooner where it has converged. InputError where emcee is not installed.

    ``progress=True`` shows a line that tells how far it is; a function is called with the stage, the share of it that
    is done, the best error so far and the noise floor in N, the last three None where there is nothing to tell.
    ``cancel`` is a function that is asked in between: where it answers True the work ends with ``Cancelled``.

    Examples:
        >>> fit = dp.fit("mount.yaml", data, seed=1)
        >>> print(fit.summary())
        mount: RMSE ... N on training runs, ... N on held-out runs
        ...
    """
    found = registry or load_registry()
    sound, network = examined(_data(data, found)), _model(model, found)
    if prior is not None:
        earlier = _model(prior, found)
        network = with_earlier(network, earlier, sound.digest, earlier.name)
    with hearing(progress, cancel) as hear:
        return _shown_fit(
            fit_network(
                network,
                sound,
                optimizer=optimizer,
                options=options,
                seed=seed,
                jobs=jobs,
                registry=found,
                progress=hear,
                sampler=sampler,
                sampler_steps=sampler_steps,
            )
        )


def compare(
    models: Sequence[AnyModel],
    data: AnyData,
    *,
    optimizer: str | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 0,
    jobs: Jobs = 1,
    registry: Registry | None = None,
    progress: Progress | bool = False,
    cancel: Callable[[], bool] | None = None,
) -> Comparison:
    """Fit every model on the same training runs and judge it on all runs, next to the noise floor.

    ``progress`` and ``cancel`` as in ``fit``.

    Examples:
        >>> comparison = dp.compare(["spring", "mount.yaml"], data)
        >>> spring, voigt = comparison.fits
        >>> voigt.errors.held_out < spring.errors.held_out
        True
    """
    found = registry or load_registry()
    sound = examined(_data(data, found))
    with hearing(progress, cancel) as hear:
        compared = compare_networks(
            [_model(model, found) for model in models],
            sound,
            optimizer=optimizer,
            options=options,
            seed=seed,
            jobs=jobs,
            registry=found,
            progress=hear,
        )
    return promoted(Comparison, compared, fits=tuple(map(_shown_fit, compared.fits)))


def diagnose(
    model: AnyModel,
    data: AnyData,
    *,
    optimizer: str | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 0,
    jobs: Jobs = 1,
    relevance: float = 1.5e-3,
    registry: Registry | None = None,
    progress: Progress | bool = False,
    cancel: Callable[[], bool] | None = None,
) -> Diagnosis:
    """What a model gets wrong, the cause by name, the extended model, and what it gains on held-out runs.

    Causes without which the training error grows by less than the share ``relevance`` are not named. ``progress`` and
    ``cancel`` as in ``fit``. InputError for a model that does not compile on these data.

    Examples:
        >>> diagnosis = dp.diagnose("mount.yaml", data)
        >>> diagnosis.headline.split()[0]
        'RMSE'
    """
    found = registry or load_registry()
    with hearing(progress, cancel) as hear:
        made = diagnose_network(
            _model(model, found),
            _data(data, found),
            optimizer=optimizer,
            options=options,
            seed=seed,
            jobs=jobs,
            registry=found,
            relevance=relevance,
            progress=hear,
        )
    return promoted(Diagnosis, made, fit=_shown_fit(made.fit))


def campaign(
    file: str | Path, *, jobs: Jobs = 1, checkpoint: str | Path | None = None, registry: Registry | None = None
) -> Campaign:
    """Do what a campaign file says with every specimen, and tell what they are as a population.

    ``jobs`` are threads for one job after the other, or who does jobs side by side: a client of Dask, or an Executor of
    ``concurrent.futures``. With a folder ``checkpoint`` the same call goes on after an interruption, to the same
    numbers. InputError with every mistake of the file.

    Examples:
        >>> from concurrent.futures import ThreadPoolExecutor
        >>> with ThreadPoolExecutor(2) as pool:
        ...     mounts = dp.campaign("mounts.yaml", jobs=pool)
        >>> len(mounts.outcomes), len(mounts.failures)
        (3, 0)
    """
    planned = read_campaign(Path(file), registry or load_registry())
    found = run_campaign(planned, jobs=jobs, checkpoint=Path(checkpoint) if checkpoint else None)
    return promoted(Campaign, found)


def _model(model: AnyModel, registry: Registry | None) -> NetworkSpec:
    # a result keeps the model as it is now, whatever becomes of it
    found = replace(model) if isinstance(model, NetworkSpec) else load(model, registry=registry)
    if not found.leaves():
        raise InputError.at(Place(found.file), f"the network '{found.name}' has no branch", "add one")
    return found


def _data(data: AnyData, registry: Registry | None) -> Dataset:
    return data if isinstance(data, Dataset) else load_dataset(data, registry=registry)


def _shown_fit(found: FitResult) -> Fit:
    return promoted(Fit, found, dataset=promoted(Data, found.dataset))
