"""The schema of a campaign file."""

from __future__ import annotations

from dashpot.campaign.declaration import VERBS
from dashpot.campaign.reading import BATCH, FORMAT
from dashpot.text import schema as s
from dashpot.text.schema import Schema


def campaign_schema() -> Schema:
    """The schema of a campaign file."""
    pattern = s.mapping(
        {
            "pattern": s.text("paths or addresses with * for the name of the specimen"),
            "table": s.text("a CSV file with a column specimen and the properties"),
        },
        ("pattern",),
    )
    verb = s.choice(VERBS)
    keys = {
        "format": s.choice((FORMAT,)),
        "name": s.text("the name of the campaign"),
        "about": s.text("a remark for the report"),
        "specimens": {
            "if": {"type": "object"},
            "then": pattern,
            "else": s.text("a CSV file with columns specimen, data and properties"),
        },
        "models": s.items(s.text("a shipped name, or a file beside this one")),
        "verbs": {"anyOf": [verb, s.items(verb)], "description": "what is done with each specimen; fit if left out"},
        "seed": s.integer("same seed, same result files"),
        "shared": s.patterns("parameters that all specimens share"),
        "dependence": s.patterns("properties that parameters may depend on; all but the batch if left out"),
        "batch": s.text(f"the property over which control charts are drawn; {BATCH} if left out"),
        "memory": s.text("what a job may take, such as 2 GB"),
        "reports": s.flag("whether every job writes a report"),
    }
    content = s.mapping(keys, ("format", "name", "specimens", "models"))
    return s.document("campaign", "The same models on many specimens.", content)
