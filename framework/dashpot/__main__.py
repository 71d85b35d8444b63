"""``python -m dashpot`` is the ``dashpot`` command."""

import sys

from dashpot.cli import main

sys.exit(main())
