"""A functional mock-up unit by FMI 3.0."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement

from dashpot.model.identified import Range
from dashpot_exports.unit import MockUpUnit
from dashpot_exports.variables import Variable

if TYPE_CHECKING:
    from dashpot.kernel.export import Exported

KINDS = {"Real": "Float64", "Integer": "Int32"}


class Fmu(MockUpUnit):
    """A functional mock-up unit (FMI 3.0, co-simulation) with its sources, built for this machine by ``cc``."""

    word = "fmu"
    wrapper = "fmi3.c"

    def platform(self, system: str, machine: str) -> str:
        """As FMI 3.0 calls it."""
        return f"{machine}-{system}"

    def root(self, name: str, token: str, about: str) -> Element:
        """The head of the description."""
        return Element(
            "fmiModelDescription",
            fmiVersion="3.0",
            modelName=name,
            instantiationToken=token,
            description=about,
            generationTool="dashpot",
        )

    def declare(self, root: Element, name: str, found: Exported) -> None:
        """What the unit can do."""
        SubElement(
            root,
            "CoSimulation",
            modelIdentifier=name,
            canGetAndSetFMUState="true",
            canSerializeFMUState="true",
            canHandleVariableCommunicationStepSize=str(found.online.system is None).lower(),
        )

    def add_variable(self, parent: Element, number: int, variable: Variable) -> None:
        """A variable with its interval."""
        kind = KINDS[variable.kind]
        element = SubElement(parent, kind, {"valueReference": str(number), **variable.attributes()})
        if kind == "Float64":
            element.attrib |= variable.real_attributes()
        if variable.interval:
            note = SubElement(SubElement(element, "Annotations"), "Annotation", type="dashpot.interval")
            note.text = variable.interval

    def add_structure(self, root: Element, outputs: list[int]) -> None:
        """Which variables are answers."""
        structure = SubElement(root, "ModelStructure")
        for name in ("Output", "InitialUnknown"):
            for number in outputs:
                SubElement(structure, name, valueReference=str(number))

    def add_range(self, root: Element, seen: Range) -> None:
        """An annotation for each quantity."""
        notes = SubElement(root, "Annotations") if seen else root
        for name, (least, largest) in seen.items():
            SubElement(notes, "Annotation", type=f"dashpot.identified.{name}").text = f"{least!r} {largest!r}"

    def build_description(self, name: str, sources: list[str]) -> bytes:
        """How to build the unit from its sources."""
        return self.text_of(_build(name, sources))


def _build(name: str, sources: list[str]) -> Element:
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=name)
    files = SubElement(configuration, "SourceFileSet", language="C99")
    for source in sources:
        SubElement(files, "SourceFile", name=source)
    return root
