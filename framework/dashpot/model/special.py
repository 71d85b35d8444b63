"""Functions that numpy does not have, for laws."""

from __future__ import annotations

from typing import Any

from dashpot.expr.node import Node, apply, compute


def wrightomega(x: Any) -> Any:
    """The solution y of y + ln y = x, of arrays and of traced values.

    Source: Corless and Jeffrey, The Wright omega function (2002).
    """
    return apply("wrightomega", x) if isinstance(x, Node) else compute("wrightomega")(x)
