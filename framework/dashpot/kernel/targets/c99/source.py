"""The source of a network."""

from __future__ import annotations

from collections.abc import Sequence

from dashpot.kernel.ir.online import BEGUN, DT, INPUTS, NOT_FINITE, SPAN, STATUS, Online
from dashpot.kernel.ir.system import SMALLEST_SPAN
from dashpot.kernel.targets.c99.code import CCode
from dashpot.kernel.targets.c99.header import identifier, single
from dashpot.kernel.targets.c99.watch import flag_place, state_size, watch_call, watch_text
from dashpot.kernel.targets.scalar.whole import write_network
from dashpot.model.identified import Range

TEXT = """\

const {name}_parameter {name}_parameters[{count} + 1] = {{
{numbers}
    {{0, 0, 0.0}}
}};

void {name}_init({name}_network *network, double span)
{{
    for (int k = 0; k < {count}; ++k) {{
        network->parameters[k] = {name}_parameters[k].value;
    }}
    network->state[{SPAN}] = span > {smallest} ? span : {smallest};
    {name}_reset(network);
}}

void {name}_reset({name}_network *network)
{{
    const double span = network->state[{SPAN}];
    for (int k = 0; k < {size}; ++k) {{
        network->state[k] = 0.0;
    }}
    network->state[{SPAN}] = span;
}}

static inline int same_name(const char *one, const char *other)
{{
    while (*one && *one == *other) {{
        ++one;
        ++other;
    }}
    return *one == *other;
}}

int {name}_set({name}_network *network, const char *parameter, double value)
{{
    for (int k = 0; k < {count}; ++k) {{
        if (same_name(parameter, {name}_parameters[k].name)) {{
            network->parameters[k] = value;
            network->state[{DT}] = 0.0;
            return 1;
        }}
    }}
    return 0;
}}

void {name}_advance({name}_network *network, const double *inputs, double dt, double *outputs)
{{
    double *s = network->state;
{begun}    for (int k = 0; k < {inputs}; ++k) {{
        s[{INPUTS} + k] = inputs[k];
    }}
    advance(s, dt, network->parameters);
{watching}    for (int k = 0; k < {answers}; ++k) {{
        outputs[k] = s[{outputs} + k];
        if (!isfinite(outputs[k])) {{
            s[{STATUS}] = {NOT_FINITE}.0;
        }}
    }}
}}

double {name}_acceleration(const {name}_network *network, int node, double x, double v, double dt)
{{
    const double *before = network->state + {before} + 3 * node;
    if (network->state[{BEGUN}] == 0.0) {{
        return 0.0;
    }}
    return (6.0 * (before[0] - x) / dt + 2.0 * before[1] + 4.0 * v) / dt;
}}
{step}
int {name}_status(const {name}_network *network)
{{
    return (int)network->state[{STATUS}];
}}

int {name}_outside(const {name}_network *network)
{{
    return (int)network->state[{flag}];
}}

void {name}_get_state(const {name}_network *network, double *state)
{{
    for (int k = 0; k < {size}; ++k) {{
        state[k] = network->state[k];
    }}
}}

void {name}_set_state({name}_network *network, const double *state)
{{
    for (int k = 0; k < {size}; ++k) {{
        network->state[k] = state[k];
    }}
}}
"""
STEP = """
double {name}_step({name}_network *network, double x, double v, double dt)
{{
    double inputs[3] = {{x, v, {acceleration}}}, outputs[{answers}];
    {name}_advance(network, inputs, dt, outputs);
    return outputs[0];
}}
"""


def print_source(online: Online, name: str, values: Sequence[float], units: Sequence[str], seen: Range) -> str:
    """The text of the source, with the ``values`` and ``units`` of its numbers and the range that was ``seen``."""
    code, own = CCode(), identifier(name)
    code.lines += [f'#include "{own}.h"', "", "#include <math.h>"]
    write_network(code, online)
    rows = [
        f'    {{"{path}", "{unit}", {code.number(float(value))}}},'
        for path, value, unit in zip(online.numbers, values, units, strict=True)
    ]
    places = {
        "name": own,
        "count": len(online.numbers),
        "size": state_size(online, seen),
        "inputs": online.inputs,
        "answers": online.before - online.outputs,
        "outputs": online.outputs,
        "before": online.before,
        "DT": DT,
        "SPAN": SPAN,
        "STATUS": STATUS,
        "BEGUN": BEGUN,
        "INPUTS": INPUTS,
        "acceleration": f"{own}_acceleration(network, 0, x, v, dt)" if online.accelerated else "0.0",
        "NOT_FINITE": NOT_FINITE,
        "smallest": SMALLEST_SPAN,
    }
    step = STEP.format(**places) if single(online) else ""
    watching = watch_call(online, seen, "begun")
    begun = f"    const int begun = s[{BEGUN}] != 0.0;\n" if watching else ""
    rest = TEXT.format(
        numbers="\n".join(rows), step=step, begun=begun, watching=watching, flag=flag_place(online), **places
    )
    return code.text + watch_text(online, seen) + rest
