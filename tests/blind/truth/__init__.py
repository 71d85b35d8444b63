"""Blind truth: virtual specimens with one hidden effect, measured on a virtual rig, the label sealed.

Nothing here imports dashpot. Motions, integrators and functional forms are its own, at eight steps per sample.

- `motion`      what the rig does to the specimen, with exact derivatives
- `design`      which runs are driven
- `branches`    what specimens are made of
- `base`        the specimens before anything is hidden in them
- `form`        what a functional form of an effect has to offer
- `friction`, `relaxation`, `damping`, `stiffness`, `inertia`, `channel`   the forms
- `lawless`     forces that no cause describes
- `effects`     all forms by the cause they stand for
- `noise`       sensor noise of a given size and colour
- `sensor`      a force channel that errs within its data sheet
- `label`       the truth, given only in exchange for a verdict
- `folder`      the dataset as files
- `axle`, `axle_case`   two wheels below a body, with equations of motion, and a blind case of them
- `case`        `draw_case`: all of the above from one seed
"""

from .case import Case, draw_case
from .effects import FORMS, KINDS_OF_BASE
from .label import Hidden, SealBroken, SealedLabel, Truth

__all__ = ["FORMS", "KINDS_OF_BASE", "Case", "Hidden", "SealBroken", "SealedLabel", "Truth", "draw_case"]
