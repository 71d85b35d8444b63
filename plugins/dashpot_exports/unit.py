"""What the mock-up units of both versions share: the archive, its description, and the shared library in it."""

from __future__ import annotations

import io
import platform
import subprocess
import sys
import tempfile
from abc import abstractmethod
from collections.abc import Mapping
from importlib.resources import files as resources
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar
from xml.etree.ElementTree import Element, SubElement, indent, tostring
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from dashpot.contract.export import Export
from dashpot.model.identified import Range
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError, Place
from dashpot_exports.variables import Variable, add_unit, variables_of

if TYPE_CHECKING:
    from dashpot.kernel.export import Exported

SPAN, STEP = 0.05, 1e-3  # how far the motion is expected to go, m; the step of a default experiment, s
LIBRARIES = {"linux": ".so", "darwin": ".dylib", "windows": ".dll"}
MACHINES = {"x86_64": "x86_64", "amd64": "x86_64", "arm64": "aarch64", "aarch64": "aarch64"}
COMPILER = ("cc", "-std=c99", "-O2", "-shared", "-fPIC", "-fvisibility=hidden", "-Wall", "-Wextra", "-Werror")
MODEL = """\
/* Which network this unit is of. */
#ifndef MODEL_H
#define MODEL_H

#include "{name}.h"

#define NETWORK {name}_network
#define INIT {name}_init
#define ADVANCE {name}_advance
#define ACCELERATION {name}_acceleration
#define SET {name}_set
#define STATUS {name}_status
#define OUTSIDE {name}_outside
#define NAMES {name}_parameters
#define PARAMETERS {guard}_PARAMETERS
#define OUTPUTS {guard}_OUTPUTS
#define DRIVEN {driven}
#define LOADED {loaded}
#define SPAN {span}
#define STEP {step}
#define TOKEN "{token}"

#endif
"""


class MockUpUnit(Export):
    """A unit of one version of the interface."""

    wrapper: ClassVar[str]
    """The source of the functions of the interface."""

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``NAME.fmu``. InputError where there is no C compiler, or it refuses the sources."""
        from dashpot.kernel.export import digest_of, exported
        from dashpot.kernel.targets.c99.header import identifier

        found, name = exported(network), identifier(network.name)
        token = digest_of(network)
        sources = self.sources(found, name, token)
        content = {"modelDescription.xml": self.description(found, name, token)}
        content |= {f"sources/{file}": text for file, text in sources.items()}
        build = self.build_description(name, [self.wrapper, f"{name}.c"])
        if build is not None:
            content["sources/buildDescription.xml"] = build
        system = "windows" if sys.platform == "win32" else sys.platform
        folder = self.platform(system, MACHINES[platform.machine().lower()])
        library = f"{name}{LIBRARIES[system]}"
        content[f"binaries/{folder}/{library}"] = compiled(sources, [self.wrapper, f"{name}.c"], library)
        return {f"{name}.fmu": archive(content)}

    def sources(self, found: Exported, name: str, token: str) -> dict[str, bytes]:
        """The sources by name."""
        from dashpot.kernel.targets.c99.header import print_header
        from dashpot.kernel.targets.c99.source import print_source

        online = found.online
        model = MODEL.format(
            name=name,
            guard=name.upper(),
            driven=len(online.driven),
            loaded=len(online.loaded),
            span=SPAN,
            step=STEP,
            token=token,
        )
        own, spec = resources(__package__), found.spec
        source = print_source(online, spec.name, found.values, found.units, spec.identified.range)
        return {
            f"{name}.h": print_header(online, spec.name, found.title, spec.identified).encode(),
            f"{name}.c": source.encode(),
            "model.h": model.encode(),
            **{file: (own / file).read_bytes() for file in ("component.h", self.wrapper)},
        }

    def description(self, found: Exported, name: str, token: str) -> bytes:
        """``modelDescription.xml``."""
        root, variables = self.root(name, token, found.title), variables_of(found)
        self.declare(root, name, found)
        units = SubElement(root, "UnitDefinitions")
        for unit in sorted({each.unit for each in variables} - {"", "1"}):
            add_unit(units, unit)
        SubElement(root, "DefaultExperiment", startTime="0", stepSize=repr(STEP))
        parent = SubElement(root, "ModelVariables")
        for number, variable in enumerate(variables):
            self.add_variable(parent, number, variable)
        outputs = [number for number, each in enumerate(variables) if each.causality == "output"]
        self.add_structure(root, outputs)
        self.add_range(root, found.spec.identified.range)
        return self.text_of(root)

    def text_of(self, root: Element) -> bytes:
        """The text of a tree."""
        indent(root)
        return tostring(root, encoding="UTF-8", xml_declaration=True)

    @abstractmethod
    def platform(self, system: str, machine: str) -> str:
        """The folder of the shared library."""

    @abstractmethod
    def root(self, name: str, token: str, about: str) -> Element:
        """The head of the description."""

    @abstractmethod
    def declare(self, root: Element, name: str, found: Exported) -> None:
        """What the unit can do."""

    @abstractmethod
    def add_variable(self, parent: Element, number: int, variable: Variable) -> None:
        """A variable."""

    @abstractmethod
    def add_structure(self, root: Element, outputs: list[int]) -> None:
        """Which variables are answers."""

    @abstractmethod
    def add_range(self, root: Element, seen: Range) -> None:
        """The least and the largest of the motions with which the parameters were identified."""

    @abstractmethod
    def build_description(self, name: str, sources: list[str]) -> bytes | None:
        """How to build the unit from its sources, where the version says it in a file."""


def compiled(sources: Mapping[str, bytes], names: list[str], library: str) -> bytes:
    """The shared library of some sources."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in sources.items():
            (Path(folder) / name).write_bytes(text)
        command = [*COMPILER, "-o", library, *names, "-lm"]
        try:
            subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
        except FileNotFoundError:
            raise InputError.at(
                Place(),
                "a mock-up unit needs the C compiler 'cc', which is not there",
                "install one, or export with --to c and build elsewhere",
            ) from None
        except subprocess.CalledProcessError as error:
            first = (error.stderr or "").strip().partition("\n")[0]
            raise InputError.at(
                Place(), f"the C compiler refused the sources: {first}", "export with --to c to see them"
            ) from None
        return (Path(folder) / library).read_bytes()


def archive(content: Mapping[str, bytes]) -> bytes:
    """A zip file without dates: the same content gives the same bytes."""
    found = io.BytesIO()
    with ZipFile(found, "w", ZIP_DEFLATED) as zipped:
        for name, text in content.items():
            info = ZipInfo(name)
            info.compress_type = ZIP_DEFLATED
            zipped.writestr(info, text)
    return found.getvalue()
