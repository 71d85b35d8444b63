"""What an element declares, and the one method in which it says its law.

An element is written once, in plain numpy. The same ``step`` runs eagerly on arrays and is traced into the scalar
graph from which tangents and the compiled kernel are derived.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from dashpot.model.picture import Picture, Symbol

Scale = Literal["log", "linear"]


@dataclass(frozen=True)
class Parameter:
    """A parameter of the law.

    ``unit`` is SI text, ``bounds`` the range that makes physical sense in SI, ``scale`` how an optimizer should search
    it. A parameter with a ``default`` that a file does not mention is compiled as that constant.

    Examples:
        >>> stiffness = dp.Parameter("N/m", "slope at zero", bounds=(1.0, 1e9), symbol="k")
        >>> stiffness.scale
        'log'
    """

    unit: str
    about: str
    bounds: tuple[float, float] = (-math.inf, math.inf)
    scale: Scale = "log"
    symbol: str = ""
    default: float | None = None


@dataclass(frozen=True)
class Curve:
    """A characteristic of the law: a constant slope, a polynomial through the origin, or a table.

    ``value`` and ``over`` name the two axes and their SI units, as they are written in a file:
    ``stiffness: 220 N/mm``, ``stiffness: {polynomial: [180 N/mm, 1 N/mm^2]}``,
    ``stiffness: {deflection: [0 mm, 10 mm], force: [0 N, 2 kN]}``. A search does not let the table of a ``rising`` law
    fall anywhere. In a law it is called with its argument, ``p.stiffness(x.new)``; its slope there is
    ``p.stiffness.slope(x.new)``.

    Examples:
        >>> law = dp.Curve(("force", "N"), ("deflection", "m"), "force over deflection", bounds=(1.0, 1e9))
        >>> law.slope_unit, law.coefficient_unit(3)
        ('N/m', 'N/m^3')
    """

    value: tuple[str, str]
    over: tuple[str, str]
    about: str
    bounds: tuple[float, float] = (-math.inf, math.inf)
    scale: Scale = "log"
    symbol: str = ""
    rising: bool = False

    @property
    def slope_unit(self) -> str:
        """Unit of the constant form, e.g. ``N/m``."""
        return self.coefficient_unit(1)

    def coefficient_unit(self, power: int) -> str:
        """Unit of the coefficient of a power of the argument, e.g. ``N/m^3``."""
        over = f"({self.over[1]})" if "/" in self.over[1] else self.over[1]
        return f"{self.value[1]}/{over}" + (f"^{power}" if power > 1 else "")


@dataclass(frozen=True)
class State:
    """A memory of the law: zero in the unloaded specimen.

    Examples:
        >>> dp.State("N", "friction force").unit
        'N'
    """

    unit: str
    about: str


@dataclass(frozen=True)
class Motion:
    """The motion of an element's two ends against each other over one step, compression positive.

    Between ``old`` and ``new`` (m) the path is the cubic that also has the two velocities (m/s).
    For a law that uses positions only, the framework splits steps at turning points, so that its path is monotone.

    Examples:
        >>> dp.Motion(old=0.0, new=2e-3, velocity_old=0.0, velocity_new=0.1, acceleration=5.0).travel
        0.002
    """

    old: Any
    new: Any
    velocity_old: Any
    velocity_new: Any
    acceleration: Any

    @property
    def travel(self) -> Any:
        """The way from ``old`` to ``new`` in m."""
        return self.new - self.old


@dataclass(frozen=True, init=False)
class Response:
    """What a law answers: the force at the end of the step in N and the new value of every state.

    Examples:
        >>> answer = dp.Response(12.0, slider=12.0)
        >>> answer.force, answer.states
        (12.0, {'slider': 12.0})
    """

    force: Any
    states: Mapping[str, Any]

    def __init__(self, force: Any, /, **states: Any) -> None:
        object.__setattr__(self, "force", force)
        object.__setattr__(self, "states", states)


@dataclass(frozen=True)
class Declaration:
    """The collected declarations of an element class, in the order in which they stand."""

    parameters: Mapping[str, Parameter] = field(default_factory=dict)
    curves: Mapping[str, Curve] = field(default_factory=dict)
    states: Mapping[str, State] = field(default_factory=dict)


class Element(ABC):
    """A law of force between two ends.

    Subclasses declare ``Parameter``, ``Curve`` and ``State`` as class attributes and implement ``step``. ``word`` is
    the name in a file; it defaults to the name of the module that holds the class. ``source`` is the publication that
    the law follows. ``exact`` claims that one step is the same as two over its halves, ``passive`` that the law never
    gives back more work than was put in, for any parameters; set to False what does not hold. ``picture`` is how a
    schematic shows the element.

    Examples:
        >>> class Bumper(dp.Element):
        ...     '''A rubber bumper that hardens: F = stiffness length (exp(x / length) - 1).'''
        ...     word = "bumper"
        ...     stiffness = dp.Parameter("N/m", "slope at first contact", bounds=(1.0, 1e9))
        ...     length = dp.Parameter("m", "deflection over which the slope grows by e", bounds=(1e-5, 1.0))
        ...     def step(self, x, z, p, dt):
        ...         return dp.Response(p.stiffness * p.length * np.expm1(x.new / p.length))
        >>> list(Bumper.declares.parameters)
        ['stiffness', 'length']
    """

    word: ClassVar[str] = ""
    source: ClassVar[str] = ""
    exact: ClassVar[bool] = True
    passive: ClassVar[bool] = True
    picture: ClassVar[Picture] = Symbol.BOX
    declares: ClassVar[Declaration] = Declaration()

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        if "word" not in cls.__dict__:
            cls.word = cls.__module__.rpartition(".")[2]
        members = {name: value for base in reversed(cls.__mro__) for name, value in vars(base).items()}
        cls.declares = Declaration(
            parameters={name: value for name, value in members.items() if isinstance(value, Parameter)},
            curves={name: value for name, value in members.items() if isinstance(value, Curve)},
            states={name: value for name, value in members.items() if isinstance(value, State)},
        )

    @abstractmethod
    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The force and the new states at the end of a step of ``dt`` seconds.

        ``z`` holds the old states and ``p`` the parameters as attributes; a curve is called with its argument.
        Use numpy functions only (``np.where`` for a choice): arrays and graph nodes both pass through here.
        """

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy in J that is recoverable at the end of a step; ``z`` holds the states there.

        None, the default, leaves it to the framework: a law of the deflection alone gives all work back, one of the
        rates alone nothing; of other laws it is then not known.
        """
        return None

    def stops(self, p: Any) -> tuple[Any, Any] | None:
        """The deflections in m, rebound and compression, at which a rigid law stops a mass without any rebound.

        None, the default: the law is not rigid. What stops a mass with a stiffness throws it back.
        """
        return None
