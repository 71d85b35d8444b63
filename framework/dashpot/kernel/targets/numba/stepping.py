"""What a user's compiled code calls: ``step`` and ``simulate`` around ``advance``."""

from __future__ import annotations

from dashpot.kernel.ir.online import BEGUN, INPUTS, MOTION, NOT_FINITE, SPAN, STATUS, Online
from dashpot.kernel.ir.system import SMALLEST_SPAN
from dashpot.kernel.targets.numba.code import PythonCode
from dashpot.kernel.targets.scalar.code import Arguments
from dashpot.kernel.targets.scalar.whole import write_network

ONE: Arguments = [("array", "state"), ("number", "x"), ("number", "v"), ("number", "dt"), ("array", "parameters")]
ALL: Arguments = [("array", "x"), ("array", "v"), ("number", "dt"), ("array", "parameters"), ("array", "out")]
MANY: Arguments = [
    ("array", "state"),
    ("array", "x"),
    ("array", "v"),
    ("array", "load"),
    ("number", "dt"),
    ("array", "parameters"),
    ("array", "out"),
]


CALLED = ("step", "tangent_step", "simulate", "simulate_path", "step_nodes", "status")


def print_solver(online: Online, kind: type[PythonCode] = PythonCode) -> str:
    """The module of a network that somebody else steps."""
    code = kind(*CALLED)
    write_network(code, online)
    _write_bend(code)
    if len(online.driven) == 1 and not online.loaded:
        _write_step(code, online)
        _write_tangent(code, online)
        _write_record(code, online, ("x", "v", "a"), "simulate_path")
        _write_record(code, online, ("x", "v"), "simulate")
    _write_step_nodes(code, online)
    _write_status(code, online)
    return code.text


def _write_bend(code: PythonCode) -> None:
    arguments: Arguments = [("array", "s"), ("count", "o"), ("number", "x"), ("number", "v"), ("number", "dt")]
    with code.function("number", "bend", arguments, "The acceleration at the end of the cubic path since a sample."):
        with code.when(f"s[{BEGUN}] == 0.0"):
            code.answer("0.0")
        code.answer("(6.0 * (s[o] - x) / dt + 2.0 * s[o + 1] + 4.0 * v) / dt")


def _write_step(code: PythonCode, online: Online) -> None:
    with code.function("number", "step", ONE, "The force after a step to a displacement and a velocity."):
        code.borrow("state", "parameters")
        if online.accelerated:
            code.set(f"state[{INPUTS + 2}]", f"bend(state, {online.before}, x, v, dt)")
        code.set(f"state[{INPUTS}]", "x")
        code.set(f"state[{INPUTS + 1}]", "v")
        code.do("advance(state, dt, parameters)")
        code.answer(f"state[{online.outputs}]")


def _write_tangent(code: PythonCode, online: Online) -> None:
    """Central differences on copies of the memory: turning points and Newton's steps move along."""
    about = "The force, and how it changes with the displacement and with the velocity."
    with code.function("number", "tangent_step", ONE, about):
        code.borrow("state")
        code.let("memory", code.zeros(online.size), "array")
        code.let("place", "1e-6 * (fabs(x) + fabs(v) * dt + 1e-3)")
        code.let("speed", "0.0")
        for slope in ("stiffness", "damping"):
            code.let(slope, "0.0")
        with code.loop("k", 0, 4):  # ahead and behind in the displacement, then in the velocity
            with code.loop("i", 0, online.size):
                code.set("memory[i]", "state[i]")
            code.let("moved", "step(memory, x + place, v + speed, dt, parameters)")
            with code.when("k < 2"):
                code.set("stiffness", "stiffness + 0.5 * moved / place")
            with code.otherwise():
                code.set("damping", "damping + 0.5 * moved / speed")
            with code.when("k == 1"):
                code.set("speed", "place / dt")
                code.set("place", "0.0")
            code.set("place", "-place")
            code.set("speed", "-speed")
        code.answer("step(state, x, v, dt, parameters), stiffness, damping")


def _write_record(code: PythonCode, online: Online, given: tuple[str, ...], name: str) -> None:
    arguments: Arguments = [*(("array", each) for each in given), *ALL[2:]]
    with code.function("nothing", name, arguments, "The force along a whole record."):
        code.let("state", code.zeros(online.size), "array")
        code.borrow("parameters")
        if online.system:
            code.set(f"state[{SPAN}]", f"max({SMALLEST_SPAN}, np.max(x) - np.min(x))")
        with code.loop("k", 0, "x.size"):
            for number, each in enumerate(given):
                code.set(f"state[{INPUTS + number}]", f"{each}[k]")
            if len(given) < len(MOTION) and online.accelerated:
                code.set(f"state[{INPUTS + 2}]", f"bend(state, {online.before}, x[k], v[k], dt)")
            code.do("advance(state, dt, parameters)")
            code.set("out[k]", f"state[{online.outputs}]")


def _write_status(code: PythonCode, online: Online) -> None:
    with code.function("count", "status", [("array", "state")], "How the steps went so far."):
        with code.loop("k", online.outputs, online.before), code.when("not np.isfinite(state[k])"):
            code.answer(f"{NOT_FINITE}")
        code.answer(f"int(state[{STATUS}])")


def _write_step_nodes(code: PythonCode, online: Online) -> None:
    answers = len(online.driven) + len(online.free)
    with code.function("nothing", "step_nodes", MANY, "The same for any nodes: out are forces, then positions."):
        code.borrow("state", "parameters")
        with code.loop("k", 0, len(online.driven)):
            code.let("i", f"{INPUTS} + {len(MOTION)} * k", "count")
            code.set("state[i + 2]", f"bend(state, {online.before} + {len(MOTION)} * k, x[k], v[k], dt)")
            code.set("state[i]", "x[k]")
            code.set("state[i + 1]", "v[k]")
        with code.loop("k", 0, len(online.loaded)):
            code.set(f"state[{INPUTS + len(MOTION) * len(online.driven)} + k]", "load[k]")
        code.do("advance(state, dt, parameters)")
        with code.loop("k", 0, answers):
            code.set("out[k]", f"state[{online.outputs} + k]")
