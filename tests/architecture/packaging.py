"""What ``pyproject.toml`` says."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.metadata import packages_distributions
from typing import Any

from architecture.source import PLUGINS, ROOT

# the distributions of extras, which need not be installed, whose package has another name
PACKAGED_AS = {"sklearn": "scikit-learn"}


def project() -> dict[str, Any]:
    """The whole file."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def plugin_packages() -> set[str]:
    """The packages that lie in ``plugins/``."""
    return {path.parent.name for path in PLUGINS.glob("*/__init__.py")}


def requirements() -> set[str]:
    """Names of the distributions required by dashpot or by an extra for users, in small letters."""
    declared = project()["project"]
    extras = [line for extra, lines in declared["optional-dependencies"].items() if extra != "dev" for line in lines]
    return {re.match(r"[\w.-]+", line)[0].lower() for line in [*declared["dependencies"], *extras]}


@cache
def distributions_of(package: str) -> set[str]:
    """Names of the distributions that provide a package, in small letters: the installed ones, else by its own name."""
    provided = _installed().get(package, [PACKAGED_AS.get(package, package)])
    return {distribution.lower() for distribution in provided}


@cache
def _installed() -> Mapping[str, list[str]]:
    # the names of all distributions are read once: it takes a second
    return packages_distributions()
