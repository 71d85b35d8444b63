"""Arrays whose owner is somebody else, for loops in which every sample would count references up and down.

The count is atomic: passing two arrays through a few calls costs more than the step of a network. An array of a known
length can stand on the stack: numba compiles that sooner than a call for memory.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload
from numba.np.arrayobj import populate_array

WIDTH = 8  # bytes of a number


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


def zeros_on_stack(count: int) -> Any:
    """Zeros that live as long as the compiled function that asks for them; ``count`` is a literal."""
    return np.zeros(count)


@intrinsic(prefer_literal=True)
def _on_stack(typing: Any, count: Any) -> Any:
    kind, length = types.Array(types.float64, 1, "C"), count.literal_value

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        place = cgutils.alloca_once(builder, ir.ArrayType(ir.DoubleType(), length))
        cgutils.memset(builder, place, context.get_constant(types.intp, WIDTH * length), 0)
        found, counted = context.make_array(kind)(context, builder), context.get_constant(types.intp, length)
        width = context.get_constant(types.intp, WIDTH)
        populate_array(
            found,
            data=builder.bitcast(place, ir.PointerType(ir.DoubleType())),
            shape=(counted,),
            strides=(width,),
            itemsize=width,
            meminfo=None,
        )
        return found._getvalue()

    return kind(count), generate


_stacked: Any = _on_stack


# written into the function that asks, or the zeros would stand in the frame of one that has returned
@overload(zeros_on_stack, strict=False, prefer_literal=True, inline="always")
def _zeros_on_stack(count: Any) -> Any:
    return lambda count: _stacked(count)
