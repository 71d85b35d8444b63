"""The JSON schema of a sensitivity study."""

from __future__ import annotations

from collections.abc import Collection

from dashpot.study.sensitivity.declaration import FORMAT
from dashpot.study.sensitivity.reading import DRAWS
from dashpot.text import schema as s
from dashpot.text.schema import Schema


def sensitivity_schema(metrics: Collection[str]) -> Schema:
    """The schema of a sensitivity study, with the metrics that are installed."""
    paths = s.patterns("paths of parameters, with * and ?")
    variation = {
        "name": s.text("what the report calls it"),
        "parameters": paths,
        "values": s.items(s.quantity(), "that they take"),
        "factors": s.items(s.number(), "of what the network has"),
    }
    scatter = {
        "parameters": paths,
        "deviation": s.number("standard deviation of a normal factor"),
        "between": s.pair(s.quantity(), "evenly between two values"),
    }
    keys = {
        "format": s.choice((FORMAT,)),
        "name": s.text("the name of the study"),
        "about": s.text("a remark for the report"),
        "network": s.text("a shipped name, or a file beside this one"),
        "rig": s.text("a test procedure or a bench file"),
        "options": s.named(s.ANYTHING, "of the procedure"),
        "metrics": s.items(s.choice(metrics), "that are computed", minItems=1),
        "limits": s.named(s.number(), "metric: the least value with which a specimen passes"),
        "over": s.part("variation", "what every metric is told over"),
        "vary": s.items(s.part("variation"), "each by itself, for each value of it everything over `over`"),
        "scatter": s.items(s.mapping(scatter, ("parameters",)), "how specimens differ"),
        "draws": s.integer(f"specimens that are drawn; {DRAWS} if left out", minimum=2),
        "seed": s.integer("same seed, same result files"),
    }
    content = s.mapping(keys, ("format", "name", "network", "rig", "metrics", "over"))
    parts = {"variation": s.mapping(variation, ("name", "parameters"))}
    return s.document("sensitivity study", "How metrics of a test depend on parameters.", content, parts)
