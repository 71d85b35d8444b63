"""What a suspected cause promises: how it would show in every run, and what to add to the network if it is there."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from dashpot.data.correction import Correction
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch, branch_names

Array = NDArray[np.float64]
Atom = tuple[float, float]  # strength and place on the grid
Pair = tuple[float, float]
NOTHING: Mapping[str, Any] = MappingProxyType({})


class View(Protocol):
    """The data that a cause may use. Arrays of a run have its samples; noise, thresholds and labels are not among them.

    Examples:
        >>> def deepest(view: dp.View) -> float:
        ...     return max(float(view.displacement(run).max()) for run in view.runs)
    """

    @property
    def runs(self) -> Sequence[str]:
        """Names of the runs."""

    @property
    def reach(self) -> tuple[float, float]:
        """Smallest and largest deflection in m."""

    @property
    def speed(self) -> float:
        """Largest speed in m/s."""

    @property
    def highest_frequency(self) -> float:
        """The highest frequency in Hz that was driven: of a sweep its end, of many sines the fastest that matters."""

    @property
    def duration(self) -> float:
        """Median length of a run in s."""

    @property
    def stroke(self) -> float:
        """The largest stroke of a single run in m."""

    @property
    def dt(self) -> float:
        """Smallest sample time in s."""

    def displacement(self, run: str) -> Array:
        """The deflection (n,) in m."""

    def velocity(self, run: str) -> Array:
        """The velocity (n,) in m/s."""

    def force(self, run: str) -> Array:
        """The force of the present model (n,) in N."""

    def step(self, run: str) -> float:
        """The sample time in s."""

    def settings(self, run: str) -> Mapping[str, float]:
        """The settings of a run in SI, its ``order`` in the dataset, and the means of its further channels, as
        ``mean of temperature``.
        """

    def channels(self, run: str) -> Mapping[str, Array]:
        """What was measured (n,) beside motion and force, in SI by name."""

    def unit_of(self, setting: str) -> str:
        """The unit in which the runs tell a setting, as ``bar``; nothing for a bare number."""

    def moved(self, run: str, change: Array) -> Array:
        """The force (n,) in N of the present model if the deflection were larger by ``change`` (n,) in m."""

    def respond(self, run: str, element: str, values: Sequence[Mapping[str, float | Array]]) -> Array:
        """The forces (m, n) of an element with each of m sets of values, moved like the specimen.

        A value may be another one (n,) at every sample.
        """


@dataclass(frozen=True)
class Suspect:
    """One form of a cause.

    ``columns(view, run)`` answers its force (m, n) at unit strength for each place of ``grid`` (m,); with ``joint`` all
    columns act together with a strength each. ``sign`` 1 admits positive strengths only. ``unknowns`` counts the
    parameters besides the strength. ``extend(text, atoms)`` writes it into a network's text, with start values; at
    most ``most`` atoms of the grid act together.

    ``measured`` says that the columns change what the load cell shows and are no force between two nodes of a network.
    ``quantity`` and ``unit`` (SI) say what a strength of one is, ``largest`` how large it can be. ``admits(numbers)``
    says whether refitted parameters, by the last words of their paths (those of a second branch end in ``_2``), still
    belong to this cause: the borders between causes.
    ``of_motion`` promises that the columns depend on the motion of a run alone: they are computed once. Where forms of
    a cause change different things, ``of`` (m,) names for each place what: the law that acts may be another form of
    a law of the same thing only. ``dependent`` (m,) names for each place the number of the network, as
    ``oil.damping``, that follows a setting or a channel: a number follows one thing only, and terms that make it follow
    two exclude each other. ``about`` says what the form is, where the words of its cause do not fit it.

    Examples:
        >>> suspect.form, suspect.quantity, suspect.unit, len(suspect.grid)
        ('bumper', 'stiffness', 'N/m', 8)
    """

    form: str
    grid: tuple[float, ...]
    columns: Callable[[View, str], Array]
    extend: Callable[[str, Sequence[Atom]], str]
    joint: bool = False
    sign: Literal[0, 1] = 1
    unknowns: int = 1
    most: int = 1
    measured: bool = False
    quantity: str = "strength"
    unit: str = ""
    largest: float = np.inf
    admits: Callable[[Mapping[str, float]], bool] = lambda numbers: True
    of_motion: bool = False
    of: tuple[str, ...] = ()
    dependent: tuple[str, ...] = ()
    about: str = ""

    @property
    def each_of(self) -> tuple[str, ...]:
        """For each place (m,) of the grid what it changes; nothing where forms of the cause all change the same."""
        return self.of or ("",) * len(self.grid)

    @property
    def each_dependent(self) -> tuple[str, ...]:
        """For each place (m,) of the grid the number that follows a setting or a channel; nothing where none does."""
        return self.dependent or ("",) * len(self.grid)


@dataclass(frozen=True)
class ChannelFault:
    """A fault that the force channel may have in single runs.

    ``shapes(view, run)`` answers the force (k, n) in N that it adds at unit strengths, ``correct(strengths)`` what puts
    the run right. ``evidence_of`` says what shows it: ``repeats`` where runs under the same conditions have to
    disagree, ``at_rest`` where it acts without motion, which ``evidence`` then tells in words. Where it ``scatters``,
    specimens differ like that from one test to the next as well, as in stiffness and zero: then a repeat has to stand
    out from the scatter of all repeats. Where it does not, it is what no change of the model's numbers from one test
    to the next explains. ``alike(view, run)`` are shapes (m, k, n) of faults like it that no rig has,
    such as lines beside that of the mains: what these explain is the error of the model. The last ``free`` shapes go
    along with the others, and are no evidence of the fault. ``possible(strengths)`` says whether a rig can have it.

    Examples:
        >>> fault = dp.ChannelFault(
        ...     "offset",
        ...     "offset",
        ...     "N",
        ...     lambda view, run: np.ones((1, view.force(run).size)),
        ...     lambda strengths: dp.Correction(offset=strengths[0]),
        ... )
        >>> fault.quantity, fault.correct([3.0]).offset
        ('offset', 3.0)
    """

    form: str
    quantity: str
    unit: str
    shapes: Callable[[View, str], Array]
    correct: Callable[[Sequence[float]], Correction]
    evidence_of: Literal["repeats", "at_rest"] = "repeats"
    evidence: str = ""
    scatters: bool = True
    alike: Callable[[View, str], Array] | None = None
    free: int = 0
    possible: Callable[[Sequence[float]], bool] = lambda strengths: True


class Cause(ABC):
    """A candidate cause of a misfit.

    ``word`` names it, ``about`` says what it is, ``shows`` how it appears in the residual, and ``confused_with``
    maps other words to the measurement that distinguishes the two; a word that no plugin provides is a rival.
    ``cure`` says how to correct a fault of the measurement; ``evidence_of`` names the evidence that it needs:
    ``phase`` that its parameters are the same in every run, ``order`` that the force of each run is off by the same
    from the run before, ``range`` that the force ends at one value, ``data_sheet`` that the data sheet of the
    channel admits it, under the key that is the ``quantity`` of its suspects and the last word of its path.
    ``faults`` are the kinds of faults found by triage that the cause stands for. A cause that ``changes_numbers``
    of branches with the settings of runs is looked for beside each further law as well, whose numbers it may
    change.

    Examples:
        >>> class MissingBumper(dp.Cause):
        ...     '''The force of a bumper.'''
        ...     word, kind, about = "missing_bumper", "specimen", "a hardening bumper"
        ...     shows = "storage stiffness grows with preload faster and faster"
        ...     def suspects(self, view, network):
        ...         yield suspect
        >>> len(list(MissingBumper().suspects(None, mount)))
        1
    """

    word: ClassVar[str]
    kind: ClassVar[Literal["specimen", "measurement"]]
    about: ClassVar[str]
    shows: ClassVar[str]
    cure: ClassVar[str] = ""
    evidence_of: ClassVar[Literal["phase", "order", "range", "data_sheet"]] = "phase"
    faults: ClassVar[tuple[str, ...]] = ()
    changes_numbers: ClassVar[bool] = False
    confused_with: ClassVar[Mapping[str, str]] = {}

    @abstractmethod
    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """The forms to try on a network."""

    def channel_faults(self, view: View) -> Iterable[ChannelFault]:
        """The faults that the force channel may have in single runs."""
        return ()


def added_branch(
    element: str,
    branch: str,
    grid: Sequence[float],
    values: Callable[[float, float], Mapping[str, float]],
    units: Mapping[str, str],
    sign: Literal[0, 1] = 1,
    most: int = 1,
    unknowns: int = 1,
    fixed: Sequence[str] = (),
    bounds: Mapping[str, Pair] = NOTHING,
    admits: Callable[[Mapping[str, float]], bool] = lambda numbers: True,
    form: str = "",
    given: Mapping[str, str] = NOTHING,
) -> Suspect:
    """The suspect that an element is missing; ``values(strength, place)`` are its parameters in ``units``.

    Those named in ``fixed`` are written as plain numbers, the others to be found, some of them within ``bounds`` (SI).
    Further parameters are ``given`` by the setting of a run that they name, zero where a run has none.
    ``admits`` and ``form`` are those of the suspect; without a word the form is that of the element.

    Examples:
        >>> lengths, units = np.geomspace(1e-3, 1e-2, 8), {"stiffness": "N/m", "length": "m"}
        >>> suspect = dp.added_branch("bumper", "bumper", lengths, lambda k, s: {"stiffness": k, "length": s}, units)
        >>> print(suspect.extend(mount.text, [(5000.0, 2e-3)]).splitlines()[-1].strip())
        length: {start: 2 mm}
    """

    def columns(view: View, run: str) -> Array:
        told = {key: view.settings(run)[setting] for key, setting in given.items()}
        return view.respond(run, element, [{**values(1.0, place), **told} for place in grid])

    def extend(text: str, atoms: Sequence[Atom]) -> str:
        for strength, place in atoms:
            text = add_branch(
                text,
                branch_lines(free_name(text, branch), element, values(strength, place), units, fixed, bounds, given),
            )
        return text

    quantity = next(iter(values(1.0, grid[0])))
    return Suspect(
        form or element,
        tuple(grid),
        columns,
        extend,
        sign=sign,
        most=most,
        unknowns=unknowns,
        quantity=quantity.replace("_", " "),
        unit=units[quantity],
        admits=admits,
        of_motion=True,
    )


def branch_lines(
    name: str,
    element: str,
    values: Mapping[str, float],
    units: Mapping[str, str],
    fixed: Sequence[str] = (),
    bounds: Mapping[str, Pair] = NOTHING,
    given: Mapping[str, str] = NOTHING,
) -> str:
    """A branch as lines of YAML, its parameters free, some within ``bounds`` (SI), but for those named in ``fixed``.

    Those that are ``given`` follow the setting of a run, and are zero where it has none.
    """
    from dashpot.text.quantity import pretty

    texts = {key: pretty(value, units[key], 6) for key, value in values.items()}
    within = {key: ", ".join(pretty(end, units[key], 6) for end in pair) for key, pair in bounds.items()}
    starts = {
        key: f"{{start: {text}{f', bounds: [{within[key]}]' if key in within else ''}}}" for key, text in texts.items()
    }
    numbers = [f"  {key}: {texts[key] if key in fixed else starts[key]}" for key in texts]
    numbers += [f"  {key}: {{setting: {word}, value: 0 {units[key]}}}" for key, word in given.items()]
    return "\n".join([f"{name}:", f"  element: {element}", *numbers])


def free_name(text: str, wanted: str) -> str:
    """``wanted``, or with a number if the network has a branch of that name."""
    taken = set(branch_names(text))
    names = [wanted, *(f"{wanted}_{number}" for number in range(2, len(taken) + 3))]
    return next(name for name in names if name not in taken)
