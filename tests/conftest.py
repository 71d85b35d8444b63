"""What all tests share: examples of hypothesis are the same in every run, unless DRAW_SEEDS is set."""

import os

from hypothesis import settings

settings.register_profile("fixed", derandomize=True)
settings.register_profile("drawn", derandomize=False)
settings.load_profile("drawn" if os.environ.get("DRAW_SEEDS") else "fixed")
