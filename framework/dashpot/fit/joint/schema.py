"""The schema of a joint file."""

from __future__ import annotations

from dashpot.fit.joint.declaration import FORMAT
from dashpot.text import schema as s
from dashpot.text.schema import Schema


def joint_schema() -> Schema:
    """The schema of a joint file."""
    specimen = s.mapping(
        {
            "network": s.text("a shipped name, or a file beside this one"),
            "data": s.text("a dataset, relative to this file"),
        },
        ("network", "data"),
    )
    named = s.named(s.text(), "specimen: path of the parameter in it")
    keys = {
        "format": s.choice((FORMAT,)),
        "name": s.text("the name of the joint fit"),
        "about": s.text("a remark for the report"),
        "seed": s.integer("same seed, same result files"),
        "specimens": s.named(specimen, "each with its network and its data", minProperties=2),
        "shared": s.items(
            {"if": {"type": "object"}, "then": named, "else": s.text("a pattern of paths")},
            "parameters that are one number for all specimens",
        ),
    }
    content = s.mapping(keys, ("format", "name", "specimens", "shared"))
    return s.document("joint", "Specimens identified together, with parameters in common.", content)
