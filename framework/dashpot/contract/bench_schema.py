"""The JSON schema of a bench file, with the test procedures that are installed."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.contract.bench import FORMAT
from dashpot.contract.limits import Limits
from dashpot.contract.measuring import Measuring
from dashpot.contract.option_schema import with_options
from dashpot.contract.rig import Rig
from dashpot.text import schema as s
from dashpot.text.schema import Schema


def bench_schema(rigs: Mapping[str, type[Rig]]) -> Schema:
    """The schema of a bench file."""
    tests = {word: with_options(made, {"rig": {"const": word}}) for word, made in rigs.items()}
    keys = {
        "format": s.choice((FORMAT,)),
        "name": s.text("the name of the bench"),
        "about": s.text("a remark for people"),
        "tests": s.items(s.by_word("rig", tests, "the test procedure; see `dashpot list rigs`"), "in this order"),
        "measuring": with_options(Measuring, {}),
        "limits": with_options(Limits, {}),
    }
    return s.document(
        "rig",
        "A test bench: procedures with their options, and what it can do, and how it measures.",
        s.mapping(keys, ("format", "name", "tests")),
    )
