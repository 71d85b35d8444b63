"""The built-in exports, one a file; the name of the file is the word a user gives.

- `c`        a header and a source in C99
- `fmu`      a functional mock-up unit by FMI 3.0, for co-simulation
- `fmu2`     the same by FMI 2.0
- `numba`    a Python module for numba
- `modelica` a sampled Modelica model with flanges of the standard library
- `gbs`      a bushing property file with a static curve and a constant damping
- `petab` the tables of a parameter estimation problem, with the runs of a dataset
- `stiffness_table` dynamic stiffness and loss angle as CSV
- `sines` what tables and conversions are made with
- `unit` `variables` what both versions of the mock-up units share; `component.h` `fmi2.c` `fmi3.c` their sources
"""

from __future__ import annotations

from dashpot.contract.hooks import hookimpl


@hookimpl
def dashpot_exports() -> list[type]:
    """Every export of this package."""
    from dashpot_exports.c import C
    from dashpot_exports.fmu import Fmu
    from dashpot_exports.fmu2 import Fmu2
    from dashpot_exports.gbs import Gbs
    from dashpot_exports.modelica import Modelica
    from dashpot_exports.numba import Numba
    from dashpot_exports.petab import Petab
    from dashpot_exports.stiffness_table import StiffnessTable

    return [C, Fmu, Fmu2, Gbs, Modelica, Numba, Petab, StiffnessTable]
