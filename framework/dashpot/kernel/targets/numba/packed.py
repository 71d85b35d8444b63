"""Wright omega functions and exponentials of four arguments in one vector, for functions of one lane.

They are written out without branches, with the same polynomials as ``omega`` has: numba calls a library for one
exponential after the other, and leaves no vector in a loop that goes from sample to sample.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import exp, factorial, log
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload

from dashpot.kernel.targets.omega import OMEGA_BOTTOM, OMEGA_LOW, OMEGA_TOP

WIDTH = 4
LOWEST = -700.0  # below it an exponential is zero for all that is added to it
TERMS = 13  # of the exponential of half a logarithm of two
LOG_HIGH, LOG_LOW = 0.6931471803691238, 1.9082149292705877e-10  # log(2), the first part with zeros at its end
MAGIC = 6755399441055744.0  # 1.5 * 2^52: a number added to it is rounded, and stands in its lowest bits
EXPONENT = 52  # of the bits of a number, the first one of its exponent

VECTOR = ir.VectorType(ir.DoubleType(), WIDTH)
BITS = ir.VectorType(ir.IntType(64), WIDTH)


class _Vectors:
    """Instructions on vectors."""

    def __init__(self, builder: Any) -> None:
        self.builder = builder
        kind = ir.FunctionType(VECTOR, [VECTOR] * 3)
        self._fma = cgutils.get_or_insert_function(builder.module, kind, f"llvm.fma.v{WIDTH}f64")

    def all(self, value: float) -> Any:
        return ir.Constant(VECTOR, [value] * WIDTH)

    def fma(self, a: Any, b: Any, c: Any) -> Any:
        return self.builder.call(self._fma, [a, b, c])

    def polynomial(self, coefficients: Sequence[float], x: Any) -> Any:
        # in pairs: a sum from the last term on waits for every product
        terms = [self.all(coefficient) for coefficient in coefficients]
        while len(terms) > 1:
            pairs = zip(terms[::2], terms[1::2], strict=False)
            terms = [self.fma(high, x, low) for low, high in pairs] + terms[len(terms) & ~1 :]
            x = self.builder.fmul(x, x)
        return terms[0]

    def at_least(self, x: Any, least: float) -> Any:
        return self.builder.select(self.builder.fcmp_ordered("<", x, self.all(least)), self.all(least), x)

    def exponential(self, x: Any) -> Any:
        builder, low = self.builder, self.at_least(x, LOWEST)
        shifted = self.fma(low, self.all(1.0 / log(2.0)), self.all(MAGIC))
        power = builder.fsub(shifted, self.all(MAGIC))
        rest = self.fma(power, self.all(-LOG_LOW), self.fma(power, self.all(-LOG_HIGH), low))
        series = self.polynomial([1.0 / factorial(k) for k in range(TERMS)], rest)
        raised = builder.shl(builder.bitcast(shifted, BITS), ir.Constant(BITS, [EXPONENT] * WIDTH))
        return builder.bitcast(builder.add(builder.bitcast(series, BITS), raised), VECTOR)

    def begin_omega(self, x: Any) -> Any:
        """The logarithm of the first guess."""
        low = self.at_least(x, OMEGA_LOW)
        guess = self.builder.fdiv(self.polynomial(OMEGA_TOP, low), self.polynomial(OMEGA_BOTTOM, low))
        return self.fma(self.all(log(2.0)), guess, self.builder.fsub(x, low))

    def end_omega(self, x: Any, start: Any, y: Any) -> Any:
        """The guess ``y``, whose logarithm is ``start``, corrected."""
        builder = self.builder
        b = builder.fdiv(self.all(1.0), builder.fadd(self.all(1.0), y))
        m = builder.fmul(builder.fsub(builder.fsub(x, start), y), b)
        inner = self.fma(m, self.fma(self.all(0.5), b, self.all(-1.0 / 3.0)), self.all(0.5))
        factor = self.fma(m, self.fma(builder.fmul(b, m), inner, self.all(1.0)), self.all(1.0))
        return builder.fmul(y, factor)


def _packed(omegas: int) -> Callable[..., Any]:
    """The function of four arguments that answers as many omegas and of the others the exponentials."""

    @intrinsic
    def compiled(typing: Any, a: Any, b: Any, c: Any, d: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            places = [ir.Constant(ir.IntType(32), place) for place in range(WIDTH)]
            x: Any = ir.Constant(VECTOR, ir.Undefined)
            for place, argument in zip(places, arguments, strict=True):
                x = builder.insert_element(x, argument, place)
            vectors = _Vectors(builder)
            chosen = ir.Constant(ir.VectorType(ir.IntType(1), WIDTH), [int(k < omegas) for k in range(WIDTH)])
            start = builder.select(chosen, vectors.begin_omega(x), x) if omegas else x
            y = vectors.exponential(start)
            found = builder.select(chosen, vectors.end_omega(x, start, y), y) if omegas else y
            return context.make_tuple(
                builder, signature.return_type, [builder.extract_element(found, place) for place in places]
            )

        return types.UniTuple(types.float64, WIDTH)(a, b, c, d), generate

    native: Any = compiled

    def plain(a: float, b: float, c: float, d: float) -> tuple[float, ...]:
        from dashpot.model.special import wrightomega

        return tuple(float(wrightomega(x)) if k < omegas else exp(x) for k, x in enumerate((a, b, c, d)))

    overload(plain, strict=False)(lambda a, b, c, d: lambda a, b, c, d: native(a, b, c, d))
    return plain


packed_0, packed_1, packed_2, packed_3, packed_4 = map(_packed, range(WIDTH + 1))
