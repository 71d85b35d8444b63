"""How the documentation is made: pages from the registry, equations from the docstrings, notebooks run."""

import sys
from pathlib import Path

# what is written from the code, here and in the README of the plugins, is written by one module
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
