"""Blind cases of a second kind: rigs from bushing to strut, and laws as textbooks write them.

Nothing here imports dashpot, nor the motions and forms of `truth`; only the sealed label is the same.

- `rig`        sizes of the specimens and what the rigs drive them with
- `motion`     the driven paths
- `record`     one run, and what laws may know of it
- `memory`     sliders, Bouc-Wen and Maxwell, on a refined path
- `laws`       the forces and faults that can be hidden, by cause word
- `specimen`   what is measured before anything is hidden, and the network that describes it
- `case`       `draw_textbook`: all of the above from one seed
"""

from .case import draw_textbook
from .laws import KINDS
from .rig import RIGS

__all__ = ["KINDS", "RIGS", "draw_textbook"]
