"""The header of a network: its memory and the functions on it."""

from __future__ import annotations

import re

from dashpot.kernel.ir.online import Online
from dashpot.kernel.targets.c99.watch import state_size
from dashpot.model.identified import Identified

TEXT = """\
/* {title}

   Compression positive: a displacement x > 0 (m) squeezes, a force > 0 (N) presses apart. SI units throughout.
   A step takes the motion at its end; dt is its length in s. The first step is the begin of the record, at rest. */
#ifndef {guard}
#define {guard}

#ifdef __cplusplus
extern "C" {{
#endif

#define {guard}_PARAMETERS {numbers}
#define {guard}_INPUTS {inputs}
#define {guard}_OUTPUTS {outputs}
#define {guard}_STATE {size}

/* Inputs: {input_names}
   Outputs: {output_names} */
typedef struct {{
    double state[{guard}_STATE];
    double parameters[{guard}_PARAMETERS + 1];
}} {name}_network;

typedef struct {{
    const char *name;
    const char *unit;
    double value;
}} {name}_parameter;

/* The parameters of the network, as they were exported. */
extern const {name}_parameter {name}_parameters[{guard}_PARAMETERS + 1];

/* The parameters of the export, at rest. span (m) is the span of the motion: inner nodes are solved for to a millionth
   of it. */
void {name}_init({name}_network *network, double span);
/* At rest again, with the parameters as they are. */
void {name}_reset({name}_network *network);
/* Another value of a parameter, by name, at any time; 0 where there is none of that name. */
int {name}_set({name}_network *network, const char *parameter, double value);
/* A step; see the lists above. */
void {name}_advance({name}_network *network, const double *inputs, double dt, double *outputs);
/* The acceleration of a driven node at the end of a step, of the cubic through places and velocities. */
double {name}_acceleration(const {name}_network *network, int node, double x, double v, double dt);
{step}/* How the steps went: 0 good, 1 forces at inner nodes not balanced, 2 no equilibrium, 3 a force not finite. */
int {name}_status(const {name}_network *network);
/* What of the motion has left the range of identification since the begin, as a sum:
   1 displacement, 2 speed, 4 amplitude, 8 preload, 16 frequency; the last three are known when the motion turns.
   {range} */
int {name}_outside(const {name}_network *network);
/* All that a run remembers, to go back to it. */
void {name}_get_state(const {name}_network *network, double *state);
void {name}_set_state({name}_network *network, const double *state);

#ifdef __cplusplus
}}
#endif

#endif
"""
STEP = """\
/* The force after a step to a displacement and a velocity; the acceleration follows from the cubic through both. */
double {name}_step({name}_network *network, double x, double v, double dt);
"""


def identifier(name: str) -> str:
    """A name as C takes it at the begin of others."""
    plain = re.sub(r"\W", "_", name, flags=re.ASCII)
    return plain if plain[:1].isalpha() else f"network_{plain}"


def single(online: Online) -> bool:
    """Whether one motion drives the network and nothing else does."""
    return len(online.driven) == 1 and not online.loaded


def input_names(online: Online) -> list[str]:
    """What the inputs are, in their order, e.g. ``displacement@wheel``."""
    motions = [
        _at(quantity, joint) for joint in online.driven for quantity in ("displacement", "velocity", "acceleration")
    ]
    return [*motions, *(_at("force", joint) for joint in online.loaded)]


def output_names(online: Online) -> list[str]:
    """What the outputs are, in their order: forces at driven nodes, displacements of free ones."""
    return [*(_at("force", joint) for joint in online.driven), *(_at("displacement", joint) for joint in online.free)]


def print_header(online: Online, name: str, title: str, identified: Identified) -> str:
    """The text of the header."""
    told = f"Identified with {identified.told()}." if identified.range else "The range is not known: always 0."
    own = identifier(name)
    return TEXT.format(
        title=comment(title),
        name=own,
        guard=own.upper(),
        numbers=len(online.numbers),
        inputs=online.inputs,
        outputs=online.before - online.outputs,
        size=state_size(online, identified.range),
        input_names=comment(", ".join(input_names(online))),
        output_names=comment(", ".join(output_names(online))),
        range=comment(told),
        step=STEP.format(name=own) if single(online) else "",
    )


def comment(text: str) -> str:
    """A text on one line that does not end the comment that it stands in."""
    plain = re.sub(r"[\s\\]+", " ", text)
    return plain.replace("*/", "* /").replace("/*", "/ *")


def _at(quantity: str, joint: str) -> str:
    return f"{quantity}@{joint}" if joint else quantity
