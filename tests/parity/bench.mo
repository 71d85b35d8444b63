// What an exported model uses of the Modelica Standard Library, for compilers that come without it, and a bench around
// the model of NETWORK.
package Modelica
  package Constants
    constant Real inf = 1.0e300;
  end Constants;
  package Icons
    partial package Package
    end Package;
    partial package FunctionsPackage
    end FunctionsPackage;
    partial function Function
    end Function;
  end Icons;
  package Units
    package SI
      type Time = Real(unit = "s");
      type Length = Real(unit = "m");
      type Position = Length;
      type Velocity = Real(unit = "m/s");
      type Force = Real(unit = "N");
    end SI;
  end Units;
  package Mechanics
    package Translational
      package Interfaces
        connector Flange_a
          Modelica.Units.SI.Position s;
          flow Modelica.Units.SI.Force f;
        end Flange_a;
        connector Flange_b
          Modelica.Units.SI.Position s;
          flow Modelica.Units.SI.Force f;
        end Flange_b;
      end Interfaces;
    end Translational;
  end Mechanics;
end Modelica;

model Driven "Moves a flange by 4 mm around 15 mm"
  Modelica.Mechanics.Translational.Interfaces.Flange_a flange;
equation
  flange.s = 15e-3 + 4e-3 * sin(60.0 * time);
end Driven;

model Held "Holds a flange"
  Modelica.Mechanics.Translational.Interfaces.Flange_a flange;
equation
  flange.s = 0.0;
end Held;

model Bench
  NETWORK.Specimen specimen(step = 1e-3);
  Driven driven;
  Held held;
equation
  connect(driven.flange, specimen.flange_a);
  connect(specimen.flange_b, held.flange);
end Bench;
