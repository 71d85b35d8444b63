"""dashpot: rheological models as networks of small laws, fitted to measurements, with what is missing named.

Write a plugin with ``Element``, ``Optimizer``, ``Reader``, ``Cause``, ``Specimen`` or ``Rig`` and mark its hook with
``hookimpl``. Use the parts from Python with ``load_registry``, ``read_network``, ``read_dataset``, ``simulate_runs``,
``energy_balance``, ``fit_network``, ``read_study``, ``run_study``, ``virtual_test``, ``compare`` and ``diagnose``.
Everything is imported on first use: ``import dashpot`` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from dashpot.assess.compare import compare as compare
    from dashpot.assess.diagnose import diagnose as diagnose
    from dashpot.contract.cause import Cause as Cause
    from dashpot.contract.cause import Suspect as Suspect
    from dashpot.contract.cause import View as View
    from dashpot.contract.cause import added_branch as added_branch
    from dashpot.contract.hooks import hookimpl as hookimpl
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
    from dashpot.data.dataset import read_dataset as read_dataset
    from dashpot.fit.api import fit_network as fit_network
    from dashpot.fit.study.reading import read_study as read_study
    from dashpot.fit.study.run import run_study as run_study
    from dashpot.fit.virtual_test import virtual_test as virtual_test
    from dashpot.kernel.api import simulate_runs as simulate_runs
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
    from dashpot.model.reading import read_network as read_network

_HOMES = {
    "dashpot.model.element": ("Curve", "Element", "Motion", "Parameter", "Response", "State"),
    "dashpot.model.picture": ("Parallel", "Series", "Symbol"),
    "dashpot.model.reading": ("read_network",),
    "dashpot.data.dataset": ("read_dataset",),
    "dashpot.contract.hooks": ("hookimpl",),
    "dashpot.contract.registry": ("load_registry",),
    "dashpot.contract.optimizer": ("Optimizer", "Search", "Space"),
    "dashpot.contract.reader": ("Reader", "ReadingError", "Table"),
    "dashpot.contract.cause": ("Cause", "Suspect", "View", "added_branch"),
    "dashpot.contract.specimen": ("Specimen",),
    "dashpot.contract.rig": ("PlannedRun", "PrescribedPath", "Rig"),
    "dashpot.kernel.api": ("simulate_runs",),
    "dashpot.kernel.energy": ("energy_balance",),
    "dashpot.fit.api": ("fit_network",),
    "dashpot.fit.study.reading": ("read_study",),
    "dashpot.fit.study.run": ("run_study",),
    "dashpot.fit.virtual_test": ("virtual_test",),
    "dashpot.assess.compare": ("compare",),
    "dashpot.assess.diagnose": ("diagnose",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = ["__version__", *_HOME_OF]


def __getattr__(name: str) -> Any:
    if name not in _HOME_OF:
        raise AttributeError(f"module 'dashpot' has no attribute {name!r}")
    return getattr(import_module(_HOME_OF[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
