"""Everything a plugin can give to dashpot.

A plugin is an installed module (or package) under the entry-point group ``dashpot``:

    [project.entry-points.dashpot]
    my_plugin = "my_package"

It implements any of the functions below under the same name, marked with ``hookimpl``, and returns *classes*. Each
class has a ``word``, by which files and commands name it. The built-in plugins come in the same way.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import pluggy

if TYPE_CHECKING:
    from dashpot.contract.cause import Cause
    from dashpot.contract.export import Export
    from dashpot.contract.metric import Metric
    from dashpot.contract.optimizer import Optimizer
    from dashpot.contract.reader import Reader
    from dashpot.contract.rig import Rig
    from dashpot.contract.specimen import Specimen
    from dashpot.model.element import Element

PROJECT = "dashpot"
Hook = TypeVar("Hook", bound=Callable[..., Any])

hookspec = pluggy.HookspecMarker(PROJECT)
_mark = pluggy.HookimplMarker(PROJECT)


def hookimpl(function: Hook) -> Hook:
    """Mark a function of a plugin as one of the functions below.

    Examples:
        >>> @dp.hookimpl
        ... def dashpot_elements():
        ...     return [Bumper]
        >>> dashpot_elements()[0].word
        'bumper'
    """
    return _mark(function)


@hookspec
def dashpot_elements() -> list[type[Element]]:  # type: ignore[empty-body]
    """Laws of force between two ends, used as branches of a network."""


@hookspec
def dashpot_optimizers() -> list[type[Optimizer]]:  # type: ignore[empty-body]
    """Methods that search the unit cube for the best parameters, by asking for blocks of points."""


@hookspec
def dashpot_formats() -> list[type[Reader]]:  # type: ignore[empty-body]
    """Readers of measurement files."""


@hookspec
def dashpot_causes() -> list[type[Cause]]:  # type: ignore[empty-body]
    """Candidate causes of a misfit: how each shows in the measurements, and what to add to the network."""


@hookspec
def dashpot_specimens() -> list[type[Specimen]]:  # type: ignore[empty-body]
    """Virtual test specimens that write a dataset of their own, for demonstrations and trials."""


@hookspec
def dashpot_rigs() -> list[type[Rig]]:  # type: ignore[empty-body]
    """Test procedures: named runs with the motion that the rig prescribes."""


@hookspec
def dashpot_exports() -> list[type[Export]]:  # type: ignore[empty-body]
    """Targets that a network is written for: languages, mock-up units, tables of other programs."""


@hookspec
def dashpot_metrics() -> list[type[Metric]]:  # type: ignore[empty-body]
    """Scalar results of a test, one for each run, measured and simulated."""
