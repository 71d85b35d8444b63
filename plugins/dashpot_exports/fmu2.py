"""A functional mock-up unit by FMI 2.0."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement

from dashpot.model.identified import Range
from dashpot_exports.unit import MockUpUnit
from dashpot_exports.variables import Variable

if TYPE_CHECKING:
    from dashpot.kernel.export import Exported

SYSTEMS = {"linux": "linux", "windows": "win", "darwin": "darwin"}


class Fmu2(MockUpUnit):
    """A functional mock-up unit (FMI 2.0, co-simulation) with its sources, built for this machine by ``cc``."""

    word = "fmu2"
    wrapper = "fmi2.c"

    def platform(self, system: str, machine: str) -> str:
        """As FMI 2.0 calls it."""
        return f"{SYSTEMS[system]}64"

    def root(self, name: str, token: str, about: str) -> Element:
        """The head of the description."""
        return Element(
            "fmiModelDescription",
            fmiVersion="2.0",
            modelName=name,
            guid=token,
            description=about,
            generationTool="dashpot",
            variableNamingConvention="flat",
        )

    def declare(self, root: Element, name: str, found: Exported) -> None:
        """What the unit can do."""
        simulation = SubElement(
            root,
            "CoSimulation",
            modelIdentifier=name,
            canGetAndSetFMUstate="true",
            canSerializeFMUstate="true",
            canHandleVariableCommunicationStepSize=str(found.online.system is None).lower(),
        )
        files = SubElement(simulation, "SourceFiles")
        for source in (self.wrapper, f"{name}.c"):
            SubElement(files, "File", name=source)

    def add_variable(self, parent: Element, number: int, variable: Variable) -> None:
        """A variable with its interval."""
        element = SubElement(parent, "ScalarVariable", {"valueReference": str(number), **variable.attributes()})
        SubElement(element, variable.kind, variable.real_attributes() if variable.kind == "Real" else {})
        if variable.interval:
            tool = SubElement(SubElement(element, "Annotations"), "Tool", name="dashpot")
            SubElement(tool, "interval").text = variable.interval

    def add_structure(self, root: Element, outputs: list[int]) -> None:
        """Which variables are answers, counted from 1."""
        structure = SubElement(root, "ModelStructure")
        for name in ("Outputs", "InitialUnknowns"):
            parent = SubElement(structure, name)
            for number in outputs:
                SubElement(parent, "Unknown", index=str(number + 1))

    def add_range(self, root: Element, seen: Range) -> None:
        """Annotations of the vendor, which stand before the variables."""
        if seen:
            notes = Element("VendorAnnotations")
            identified = SubElement(SubElement(notes, "Tool", name="dashpot"), "identified")
            for name, (least, largest) in seen.items():
                SubElement(identified, "range", quantity=name).text = f"{least!r} {largest!r}"
            root.insert([part.tag for part in root].index("ModelVariables"), notes)

    def build_description(self, name: str, sources: list[str]) -> None:
        """FMI 2.0 has none."""
