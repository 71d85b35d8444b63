"""The steps of high order of a network whose unknown nodes all have masses; see ``compiler.multistep``.

A sample takes two of them, in the workspace of the long steps; that of the short ones keeps what was before. As soon as
the numbers do not allow them, by the pace of the quickest node, the sample is done again by the steps for all numbers,
and so are those that follow. Whether it begins with them is told at rest.
"""

from __future__ import annotations

from dashpot.kernel.ir.online import BEGUN, STATUS, STEPS, Online
from dashpot.kernel.scheme import FILLED, PLACE, RENEWED, SPEED
from dashpot.kernel.targets.scalar.code import MEMORY, Arguments, Code
from dashpot.kernel.targets.scalar.motion import give

PARTS = 2  # of a sample
EULER = 2  # the number of the rule of the very first step
GIVEN_UP = -1.0  # as the number of steps
STATE: Arguments = [("array", "s"), ("number", "h")]


def write_high_order(code: Code, online: Online) -> None:
    """The functions ``try_high_order``, at rest, and ``high_order``, the step to the next sample."""
    _write_rule(code, online)
    _write_copy(code, online)
    _write_judge(code, online)
    _write_trial(code, online)
    _write_steps(code, online)


def give_others(code: Code, online: Online, pull: str, adams: str, renewed: str) -> None:
    """The symbols of a rule that networks without steps of high order do not have."""
    for key, value in (("pull", pull), ("adams", adams), ("renewed", renewed)):
        give(code, online, f"rule.{key}", value)


def _write_rule(code: Code, online: Online) -> None:
    with code.function("nothing", "adams", STATE, "The rule of Adams and Moulton for a step of h seconds."):
        give(code, online, "rule.slope", f"{SPEED[0] / PLACE[0]!r} / h")
        for key in ("now", "before", "swing"):
            give(code, online, f"rule.{key}", "0.0")
        give_others(code, online, f"{1.0 / SPEED[0]!r} / h", "1.0", "0.0")
        with code.when(f"(s[{STEPS}] == {FILLED}.0) | (s[{STEPS}] == {RENEWED}.0)"):
            give(code, online, "rule.renewed", "1.0")


def _write_copy(code: Code, online: Online) -> None:
    arguments: Arguments = [("array", "s"), ("count", "w"), ("count", "o")]
    first = len(online.program.constants)
    with code.function("nothing", "copy", arguments, "The rows that steps change, to the workspace at w from o."):
        with code.loop("k", first, online.rows):
            code.set("s[w + k]", "s[o + k]")


def _write_judge(code: Code, online: Online) -> None:
    assert online.system is not None and online.system.pace is not None
    start = online.courses[0]
    forces = [f"s[{start + online.system.row(name)}]" for name in online.system.forces]
    finite = "".join(f" & ({force} - {force} == 0.0)" for force in forces)
    with code.function("nothing", "judge", [("array", "s")], "Gives the steps of high order up where they fail."):
        code.let("sound", "0.0")
        with code.when(f"(s[{STATUS}] == 0.0) & (s[{start + online.system.row(online.system.pace)}] <= 1.0){finite}"):
            code.set("sound", "1.0")
        with code.when("sound == 0.0"):
            code.set(f"s[{STEPS}]", f"({GIVEN_UP})")


def _write_trial(code: Code, online: Online) -> None:
    """The pace is part of the pass ``improve``; what the trial changes is put back."""
    long, short = map(code.index, online.courses)
    with code.function("nothing", "try_high_order", STATE, "Whether steps of h seconds may begin at rest."):
        code.do(f"copy(s, {short}, {long})")
        give(code, online, "dt", "h")
        code.do("adams(s, h)")
        code.do(f"predict_(s, {long})")
        code.do(f"improve_(s, {long})")
        code.do("judge(s)")
        code.do(f"copy(s, {long}, {short})")


def _write_steps(code: Code, online: Online) -> None:
    assert online.system is not None
    long, short = map(code.index, online.courses)
    with code.function("nothing", "high_order", MEMORY[:2], "The steps of high order to the next sample."):
        code.do(f"copy(s, {short}, {long})")
        code.let("h", f"dt / {PARTS}.0")
        give(code, online, "dt", "h")
        with code.loop("j", 0, PARTS):
            code.do(f"move(s, j / {PARTS}.0, (j + 1) / {PARTS}.0, dt)")
            _choose_rule(code)
            _write_step(code, online)
            code.set(f"s[{STEPS}]", f"s[{STEPS}] + 1.0")
            with code.when(f"s[{STEPS}] == {2 * RENEWED}.0"):
                code.set(f"s[{STEPS}]", f"{RENEWED}.0")
        code.do("judge(s)")
        with code.when(f"s[{STEPS}] < 0.0"):
            code.do(f"copy(s, {long}, {short})")
            code.set(f"s[{STATUS}]", "0.0")


def _choose_rule(code: Code) -> None:
    # others at first, until there are as many accelerations as the rule of Adams and Moulton needs
    with code.when(f"s[{STEPS}] < {FILLED}.0"):
        code.let("number", "j", "count")
        with code.when(f"(j == 0) & (s[{BEGUN}] == 1.0)"):
            code.set("number", f"{EULER}")
        code.do("rule(s, number, h)")
    with code.otherwise():
        code.do("adams(s, h)")


def _write_step(code: Code, online: Online) -> None:
    assert online.system is not None and online.system.turns is not None and online.system.kept is not None
    w = online.courses[0]
    place = f"(s, {code.index(w)})"
    code.do(f"predict_{place}")
    turn = online.system.passes.get("turn")
    if turn and turn.updates:
        with code.when(f"s[{w + online.system.row(online.system.turns)}] != 0.0"):
            code.do(f"turn_{place}")
    with code.when(f"s[{w + online.system.row(online.system.kept)}] != 0.0"):
        code.do(f"correct{place}")
    for name in ("improve", "search", "commit_"):
        code.do(f"{name}{place}")
