"""Whether the motion of a C network leaves the range in which its numbers were identified.

The memory of a network ends with what has been outside so far, the time since the begin, and, for every driven node,
how the motion turned last.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from dashpot.kernel.ir.online import MOTION, Online
from dashpot.kernel.targets.c99.code import CCode
from dashpot.model.identified import QUANTITIES, Range, widened

PLACES = 8  # of a driven node: begun, way, high, low, when high, when low, the last turning point, when
TEXT = """
/* Least and largest of {quantities}, for every driven node; strokes below the first amplitude count as no turn. */
static const double limits[{count}][{twice}] = {{
{rows}
}};

static inline int beyond(const double *limit, int quantity, double value)
{{
    return value >= limit[2 * quantity] && value <= limit[2 * quantity + 1] ? 0 : 1 << quantity;
}}

/* A turning point: its half cycle is compared, if one came before. */
static int turned(const double *limit, double *w, double place, double when, int way)
{{
    int outside = 0;
    if (w[1] * way < 0.0) {{
        if (w[7] >= 0.0) {{
            outside |= 0.5 * fabs(place - w[6]) > limit[5] ? 1 << 2 : 0;
            outside |= beyond(limit, 3, 0.5 * (place + w[6]));
            outside |= beyond(limit, 4, 0.5 / (when - w[7]));
        }}
        w[6] = place;
        w[7] = when;
    }}
    w[1] = way;
    return outside;
}}

static void watch(double *s, int node, double x, double v)
{{
    const double *limit = limits[node], now = s[{clock}];
    double *w = s + {first} + {places} * node;
    int outside = (int)s[{flag}] | beyond(limit, 0, x) | beyond(limit, 1, fabs(v));
    if (w[0] == 0.0) {{
        w[0] = 1.0;
        w[7] = -1.0;
        w[2] = w[3] = x;
        w[4] = w[5] = now;
    }}
    if (x > w[2]) {{
        w[2] = x;
        w[4] = now;
    }}
    if (x < w[3]) {{
        w[3] = x;
        w[5] = now;
    }}
    if (w[1] >= 0.0 && w[2] - x > limit[4]) {{
        outside |= turned(limit, w, w[2], w[4], -1);
        w[3] = x;
        w[5] = now;
    }} else if (w[1] <= 0.0 && x - w[3] > limit[4]) {{
        outside |= turned(limit, w, w[3], w[5], 1);
        w[2] = x;
        w[4] = now;
    }}
    s[{flag}] = outside;
}}
"""
CALL = """\
    s[{clock}] += {begun} dt : 0.0;
    for (int k = 0; k < {count}; ++k) {{
        watch(s, k, inputs[{per} * k], inputs[{per} * k + 1]);
    }}
"""


def flag_place(online: Online) -> int:
    """Where in the memory it stands what was outside so far."""
    return online.size


def state_size(online: Online, seen: Range) -> int:
    """How many numbers the whole memory of a C network has."""
    return online.size + 2 + PLACES * len(online.driven) * bool(watched(online, seen))


def watched(online: Online, seen: Range) -> list[str]:
    """The driven nodes whose motion is compared."""
    return [node for node in online.driven if _name("displacement", node) in seen]


def watch_text(online: Online, seen: Range) -> str:
    """The functions; empty where no range is known."""
    if not watched(online, seen):
        return ""
    rows = ",\n".join(f"    {{{', '.join(_limits(node, seen))}}}" for node in online.driven)
    return TEXT.format(
        quantities=", ".join(QUANTITIES),
        count=len(online.driven),
        twice=2 * len(QUANTITIES),
        rows=rows,
        clock=online.size + 1,
        first=online.size + 2,
        places=PLACES,
        flag=flag_place(online),
    )


def watch_call(online: Online, seen: Range, begun: str) -> str:
    """The lines of ``advance`` that look at a sample; ``begun`` is true where one came before."""
    if not watched(online, seen):
        return ""
    return CALL.format(clock=online.size + 1, begun=f"{begun} ?", count=len(online.driven), per=len(MOTION))


def _limits(node: str, seen: Range) -> Sequence[str]:
    code, limits = CCode(), widened(seen)
    found = []
    for quantity in QUANTITIES:
        low, high = limits.get(_name(quantity, node), (-math.inf, math.inf))
        if quantity == "amplitude":
            low = seen.get(_name(quantity, node), (math.inf, math.inf))[0]
        found += [code.number(low), code.number(high)]
    return found


def _name(quantity: str, node: str) -> str:
    return f"{quantity}@{node}" if node else quantity
