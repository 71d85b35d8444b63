"""Wright omega functions and exponentials of four arguments in one vector, for functions of one lane.

They are written out without branches, with the same polynomials as ``omega`` has: numba calls a library for one
exponential after the other, and leaves no vector in a loop that goes from sample to sample.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, factorial, log
from typing import Any

from llvmlite import ir
from numba.core import cgutils

from dashpot.kernel.targets.omega import OMEGA_BOTTOM, OMEGA_HIGH, OMEGA_LOW, OMEGA_TOP

WIDTH = 4
LOWEST = -700.0  # below it an exponential is zero for all that is added to it
HIGHEST = 700.0  # exponent that a pack takes
TERMS = 13  # of the exponential of half a logarithm of two
LOG_HIGH, LOG_LOW = 0.6931471803691238, 1.9082149292705877e-10  # log(2), the first part with zeros at its end
MAGIC = 6755399441055744.0  # 1.5 * 2^52: a number added to it is rounded, and stands in its lowest bits
EXPONENT = 52  # of the bits of a number, the first one of its exponent

SERIES = [1.0 / factorial(k) for k in range(TERMS)]
OTHERS = [log(2.0), 1.0 / log(2.0), -LOG_HIGH, -LOG_LOW, MAGIC]
STORED = tuple(dict.fromkeys([*OMEGA_TOP, *OMEGA_BOTTOM, *SERIES, *OTHERS]))

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

    def stored(self, value: float) -> Any:
        """A vector from memory, by an offset: code that may lie anywhere loads the address of every constant anew."""
        kind = ir.ArrayType(VECTOR, len(STORED))
        name = f"dashpot_{hashlib.sha256(repr(STORED).encode()).hexdigest()[:16]}"
        found = self.builder.module.globals.get(name)
        if found is None:
            found = ir.GlobalVariable(self.builder.module, kind, name)
            # no constant, or the compiler would put the values into the code
            found.linkage, found.align = "linkonce_odr", 8 * WIDTH
            found.initializer = ir.Constant(kind, [self.all(each) for each in STORED])
        place = [ir.Constant(ir.IntType(32), each) for each in (0, STORED.index(value))]
        return self.builder.load(self.builder.gep(found, place, inbounds=True), align=8 * WIDTH)

    def fma(self, a: Any, b: Any, c: Any) -> Any:
        return self.builder.call(self._fma, [a, b, c])

    def polynomial(self, coefficients: Sequence[float], x: Any) -> Any:
        # in pairs: a sum from the last term on waits for every product
        terms = [self.stored(coefficient) for coefficient in coefficients]
        while len(terms) > 1:
            pairs = zip(terms[::2], terms[1::2], strict=False)
            terms = [self.fma(high, x, low) for low, high in pairs] + terms[len(terms) & ~1 :]
            x = self.builder.fmul(x, x)
        return terms[0]

    def at_least(self, x: Any, least: float) -> Any:
        return self.builder.select(self.builder.fcmp_ordered("<", x, self.all(least)), self.all(least), x)

    def exponential(self, x: Any, binary: Any) -> Any:
        """The exponential of ``x``; ``binary`` is about its logarithm of base 2, which may be there sooner."""
        builder, low = self.builder, self.at_least(x, LOWEST)
        shifted = builder.fadd(self.at_least(binary, LOWEST / log(2.0)), self.stored(MAGIC))
        power = builder.fsub(shifted, self.stored(MAGIC))
        rest = self.fma(power, self.stored(-LOG_LOW), self.fma(power, self.stored(-LOG_HIGH), low))
        series = self.polynomial(SERIES, rest)
        raised = builder.shl(builder.bitcast(shifted, BITS), ir.Constant(BITS, [EXPONENT] * WIDTH))
        return builder.bitcast(builder.add(builder.bitcast(series, BITS), raised), VECTOR)

    def begin_omega(self, x: Any) -> tuple[Any, Any]:
        """The logarithm of the first guess, and about that of base 2."""
        low = self.at_least(x, OMEGA_LOW)
        guess = self.builder.fdiv(self.polynomial(OMEGA_TOP, low), self.polynomial(OMEGA_BOTTOM, low))
        far = self.builder.fsub(x, low)
        return self.fma(self.stored(log(2.0)), guess, far), self.fma(self.stored(1.0 / log(2.0)), far, guess)

    def end_omega(self, x: Any, start: Any, y: Any) -> Any:
        """The guess ``y``, whose logarithm is ``start``, corrected."""
        builder = self.builder
        b = builder.fdiv(self.all(1.0), builder.fadd(self.all(1.0), y))
        m = builder.fmul(builder.fsub(builder.fsub(x, start), y), b)
        inner = self.fma(m, self.fma(self.all(0.5), b, self.all(-1.0 / 3.0)), self.all(0.5))
        factor = self.fma(m, self.fma(builder.fmul(b, m), inner, self.all(1.0)), self.all(1.0))
        return builder.fmul(y, factor)


def _vector(builder: Any, numbers: Sequence[Any]) -> Any:
    found: Any = ir.Constant(VECTOR, ir.Undefined)
    for place, number in enumerate(numbers):
        found = builder.insert_element(found, number, ir.Constant(ir.IntType(32), place))
    return found


@dataclass(frozen=True)
class Packed:
    """A function of four arguments that answers as many omegas, and of the others the exponentials."""

    omegas: int

    def __call__(self, *arguments: float) -> tuple[float, ...]:
        """The same in Python."""
        from dashpot.model.special import wrightomega

        return tuple(float(wrightomega(x)) if k < self.omegas else exp(x) for k, x in enumerate(arguments))

    def generate(self, builder: Any, arguments: Sequence[Any]) -> list[Any]:
        """Its instructions; answers its answers."""
        x, vectors = _vector(builder, arguments), _Vectors(builder)
        chosen = ir.Constant(ir.VectorType(ir.IntType(1), WIDTH), [int(k < self.omegas) for k in range(WIDTH)])
        start, binary = x, builder.fmul(x, vectors.stored(1.0 / log(2.0)))
        if self.omegas:
            begun = vectors.begin_omega(x)
            start, binary = (builder.select(chosen, *each) for each in zip(begun, (start, binary), strict=True))
        y = vectors.exponential(start, binary)
        found = builder.select(chosen, vectors.end_omega(x, start, y), y) if self.omegas else y
        return [builder.extract_element(found, ir.Constant(ir.IntType(32), place)) for place in range(WIDTH)]


@dataclass(frozen=True)
class Beyond:
    """Whether one of four arguments is higher than a pack takes it."""

    omegas: int

    @property
    def highest(self) -> list[float]:
        """The highest argument at each place."""
        return [OMEGA_HIGH if k < self.omegas else HIGHEST for k in range(WIDTH)]

    def __call__(self, *arguments: float) -> bool:
        """The same in Python."""
        return any(x > limit for x, limit in zip(arguments, self.highest, strict=True))

    def generate(self, builder: Any, arguments: Sequence[Any]) -> list[Any]:
        """Its instructions; answers its answer."""
        higher = builder.fcmp_ordered(">", _vector(builder, arguments), ir.Constant(VECTOR, self.highest))
        bits = ir.IntType(WIDTH)
        return [builder.icmp_unsigned("!=", builder.bitcast(higher, bits), ir.Constant(bits, 0))]


packed_0, packed_1, packed_2, packed_3, packed_4 = map(Packed, range(WIDTH + 1))
beyond_0, beyond_1, beyond_2, beyond_3, beyond_4 = map(Beyond, range(WIDTH + 1))
