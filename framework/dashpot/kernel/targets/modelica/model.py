"""The model of a network with two ends: it samples its deflection, and holds the force between two samples."""

from __future__ import annotations

import re
from collections.abc import Sequence

from dashpot.kernel.ir.online import BEGUN, INPUTS, Online
from dashpot.kernel.targets.modelica.code import ModelicaCode
from dashpot.kernel.targets.scalar.code import Arguments
from dashpot.kernel.targets.scalar.whole import write_network

TEXT = """\
package {name} "{title}"
  extends Modelica.Icons.Package;

  model Specimen "Force between two flanges, sampled"
    Modelica.Mechanics.Translational.Interfaces.Flange_a flange_a "Squeezes where it moves ahead of flange_b";
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange_b;
    parameter Modelica.Units.SI.Time step = 0.001 "Between two samples";
    parameter Modelica.Units.SI.Length free = 0.0 "Distance of the flanges where the deflection is zero";
{parameters}
    Modelica.Units.SI.Position x "Deflection, compression positive";
    Modelica.Units.SI.Velocity v "Its rate";
    discrete Modelica.Units.SI.Force force(start = 0.0, fixed = true) "Presses the flanges apart";
  protected
    discrete Real memory[{size}](each start = 0.0, each fixed = true);
  equation
    x = flange_a.s - flange_b.s + free;
    v = der(x);
    when sample(0.0, step) then
      memory = Law.sampled(pre(memory), step, {{{names}}}, x, v);
      force = memory[{force}];
    end when;
    flange_a.f = force;
    flange_b.f = -force;
  end Specimen;

  package Law "The step from sample to sample"
    extends Modelica.Icons.FunctionsPackage;

{functions}
  end Law;
end {name};
"""
SAMPLED: Arguments = [("array", "s"), ("number", "dt"), ("array", "p"), ("number", "x"), ("number", "v")]


def print_model(online: Online, name: str, title: str, values: Sequence[float], units: Sequence[str]) -> str:
    """The text of a package with the ``values`` and ``units`` of the numbers as parameters of its model."""
    code = ModelicaCode()
    write_network(code, online)
    with code.function("nothing", "sampled", SAMPLED, "The memory after a sample of the motion."):
        old = online.before
        with code.when(f"s[{BEGUN}] == 0.0"):
            code.set(f"s[{INPUTS + 2}]", "0.0")
        with code.otherwise():
            code.set(f"s[{INPUTS + 2}]", f"(6.0 * (s[{old}] - x) / dt + 2.0 * s[{old + 1}] + 4.0 * v) / dt")
        code.set(f"s[{INPUTS}]", "x")
        code.set(f"s[{INPUTS + 1}]", "v")
        code.do("advance(s, dt, p)")
    rows = [f'    parameter Real {parameter(path)}(unit = "{unit}") = {code.number(float(value))};'
            for path, value, unit in zip(online.numbers, values, units, strict=True)]  # fmt: skip
    return TEXT.format(name=name, title=title.replace("\\", "\\\\").replace('"', '\\"'), size=online.size,
                       parameters="\n".join(rows), names=", ".join(map(parameter, online.numbers)),
                       force=online.outputs + 1, functions=code.text.rstrip())  # fmt: skip


def parameter(path: str) -> str:
    """The name of a parameter: that of the number, in quotes."""
    return f"'{re.sub(r'[^!-&(-~]', '_', path)}'"
