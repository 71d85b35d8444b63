"""Conformance checks for authors of elements: call ``check_element(MyElement)`` in a test.

element       - check_element: all checks, and their list
declarations  - units, bounds and texts are there, the law can be traced and answers the states it declares
dimensions    - the declared units fit the law
agreement     - eager, traced and compiled, the law gives the same force
tangent       - its derived tangent is its slope
halving       - one step is two half steps, where the element claims to be exact
passivity     - it gives back no more work than was put in
visibility    - NaN stays visible
separation    - lanes do not feel each other
specimen      - an element alone, with random numbers
motion        - random drives
verdict       - ConformanceError and what its message says

Every check takes the element's class and optionally a seed; the seed of a failure is in its message.
"""

from dashpot.testing.agreement import check_agreement
from dashpot.testing.declarations import check_declarations
from dashpot.testing.dimensions import check_dimensions
from dashpot.testing.element import CHECKS, check_element
from dashpot.testing.halving import check_halving
from dashpot.testing.motion import MOTIONS, random_drive
from dashpot.testing.passivity import check_passivity
from dashpot.testing.separation import check_separation
from dashpot.testing.specimen import Sizes, Specimen, draw_sizes, draw_specimens
from dashpot.testing.tangent import check_tangent
from dashpot.testing.verdict import ConformanceError
from dashpot.testing.visibility import check_visibility

__all__ = [
    "CHECKS",
    "MOTIONS",
    "ConformanceError",
    "Sizes",
    "Specimen",
    "check_agreement",
    "check_declarations",
    "check_dimensions",
    "check_element",
    "check_halving",
    "check_passivity",
    "check_separation",
    "check_tangent",
    "check_visibility",
    "draw_sizes",
    "draw_specimens",
    "random_drive",
]
