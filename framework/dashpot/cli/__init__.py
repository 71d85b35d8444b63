"""The ``dashpot`` command: one file per verb, no logic. The work is done by the layers below.

``shell``     the group of verbs           ``outcome``   from what happened to the exit code
``switches``  options shared by verbs      ``session``   plugins, networks, datasets and optimizers named by the user
``output``    files, nothing overwritten   ``results``   the files and texts of a comparison and of a diagnosis
``talk``      what is said where           ``columns`` ``progress``   how it looks
"""

from dashpot.cli.shell import main

__all__ = ["main"]
