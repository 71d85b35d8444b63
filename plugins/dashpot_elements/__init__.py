"""The built-in elements, one law per file; the name of the file is the word in a network."""

from __future__ import annotations

import pluggy

hookimpl = pluggy.HookimplMarker("dashpot")


@hookimpl
def dashpot_elements() -> list[type]:
    """Every element of this package."""
    from dashpot_elements.coulomb import Coulomb
    from dashpot_elements.dahl import Dahl
    from dashpot_elements.damper import Damper
    from dashpot_elements.inerter import Inerter
    from dashpot_elements.maxwell import Maxwell
    from dashpot_elements.prandtl import Prandtl
    from dashpot_elements.quadratic_damper import QuadraticDamper
    from dashpot_elements.spring import Spring

    return [Spring, Damper, QuadraticDamper, Maxwell, Dahl, Coulomb, Prandtl, Inerter]
