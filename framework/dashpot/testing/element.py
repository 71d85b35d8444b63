"""All checks of one element."""

from __future__ import annotations

from collections.abc import Callable

from dashpot.model.element import Element
from dashpot.testing.agreement import check_agreement
from dashpot.testing.declarations import check_declarations
from dashpot.testing.dimensions import check_dimensions
from dashpot.testing.halving import check_halving
from dashpot.testing.passivity import check_passivity
from dashpot.testing.separation import check_separation
from dashpot.testing.tangent import check_tangent
from dashpot.testing.verdict import ConformanceError
from dashpot.testing.visibility import check_visibility

CHECKS: tuple[Callable[..., None], ...] = (
    check_declarations,
    check_dimensions,
    check_agreement,
    check_tangent,
    check_halving,
    check_passivity,
    check_visibility,
    check_separation,
)


def check_element(element: type[Element], seed: int | None = None) -> None:
    """All checks of an element, with random numbers and motions that ``seed`` repeats.

    Its units fit the law, it is the same eagerly and compiled, its tangent is its slope, half steps agree with whole
    ones, it gives back no more work than was put in, and NaN stays visible. Raises ConformanceError with everything
    that was found; where the declarations are wrong, with that alone.

    Examples:
        >>> dp.check_element(Bumper, seed=1)
    """
    check_declarations(element, seed)
    found = []
    for check in CHECKS[1:]:
        try:
            check(element, seed)
        except ConformanceError as error:
            found.append(str(error))
    if found:
        raise ConformanceError("\n".join(found))
