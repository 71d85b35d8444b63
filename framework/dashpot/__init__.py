"""dashpot: rheological models as networks of small laws, fitted to measurements, with what is missing named.

In a notebook: ``load`` or ``declare`` a model, or build a ``Network``; ``load_dataset``, or make ``Data`` out of
arrays; ``look`` at it, then ``fit``, ``compare`` or ``diagnose``; all answers show themselves, and have ``plot``,
``table`` and ``to_pandas``. ``simulate`` and ``measure`` run a model, ``campaign`` fits or diagnoses many specimens.
Studies are ``read_study`` and ``run_study``; ``energy_balance`` follows the work that is put in.

Every dataset holds each ``Run``; whatever is wrong with an input is raised as ``InputError``.

Write a plugin with ``Element``, ``Optimizer``, ``Reader``, ``Cause``, ``Specimen``, ``Rig``, ``Export`` or ``Metric``
and mark its hook with ``hookimpl``; ``check_element`` tests an element.

Everything is imported on first use: ``import dashpot`` costs nothing.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

__version__ = "0.2.0"

if TYPE_CHECKING:
    from dashpot.campaign.reading import read_campaign as read_campaign
    from dashpot.contract.cause import Cause as Cause
    from dashpot.contract.cause import ChannelFault as ChannelFault
    from dashpot.contract.cause import Suspect as Suspect
    from dashpot.contract.cause import View as View
    from dashpot.contract.cause import added_branch as added_branch
    from dashpot.contract.export import Export as Export
    from dashpot.contract.hooks import hookimpl as hookimpl
    from dashpot.contract.metric import Metric as Metric
    from dashpot.contract.optimizer import Optimizer as Optimizer
    from dashpot.contract.optimizer import Search as Search
    from dashpot.contract.optimizer import Space as Space
    from dashpot.contract.reader import Reader as Reader
    from dashpot.contract.reader import ReadingError as ReadingError
    from dashpot.contract.reader import Table as Table
    from dashpot.contract.registry import load_registry as load_registry
    from dashpot.contract.rig import PlannedRun as PlannedRun
    from dashpot.contract.rig import PrescribedPath as PrescribedPath
    from dashpot.contract.rig import Rig as Rig
    from dashpot.contract.specimen import Specimen as Specimen
    from dashpot.data.correction import Correction as Correction
    from dashpot.data.run import Run as Run
    from dashpot.fit.study.reading import read_study as read_study
    from dashpot.fit.study.run import run_study as run_study
    from dashpot.kernel.energy import energy_balance as energy_balance
    from dashpot.model.element import Curve as Curve
    from dashpot.model.element import Element as Element
    from dashpot.model.element import Motion as Motion
    from dashpot.model.element import Parameter as Parameter
    from dashpot.model.element import Response as Response
    from dashpot.model.element import State as State
    from dashpot.model.picture import Parallel as Parallel
    from dashpot.model.picture import Series as Series
    from dashpot.model.picture import Symbol as Symbol
    from dashpot.notebook.campaign import Campaign as Campaign
    from dashpot.notebook.comparison import Comparison as Comparison
    from dashpot.notebook.data import Data as Data
    from dashpot.notebook.diagnosis import Diagnosis as Diagnosis
    from dashpot.notebook.estimator import Estimator as Estimator
    from dashpot.notebook.fit import Fit as Fit
    from dashpot.notebook.listing import Listing as Listing
    from dashpot.notebook.look import Look as Look
    from dashpot.notebook.model import Model as Model
    from dashpot.notebook.part import Part as Part
    from dashpot.notebook.progress import Cancelled as Cancelled
    from dashpot.notebook.verbs import Network as Network
    from dashpot.notebook.verbs import campaign as campaign
    from dashpot.notebook.verbs import compare as compare
    from dashpot.notebook.verbs import declare as declare
    from dashpot.notebook.verbs import diagnose as diagnose
    from dashpot.notebook.verbs import fit as fit
    from dashpot.notebook.verbs import load as load
    from dashpot.notebook.verbs import load_dataset as load_dataset
    from dashpot.notebook.verbs import look as look
    from dashpot.notebook.verbs import measure as measure
    from dashpot.notebook.verbs import simulate as simulate
    from dashpot.notebook.verbs import write_dataset as write_dataset
    from dashpot.testing import ConformanceError as ConformanceError
    from dashpot.testing import check_element as check_element
    from dashpot.text.problem import InputError as InputError
    from dashpot.text.problem import Place as Place
    from dashpot.text.problem import Problem as Problem

_HOMES = {
    "dashpot.notebook.verbs": (
        *("load", "declare", "Network", "load_dataset", "simulate", "measure", "write_dataset"),
        *("look", "fit", "compare", "diagnose", "campaign"),
    ),
    "dashpot.notebook.model": ("Model",),
    "dashpot.notebook.part": ("Part",),
    "dashpot.notebook.data": ("Data",),
    "dashpot.notebook.fit": ("Fit",),
    "dashpot.notebook.campaign": ("Campaign",),
    "dashpot.notebook.comparison": ("Comparison",),
    "dashpot.notebook.diagnosis": ("Diagnosis",),
    "dashpot.notebook.listing": ("Listing",),
    "dashpot.notebook.look": ("Look",),
    "dashpot.notebook.estimator": ("Estimator",),
    "dashpot.notebook.progress": ("Cancelled",),
    "dashpot.data.run": ("Run",),
    "dashpot.data.correction": ("Correction",),
    "dashpot.text.problem": ("InputError", "Problem", "Place"),
    "dashpot.kernel.energy": ("energy_balance",),
    "dashpot.campaign.reading": ("read_campaign",),
    "dashpot.fit.study.reading": ("read_study",),
    "dashpot.fit.study.run": ("run_study",),
    "dashpot.model.element": ("Element", "Parameter", "Curve", "State", "Motion", "Response"),
    "dashpot.testing": ("check_element", "ConformanceError"),
    "dashpot.model.picture": ("Symbol", "Series", "Parallel"),
    "dashpot.contract.export": ("Export",),
    "dashpot.contract.metric": ("Metric",),
    "dashpot.contract.hooks": ("hookimpl",),
    "dashpot.contract.registry": ("load_registry",),
    "dashpot.contract.optimizer": ("Space", "Search", "Optimizer"),
    "dashpot.contract.reader": ("Reader", "ReadingError", "Table"),
    "dashpot.contract.cause": ("added_branch", "Suspect", "Cause", "View", "ChannelFault"),
    "dashpot.contract.specimen": ("Specimen",),
    "dashpot.contract.rig": ("PrescribedPath", "PlannedRun", "Rig"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}
_LAYERS = ("fit", "compare", "diagnose", "campaign")  # names that are both a layer and a verb

__all__ = ["__version__", *_HOME_OF]


def __getattr__(name: str) -> Any:
    if name in _LAYERS:
        return import_module(f"dashpot.{name}")
    if name not in _HOME_OF:
        raise AttributeError(f"module 'dashpot' has no attribute {name!r}")
    return getattr(import_module(_HOME_OF[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)


# a layer that, called, is the verb of its name, and is described by it
class _CallableLayer(ModuleType):
    @property
    def __doc__(self) -> str | None:  # type: ignore[override]
        return _verb(self).__doc__

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        return _verb(self)(*arguments, **options)

    @property
    def __signature__(self) -> Any:
        from inspect import signature

        return signature(_verb(self))


class _Package(ModuleType):
    """The package; importing makes ``dashpot.fit`` its attribute, and this makes it callable; so with other layers."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _LAYERS and isinstance(value, ModuleType):
            value.__class__ = _CallableLayer
        super().__setattr__(name, value)


def _verb(layer: ModuleType) -> Any:
    name = layer.__name__.rpartition(".")[2]
    return getattr(import_module(_HOME_OF[name]), name)


sys.modules[__name__].__class__ = _Package
