"""The ``dashpot`` command: one file per verb, no logic. The work is done by the layers below.

``shell``     the group of verbs           ``outcome``   from what happened to the exit code
``switches``  options shared by verbs      ``session``   plugins, networks, datasets and optimizers named by the user
``output``    files, nothing overwritten   ``results``   the files and texts of a comparison and of a diagnosis
``talk``      what is said where           ``columns`` ``progress`` ``pace``   how it looks
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

INTERRUPTED = 3


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; 0 done, 1 the input is wrong, 2 usage, 3 interrupted, 70 a fault of dashpot itself."""
    kept = "nothing was begun"
    try:
        from dashpot.cli.shell import run

        kept = "the same command goes on"
        return run(arguments)
    except KeyboardInterrupt:
        sys.stderr.write(f"interrupted; {kept}\n")
        return INTERRUPTED


__all__ = ["main"]
