"""The motion of driven nodes and loads within a step, between two samples, in the memory of ``Online``."""

from __future__ import annotations

from dashpot.kernel.ir.online import INPUTS, MOTION, Online
from dashpot.kernel.targets.scalar.code import Arguments, Code


def write_motion(code: Code, online: Online) -> None:
    """The function ``move`` and what it calls."""
    _write_path(code)
    _write_move(code, online)


def give(code: Code, online: Online, name: str, value: str) -> None:
    """A new value of a symbol of the motion."""
    code.set(f"s[{online.motion + online.known.index(name)}]", value)


def _write_path(code: Code) -> None:
    """The quintic and its derivatives at a share u of the step; ``i`` and ``o`` are where the motion stands."""
    arguments: Arguments = [
        ("array", "s"),
        ("count", "o"),
        ("count", "i"),
        ("number", "u"),
        ("number", "dt"),
        ("count", "order"),
    ]
    with code.function("number", "path", arguments, "Place, velocity or acceleration between two samples."):
        code.let("far", "s[i] - s[o] - dt * (s[o + 1] + 0.5 * dt * s[o + 2])")
        code.let("fast", "dt * (s[i + 1] - s[o + 1] - dt * s[o + 2])")
        code.let("bent", "0.5 * dt * dt * (s[i + 2] - s[o + 2])")
        code.let("c3", "10.0 * far - 4.0 * fast + bent")
        code.let("c4", "-15.0 * far + 7.0 * fast - 2.0 * bent")
        code.let("c5", "6.0 * far - 3.0 * fast + bent")
        with code.when("u == 1.0"):
            code.answer("s[i + order]")
        with code.when("order == 0"):
            code.answer("s[o] + u * (dt * s[o + 1] + u * (0.5 * dt * dt * s[o + 2] + u * (c3 + u * (c4 + u * c5))))")
        with code.when("order == 1"):
            rest = "u * (dt * dt * s[o + 2] + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))"
            code.answer(f"(dt * s[o + 1] + {rest}) / dt")
        code.answer("(dt * dt * s[o + 2] + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / (dt * dt)")


def _write_move(code: Code, online: Online) -> None:
    arguments: Arguments = [("array", "s"), ("number", "before"), ("number", "now"), ("number", "dt")]
    with code.function("nothing", "move", arguments, "The motion within a step, between two shares of a sample."):
        for number, joint in enumerate(online.driven):
            places = f"s, {online.before + len(MOTION) * number}, {INPUTS + len(MOTION) * number}"
            moved = {
                "old": ("before", 0),
                "new": ("now", 0),
                "velocity_old": ("before", 1),
                "velocity_new": ("now", 1),
                "acceleration": ("now", 2),
            }
            for key, (share, order) in moved.items():
                give(code, online, f"node:{joint}.{key}", f"path({places}, {share}, dt, {order})")
        for number, joint in enumerate(online.loaded, len(MOTION) * len(online.driven)):
            old, new = f"s[{online.before + number}]", f"s[{INPUTS + number}]"
            give(code, online, f"node:{joint}.load", f"{old} + now * ({new} - {old})")
