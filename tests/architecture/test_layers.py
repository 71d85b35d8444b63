"""Imports go one way only, and the framework does not know its plugins."""

from __future__ import annotations

import sys

import pytest
from architecture.packaging import distributions_of, plugin_packages, requirements
from architecture.source import FRAMEWORK, PLUGINS, at, imports, modules, texts

LAYERS = (
    {"text", "expr"},
    {"model", "data"},
    {"contract"},
    {"kernel"},
    {"fit"},
    {"triage"},
    {"compare"},
    {"diagnose", "study"},
    {"campaign"},
    {"report"},
    {"cli", "notebook"},
)
# words of channels and of result files (the gain of a cause), which some causes have for their names, too
ORDINARY_WORDS = {"gain", "offset", "delay", "drift", "clipping", "hum"}
RANK = {layer: rank for rank, layers in enumerate(LAYERS) for layer in layers}


def test_every_folder_of_the_framework_is_a_layer():
    folders = {path.parent.relative_to(FRAMEWORK).parts[0] for path in modules(FRAMEWORK) if path.parent != FRAMEWORK}
    assert folders - {"testing"} <= set(RANK)


@pytest.mark.parametrize("layer", sorted(RANK))
def test_a_layer_imports_only_from_its_left(layer):
    wrong = [
        f"{at(path, line)} imports {name}"
        for path in modules(FRAMEWORK / layer)
        for name, line in imports(path)
        if name.startswith("dashpot.") and not _may_import(layer, name.split(".")[1])
    ]
    assert not wrong, "\n".join(wrong)


# inside the kernel: what a program is knows neither how it is made nor how it is printed
SEALED = {"ir": ("compiler", "targets"), "compiler": ("targets",), "targets": ("compiler",)}


@pytest.mark.parametrize("folder", sorted(SEALED))
def test_compiler_and_targets_share_the_program_alone(folder):
    wrong = [
        f"{at(path, line)} imports {name}"
        for path in modules(FRAMEWORK / "kernel" / folder)
        for name, line in imports(path)
        if name.startswith(tuple(f"dashpot.kernel.{other}" for other in SEALED[folder]))
    ]
    assert not wrong, "\n".join(wrong)


def test_no_target_knows_another():
    folder = FRAMEWORK / "kernel" / "targets"
    languages = {path.name for path in folder.iterdir() if path.is_dir() and path.name != "__pycache__"}
    wrong = [
        f"{at(path, line)} imports {name}"
        for language in languages
        for path in modules(folder / language)
        for name, line in imports(path)
        if name.startswith(tuple(f"dashpot.kernel.targets.{other}" for other in languages - {language, "scalar"}))
    ]
    assert not wrong, "\n".join(wrong)


def _may_import(layer: str, other: str) -> bool:
    # the package itself offers its version
    return other in (layer, "__version__") or RANK.get(other, len(LAYERS)) < RANK[layer]


def test_the_framework_imports_no_plugin():
    packages = plugin_packages()
    wrong = [
        at(path, line) for path in modules(FRAMEWORK) for name, line in imports(path) if name.split(".")[0] in packages
    ]
    assert not wrong, "\n".join(wrong)


def test_the_framework_names_no_plugin():
    wrong = [
        f"{at(path, line)}: {text!r}"
        for path in modules(FRAMEWORK)
        for text, line in texts(path)
        if any(package in text for package in plugin_packages())
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("kind", ["elements", "optimizers", "causes"])
def test_the_framework_singles_out_no_thing_of_a_plugin(kind):
    from dashpot import load_registry

    words = set(load_registry().of(kind))
    assert words
    wrong = [
        f"{at(path, line)}: {text!r}"
        for path in modules(FRAMEWORK)
        for text, line in texts(path)
        if text in words and not (kind == "causes" and text in ORDINARY_WORDS)
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("package", sorted(plugin_packages()))
def test_a_plugin_knows_only_dashpot_and_libraries(package):
    wrong = [
        f"{at(path, line)} imports {name}"
        for path in modules(PLUGINS / package)
        for name, line in imports(path)
        if name.split(".")[0] in plugin_packages() - {package}
    ]
    assert not wrong, "\n".join(wrong)


def test_everything_imported_is_a_declared_requirement():
    ours = plugin_packages() | {"dashpot"}
    declared = requirements()
    wrong = [
        f"{at(path, line)} imports {name}"
        for folder in (FRAMEWORK, PLUGINS)
        for path in modules(folder)
        for name, line in imports(path)
        if (root := name.split(".")[0]) not in ours
        and root not in sys.stdlib_module_names
        and not declared & distributions_of(root)
    ]
    assert not wrong, "\n".join(wrong)
