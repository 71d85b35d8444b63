"""Which numbers of a network are slopes from run to run: their unit is per run, though a count has none."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.model.network import Value

ORDER = "order"  # the setting of every run that counts them
RUN = "run"


def per_run(values: Mapping[str, Value]) -> frozenset[str]:
    """The paths of slopes over the order of the runs, of numbers by their paths."""
    over = [(path, value.over) for path, value in values.items() if value.over]
    return frozenset(
        f"{path}{ending}"
        for path, each in over
        if each.word == ORDER and each.way == "slope" and not each.channel
        for ending in each.endings
    )
