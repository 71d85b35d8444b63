"""Arrays whose owner is somebody else, for loops in which every sample would count references up and down.

The count is atomic: passing two arrays through a few calls costs more than the step of a network.
"""

from __future__ import annotations

from typing import Any

from numba.core import cgutils
from numba.extending import intrinsic, overload


def borrowed(array: Any) -> Any:
    """The same array without its owner, inside compiled code; the owner has to live as long as it is used."""
    return array


@intrinsic
def _without_owner(typing: Any, array: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        found = context.make_array(signature.return_type)(context, builder, arguments[0])
        found.meminfo = cgutils.get_null_value(found.meminfo.type)
        found.parent = cgutils.get_null_value(found.parent.type)
        return found._getvalue()

    return array(array), generate


_ownerless: Any = _without_owner


@overload(borrowed, strict=False)  # the lambda has no annotations
def _borrowed(array: Any) -> Any:
    return lambda array: _ownerless(array)
