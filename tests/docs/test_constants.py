"""The constants that the documentation tells are those of the code, and none of the diagnosis is left out."""

from __future__ import annotations

import ast
import re
from importlib import import_module
from typing import Any

import pytest
from architecture.source import FRAMEWORK, ROOT, modules, tree

EXPLANATION = ROOT / "docs" / "explanation"
DIAGNOSIS = (EXPLANATION / "diagnosis.md").read_text(encoding="utf-8")
NAMING = (EXPLANATION / "naming.md").read_text(encoding="utf-8")
TOLD = {
    f"{module}.{name}": value
    for names, values, module in re.findall(r"^\| ((?:`[A-Z_]+`(?:, )?)+) \| (.+?) \| `([\w.]+)` \|", DIAGNOSIS, re.M)
    for name, value in zip(re.findall("[A-Z_]+", names), ast.literal_eval(f"[{values}]"), strict=True)
}
BORDERS = re.findall(r"\| ([^|]+) \| [^|]+ \| `(\w+)\.([A-Z_]+)` \|", NAMING)


def numbers(value: Any) -> list[float]:
    """A number, or several of them, as a list."""
    return [float(each) for each in value] if isinstance(value, tuple) else [float(value)]


@pytest.mark.parametrize("path", TOLD)
def test_a_constant_is_what_is_told(path):
    module, _, name = path.rpartition(".")
    assert numbers(getattr(import_module(f"dashpot.{module}"), name)) == pytest.approx(numbers(TOLD[path]), rel=1e-6)


def test_no_number_of_the_diagnosis_is_left_out():
    found = set()
    for path in modules(FRAMEWORK / "diagnose"):
        for node in tree(path).body:
            if isinstance(node, ast.Assign) and all(isinstance(each, ast.Name) for each in node.targets):
                names = [each.id for each in node.targets]
            elif isinstance(node, ast.Assign):
                names = [each.id for target in node.targets for each in target.elts]
            else:
                continue
            module = import_module(f"dashpot.diagnose.{path.stem}")
            found |= {f"diagnose.{path.stem}.{name}" for name in names if name.isupper() and _is_number(module, name)}
    assert found == set(TOLD)


def _is_number(module: Any, name: str) -> bool:
    value = getattr(module, name)
    return all(isinstance(each, int | float) for each in (value if isinstance(value, tuple) else (value,)))


@pytest.mark.parametrize("value, module, name", BORDERS, ids=[f"{module}.{name}" for _, module, name in BORDERS])
def test_a_naming_border_is_what_is_told(value, module, name):
    found = getattr(import_module(f"dashpot_causes.{module}"), name)
    assert numbers(found) == pytest.approx(numbers(ast.literal_eval(value)))
