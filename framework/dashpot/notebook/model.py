"""A network that shows itself."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dashpot.contract.registry import load_registry
from dashpot.model.lint import find_weaknesses
from dashpot.model.network import Group, NetworkSpec
from dashpot.model.patch import add_branch, remove_branch, set_entry
from dashpot.model.reading import parse_network
from dashpot.notebook.cell import cell
from dashpot.notebook.listing import Listing
from dashpot.notebook.part import Part
from dashpot.notebook.printed import Printed
from dashpot.report.parameters import parameters_grid
from dashpot.report.parts import Notice, Picture
from dashpot.report.schematic.svg import svg
from dashpot.text.problem import InputError, Place, nearest
from dashpot.text.quantity import si
from dashpot.text.written import flow

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray
    from pandas import DataFrame

    from dashpot.kernel.jit import Solver


class Model(Printed, NetworkSpec):
    """A network. In a notebook it shows its schematic and its parameters.

    It can be changed: ``model["rubber"].stiffness = ...``, ``model.add(...)``, ``del model["rubber"]``. What is set is
    what one would write into the file: ``"220 N/mm"``, a number in SI, or ``{"start": ..., "bounds": [...]}`` for one
    that is to be identified. Each change is written into the text and read again: InputError, and the model stays as
    it was, where that makes no sound network. Results keep the model as it was when they were computed.

    Examples:
        >>> model = dp.load("gehmann")
        >>> [branch.name for branch in model.leaves()]
        ['stiffness', 'maxwell']
        >>> [slot.path for slot in model.slots()]
        ['maxwell.stiffness', 'maxwell.relaxation_time']
        >>> model.weaknesses()
        []
        >>> model["maxwell"].relaxation_time = {"start": "20 ms", "bounds": ["1 ms", "1 s"]}
        >>> model.add("friction", "dahl", stiffness="400 N/mm", limit="20 N")
        >>> model["friction"].limit *= 2
        >>> model["friction"]
        friction.stiffness = 400 N/mm, friction.limit = 40 N
        >>> rubber = dp.Network("rubber", {"spring": {"element": "spring", "stiffness": "200 N/mm"}})
        >>> rubber.dynamic_stiffness([1.0, 10.0], 1e-3).real.round(3)
        array([200000., 200000.])
    """

    def __getitem__(self, name: str) -> Part:
        """A branch, ``group.branch`` inside a group, or a node. InputError when there is none."""
        self._refuse_unknown(name)
        return Part(self, name, lambda part, key, value: self._become(set_entry(self.text, part, key, flow(value))))

    def __delitem__(self, name: str) -> None:
        """Take a branch out. InputError when there is none, and where the rest is no sound network."""
        self._refuse_unknown(name)
        self._become(remove_branch(self.text, name))

    def add(self, name: str, element: str | Mapping[str, Any] | None = None, **keys: Any) -> None:
        """Add a branch: ``element`` is the word of its law, ``keys`` are those that a file would have.

        Or all of it as one mapping, as in ``dp.Network``: ``add("friction", {"element": "dahl", ...})``.
        ``add("mount", series={"rubber": {...}, "bracket": {...}})`` adds a group. InputError for mistakes, ValueError
        when there is a branch of that name.
        """
        entry = element if isinstance(element, Mapping) else {"element": element} if element else {}
        self._become(add_branch(self.text, f"{flow(name)}: {flow({**entry, **keys})}"))

    def dynamic_stiffness(
        self, frequency: ArrayLike, amplitude: ArrayLike, preload: ArrayLike = 0.0, **settings: float
    ) -> NDArray[np.complex128]:
        """K' + i K'' in N/m over frequency (Hz), amplitude and preload (m), broadcast against each other.

        Of a steady sine that begins at the preload, as the load cell shows it. Texts are quantities: ``"0.5 mm"``.
        ``settings`` in SI set the parameters that depend on the settings of a run. InputError for a network with
        several driven ends, ValueError for shapes that do not go together.
        """
        from dashpot.kernel.stiffness import dynamic_stiffness

        given = _in_si(frequency, "Hz"), _in_si(amplitude, "m"), _in_si(preload, "m")
        _refuse_other_shapes(*(values.shape for values in given))
        return dynamic_stiffness(self, *given, settings)

    @property
    def _line(self) -> str:
        """The name, and the branches with their elements."""
        branches = [f"{branch.name} ({branch.element.word})" for branch in self.leaves()]
        return f"{self.name}: {', '.join(branches)}" if branches else self.name

    def table(self) -> Listing:
        """Every parameter with its meaning, unit, bounds and role."""
        return Listing.of(parameters_grid(self))

    def to_pandas(self) -> DataFrame:
        """The same as a pandas frame."""
        return self.table().to_pandas()

    @property
    def schematic(self) -> str:
        """The drawing of the network as the text of an SVG file."""
        return svg(self)

    def weaknesses(self) -> list[str]:
        """What is weak in the structure whatever the data, a sentence each."""
        return [str(problem) for problem in find_weaknesses(self)]

    def jit(self, **settings: float) -> Solver:
        """Functions compiled by numba, ``step`` and ``simulate``, for your own compiled code; see ``Solver``.

        ``settings`` in SI give the parameters that depend on the settings of a run.
        """
        from dashpot.kernel.jit import jit_network

        return jit_network(self, settings)

    def save(self, path: str | Path) -> Path:
        """Write the YAML text of the network; the path."""
        target = Path(path)
        target.write_text(self.text, encoding="utf-8")
        return target

    def _refuse_unknown(self, name: str) -> None:
        outermost = [member.name for member in _groups(self.root)]
        known = dict.fromkeys([*(branch.name for branch in self.leaves()), *outermost, *self.joints])
        known |= dict.fromkeys(branch.family for branch in self.leaves())
        if name not in known:
            hint = nearest(name, known) or f"it has {', '.join(known) or 'none yet'}"
            raise InputError.at(Place(self.file), f"'{self.name}' has no branch or node '{name}'", hint)

    # a mutable face of a frozen declaration: all of it is replaced, and whoever keeps it for a result keeps a copy
    def _become(self, text: str) -> None:
        own = {branch.element.word: branch.element for branch in self.leaves()}
        found = parse_network(text, {**load_registry().elements, **own}, self.file)
        vars(self).clear()
        vars(self).update(vars(found))

    def _repr_html_(self) -> str:
        notices = [Notice("warning", text) for text in self.weaknesses()]
        about = [self.about] if self.about else []
        return cell(
            self.name, *about, Picture(f"Schematic of {self.name}", self.schematic), parameters_grid(self), *notices
        )


def _groups(group: Group) -> list[Group]:
    inner = [member for member in group.members if isinstance(member, Group)]
    return [*inner, *(below for member in inner for below in _groups(member))]


def _in_si(values: ArrayLike, unit: str) -> NDArray[np.float64]:
    """Numbers in SI, whatever their shape; of texts what they mean in the unit."""
    import numpy as np

    given = np.asarray(values)
    if given.dtype.kind not in "UO":
        return given
    return np.array([si(value, unit) for value in given.ravel().tolist()]).reshape(given.shape)


def _refuse_other_shapes(*shapes: tuple[int, ...]) -> None:
    import numpy as np

    try:
        np.broadcast_shapes(*shapes)
    except ValueError:
        raise ValueError(
            "expected frequency, amplitude and preload that broadcast against each other, got the shapes "
            f"{', '.join(map(str, shapes))}; for a table of two frequencies and three amplitudes write "
            "frequency as [[1.0], [10.0]]"
        ) from None
