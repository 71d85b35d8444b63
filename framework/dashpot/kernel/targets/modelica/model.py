"""The model of a network: it samples the motion of its flanges, and holds the forces between two samples."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from math import isfinite

from dashpot.kernel.export import Exported
from dashpot.kernel.ir.online import BEGUN, INPUTS, MOTION, SPAN, STATUS, Online
from dashpot.kernel.targets.modelica.code import ModelicaCode
from dashpot.kernel.targets.scalar.code import Arguments
from dashpot.kernel.targets.scalar.whole import write_network
from dashpot.model.network import END

TEXT = """\
package {name} "{title}"
  extends Modelica.Icons.Package;

  model Specimen "{about}"
{connectors}
    parameter Modelica.Units.SI.Time step = 0.001 "Between two samples";
{options}
{parameters}
    Modelica.Units.SI.Position x[{driven}] "{motion}";
    Modelica.Units.SI.Velocity v[{driven}] "Its rate";
    discrete Modelica.Units.SI.Force force[{driven}](each start = 0.0, each fixed = true) "{sign}";
{places}
  protected
    discrete Real memory[{size}](each start = 0.0, each fixed = true);
  equation
{equations}
    v = der(x);
    when sample(0.0, step) then
      memory = Law.sampled(pre(memory), step, {numbers}, x, v, {loads}, {span});
      force = memory[{force}:{last}];
{found}
    end when;
  end Specimen;

  package Law "The step from sample to sample"
    extends Modelica.Icons.FunctionsPackage;

{functions}
  end Law;

  annotation (Documentation(info = "<html>
{documentation}
</html>"));
end {name};
"""
FACTOR = re.compile(r"([*/]?)(?:\((.*?)\)|([^*/^()]+)(?:\^([^*/]+))?)")
FLANGE = "Modelica.Mechanics.Translational.Interfaces.Flange_"
UNSOLVED = 'assert(memory[{status}] < 0.5, "Forces at inner nodes are not balanced.", AssertionLevel.warning);'
SAMPLED: Arguments = [
    ("array", "s"),
    ("number", "dt"),
    ("array", "p"),
    ("array", "x"),
    ("array", "v"),
    ("array", "load"),
    ("number", "span"),
]


def print_model(found: Exported, name: str, documentation: str) -> str:
    """The text of a package of that name; its ``documentation`` is HTML."""
    online, code = found.online, ModelicaCode()
    write_network(code, online)
    _write_sampled(code, online)
    parts = _two_ends() if online.driven == (END,) else _nodes(online)
    if online.system:
        parts["equations"] += f"\n    {UNSOLVED.format(status=STATUS + 1)}"
        parts["options"] += '\n    parameter Modelica.Units.SI.Length span = 0.05 "How far the motion goes";'
    text = TEXT.format(
        name=name,
        title=quoted(found.title),
        documentation=quoted(documentation),
        size=online.size,
        parameters="\n".join(_parameters(found, code)),
        numbers=_listed(map(parameter, online.numbers)),
        driven=len(online.driven),
        force=online.outputs + 1,
        last=online.outputs + len(online.driven),
        span="span" if online.system else "0.0",
        loads=_listed(f"load_{plain(node)}" for node in online.loaded),
        functions=code.text.rstrip(),
        places="\n".join(
            f"    discrete Modelica.Units.SI.Position place_{plain(node)}(start = 0.0, fixed = true);"
            for node in _named(online)
        ),
        found="\n".join(f"      place_{plain(node)} = memory[{number}];" for node, number in _named(online).items()),
        **parts,
    )
    return "\n".join(line for line in text.splitlines() if line.strip() or not line) + "\n"


def _parameters(found: Exported, code: ModelicaCode) -> Iterator[str]:
    for slot, value, about in zip(found.slots, found.values, found.abouts, strict=True):
        ends = slot.value.interval
        known = f", 95 % interval {ends[0]:.6g} to {ends[1]:.6g}" if ends and all(map(isfinite, ends)) else ""
        unit = unit_of(slot.value.unit)
        head = f"    parameter Real {parameter(slot.path)}" + (f'(unit = "{unit}")' if unit else "")
        yield f'{head} = {code.number(value)} "{quoted(about + known)}";'


def _two_ends() -> dict[str, str]:
    return {
        "about": "Force between two flanges, sampled",
        "motion": "Deflection, compression positive",
        "sign": "Presses the flanges apart",
        "connectors": f'    {FLANGE}a flange_a "Squeezes where it moves ahead of flange_b";\n    {FLANGE}b flange_b;',
        "options": '    parameter Modelica.Units.SI.Length free = 0.0 "Distance of the flanges where the deflection is '
        'zero";',
        "equations": "    x[1] = flange_a.s - flange_b.s + free;\n    flange_a.f = force[1];\n"
        "    flange_b.f = -force[1];",
    }


def _nodes(online: Online) -> dict[str, str]:
    """A flange for each driven node, an input for each load."""
    flanges = [f"    {FLANGE}a flange_{plain(node)};" for node in online.driven]
    loads = [f'    Modelica.Blocks.Interfaces.RealInput load_{plain(node)}(unit = "N");' for node in online.loaded]
    equations = [
        f"    x[{number}] = flange_{plain(node)}.s;\n    flange_{plain(node)}.f = force[{number}];"
        for number, node in enumerate(online.driven, 1)
    ]
    return {
        "about": "Forces at the flanges, sampled",
        "motion": "Of the flanges, upwards",
        "sign": "On the network at the flanges, upwards",
        "connectors": "\n".join(flanges + loads),
        "options": "",
        "equations": "\n".join(equations),
    }


def _named(online: Online) -> dict[str, int]:
    """The free nodes that the network names, and where their positions stand."""
    first = online.outputs + len(online.driven) + 1
    return {node: first + number for number, node in enumerate(online.free) if ":" not in node}


def _listed(names: Iterable[str]) -> str:
    found = ", ".join(names)
    return f"{{{found}}}" if found else "fill(0.0, 0)"


def _write_sampled(code: ModelicaCode, online: Online) -> None:
    with code.function("nothing", "sampled", SAMPLED, "The memory after a sample of the motion."):
        with code.when(f"s[{BEGUN}] == 0.0"):
            code.set(f"s[{SPAN}]", "span")
            for number in range(len(online.driven)):
                code.set(f"s[{INPUTS + len(MOTION) * number + 2}]", "0.0")
        with code.otherwise():
            for number in range(len(online.driven)):
                old = online.before + len(MOTION) * number
                bent = f"6.0 * (s[{old}] - x[{number}]) / dt + 2.0 * s[{old + 1}] + 4.0 * v[{number}]"
                code.set(f"s[{INPUTS + len(MOTION) * number + 2}]", f"({bent}) / dt")
        for number in range(len(online.driven)):
            code.set(f"s[{INPUTS + len(MOTION) * number}]", f"x[{number}]")
            code.set(f"s[{INPUTS + len(MOTION) * number + 1}]", f"v[{number}]")
        for number in range(len(online.loaded)):
            code.set(f"s[{INPUTS + len(MOTION) * len(online.driven) + number}]", f"load[{number}]")
        code.do("advance(s, dt, p)")


def quoted(text: str) -> str:
    """A text as it stands between quotes."""
    return text.replace("\\", "\\\\").replace('"', '\\"')


def unit_of(text: str) -> str:
    """A unit as the language writes it: ``N*s^2/m^2`` is ``N.s2/m2``; empty where a power is not whole."""
    factors = list(_factors(text, 1.0))
    if not all(power.is_integer() for _, power in factors):
        return ""
    above, below = (
        [f"{name}{int(abs(power)) if abs(power) > 1.0 else ''}" for name, power in factors if side * power > 0.0]
        for side in (1.0, -1.0)
    )
    return ".".join(above or ["1"]) + ("/" + (below[0] if len(below) == 1 else f"({'.'.join(below)})") if below else "")


def _factors(text: str, sign: float) -> Iterator[tuple[str, float]]:
    for operator, group, name, power in FACTOR.findall(text):
        side = -sign if operator == "/" else sign
        if group:
            yield from _factors(group, side)
        elif name != "1":
            yield name, side * float(power or 1.0)


def plain(node: str) -> str:
    """The name of a node as part of another one."""
    return re.sub(r"\W", "_", node, flags=re.ASCII)


def parameter(path: str) -> str:
    """The name of a parameter: that of the number, in quotes."""
    return f"'{re.sub(r'[^!-&(-~]', '_', path)}'"
