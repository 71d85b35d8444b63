"""The branch-free functions that every generated kernel file begins with.

A call into the C mathematics library inside the loop over lanes would keep it from being vectorised, so exp, log and
the Wright omega function are written out. NaN passes through each of them; relative errors stay below 1e-14
(3e-14 where the Wright omega function is below 1e-40).
"""

PRELUDE = """
import math

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic

# nothing is assumed away about NaN and infinity; the functions below also forbid reassociation, which would undo
# their split constants
LOOP = {"fastmath": {"contract", "nsz", "arcp", "reassoc"}, "error_model": "numpy", "nogil": True}
FUNCTION = {"fastmath": {"contract", "nsz", "arcp"}, "error_model": "numpy", "forceinline": True}


@intrinsic
def use_full_vectors(context):
    # LLVM halves the vectors of many processors unless a function asks for the full width; llvmlite has no word for it
    def generate(context, builder, signature, arguments):
        set.add(builder.function.attributes, '"prefer-vector-width"="512"')
        return context.get_dummy_value()
    return types.none(), generate


@intrinsic
def bits_of(context, value):
    def generate(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], ir.IntType(64))
    return types.int64(types.float64), generate


@intrinsic
def from_bits(context, value):
    def generate(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], ir.DoubleType())
    return types.float64(types.int64), generate


@njit(**FUNCTION)
def two_to(shifted, f):
    # 2**(n + f) with |f| <= 1/2, where shifted is n + 2**52 + 2**51: its low bits, n, are added to the exponent field
    g = f * f
    even = 7.070977866508138e-09
    even = even * g + 1.3215451633221434e-06
    even = even * g + 0.00015403530424776529
    even = even * g + 0.009618129107618665
    even = even * g + 0.24022650695910075
    even = even * g + 1.0
    odd = 1.0205905413765595e-07
    odd = odd * g + 1.5252672924850737e-05
    odd = odd * g + 0.0013333558200794592
    odd = odd * g + 0.05550410866465167
    odd = odd * g + 0.6931471805599462
    return from_bits(bits_of(odd * f + even) + (bits_of(shifted) << 52))


@njit(**FUNCTION)
def exp(x):
    x = -708.0 if x < -708.0 else x
    x = 709.0 if x > 709.0 else x
    shifted = x * 1.4426950408889634 + 6755399441055744.0
    n = shifted - 6755399441055744.0
    rest = (x - n * 0.693145751953125) - n * 1.4286068203094173e-06
    return two_to(shifted, rest * 1.4426950408889634)


@njit(**FUNCTION)
def log(x):
    # x = 2**n * m with m in sqrt(1/2)..sqrt(2); log m = 2 atanh(s), s = (m - 1)/(m + 1).
    # n becomes a float through the mantissa of 2**52 + 2**51
    bits = bits_of(x) - 4604544271217802189
    n = from_bits((bits >> 52) + 4843621399236968448) - 6755399441055744.0
    m = from_bits((bits & 4503599627370495) + 4604544271217802189)
    s = (m - 1.0) / (m + 1.0)
    q = s * s
    p = 0.14617093237558204
    p = p * q + 0.15331664799306263
    p = p * q + 0.1818289100504977
    p = p * q + 0.2222221110612709
    p = p * q + 0.28571428626173057
    p = p * q + 0.39999999999899005
    p = p * q + 0.666666666666667
    y = n * 0.6931471805599453 + (2.0 * s + s * q * p)
    y = -math.inf if x == 0.0 else y
    y = math.nan if x < 0.0 else y
    return y if x < math.inf else x


@njit(**FUNCTION)
def wrightomega_below_24(p):
    # y = exp(L) with L + exp(L) = p. Start: log2(y) to 3e-4, rational between -8 and 24, below a straight line. Then
    # the series of y around the start, in m and in b = dL/dp there; what is left out is m**4/24
    low = -8.0 if p < -8.0 else p
    p = -700.0 if p < -700.0 else p
    top = 0.00011072075573655662
    top = top * low + 0.0017453797235457513
    top = top * low + 0.033564115415736305
    top = top * low + 0.08235211367797804
    top = top * low + 0.7010005474163719
    top = top * low - 0.8186519570288853
    bottom = 1.4265236442888172e-05
    bottom = bottom * low + 0.0005511463825132435
    bottom = bottom * low + 0.007771445050429686
    bottom = bottom * low + 0.07218180668419655
    bottom = bottom * low + 0.268335298843771
    bottom = bottom * low + 1.0
    start = top / bottom + (p - low) * 1.4426950408889634
    shifted = start + 6755399441055744.0
    y = two_to(shifted, start - (shifted - 6755399441055744.0))
    b = 1.0 / (1.0 + y)
    m = ((p - start * 0.6931471805599453) - y) * b
    return y + y * m * (1.0 + b * m * (0.5 + m * (0.5 * b - 0.3333333333333333)))


@njit(**FUNCTION)
def wrightomega_above_24(p):
    # y + log(y) = p by Newton's method
    y = p - log(p)
    y = y * (1.0 + p - log(y)) / (1.0 + y)
    y = y * (1.0 + p - log(y)) / (1.0 + y)
    y = y * (1.0 + p - log(y)) / (1.0 + y)
    return y if p < math.inf else p


@njit(**FUNCTION)
def minimum(a, b):
    low = b if b < a else a
    return b if b != b else low


@njit(**FUNCTION)
def maximum(a, b):
    high = b if b > a else a
    return b if b != b else high


@njit(**FUNCTION)
def sign(a):
    side = 1.0 if a > 0.0 else 0.0
    side = -1.0 if a < 0.0 else side
    return a if a != a else side


# the long functions on rows of the workspace: from row ``source`` on, every ``step``-th; answers from ``target`` on.
# Rows are cut out, so that the compiler sees that no index is negative
@njit(**FUNCTION)
def exp_rows(w, source, step, target, onward, rows, lanes):
    use_full_vectors()
    for r in range(rows):
        x, y = w[source + step * r :][:64], w[target + onward * r :][:64]
        for l in range(lanes):
            y[l] = exp(x[l])


@njit(**FUNCTION)
def log_rows(w, source, step, target, onward, rows, lanes):
    use_full_vectors()
    for r in range(rows):
        x, y = w[source + step * r :][:64], w[target + onward * r :][:64]
        for l in range(lanes):
            y[l] = log(x[l])


@njit(**FUNCTION)
def wrightomega_rows(w, source, step, target, onward, rows, lanes):
    use_full_vectors()
    above = False
    for r in range(rows):
        x, y = w[source + step * r :][:64], w[target + onward * r :][:64]
        for l in range(lanes):
            above |= x[l] > 24.0
            y[l] = wrightomega_below_24(x[l])
    if above:
        for r in range(rows):
            x, y = w[source + step * r :][:64], w[target + onward * r :][:64]
            for l in range(lanes):
                y[l] = wrightomega_above_24(x[l]) if x[l] > 24.0 else y[l]


@njit(**FUNCTION)
def cubic(part, l, u, order):
    # a cubic of a table, or its first or second derivative
    c1, c2, c3 = part[l + 64], part[l + 128], part[l + 192]
    value = part[l] + u * (c1 + u * (c2 + u * c3))
    slope = c1 + u * (2.0 * c2 + 3.0 * u * c3)
    return value if order == 0 else slope if order == 1 else 2.0 * c2 + 6.0 * u * c3


@njit("void(float64[::1], int64, int64, float64[::1], int64, float64[::1], int64, int64, int64, int64)", **LOOP)
def lookup_rows(w, source, target, tables, base, knots, first, count, order, lanes):
    # a table whose argument every lane has for itself. Lanes are close together: the segment of the first one serves
    # all, then those above and those below it are done again, segment by segment, while there are any
    use_full_vectors()
    lanes = lanes & -8
    x, y = w[source : source + 64], w[target : target + 64]
    s = 0
    while s < count and x[0] >= knots[first + s]:
        s += 1
    start = knots[first + max(s - 1, 0)]
    part = tables[base + 256 * s : base + 256 * s + 256]
    for l in range(lanes):
        y[l] = cubic(part, l, x[l] - start, order)
    for k in range(s + 1, count + 1):
        knot = knots[first + k - 1]
        part = tables[base + 256 * k : base + 256 * k + 256]
        left = 0
        for l in range(lanes):
            beyond = x[l] >= knot
            y[l] = cubic(part, l, x[l] - knot, order) if beyond else y[l]
            left += 1 if beyond else 0
        if left == 0:
            break
    for k in range(s - 1, -1, -1):
        knot, start = knots[first + k], knots[first + max(k - 1, 0)]
        part = tables[base + 256 * k : base + 256 * k + 256]
        left = 0
        for l in range(lanes):
            beyond = x[l] < knot
            y[l] = cubic(part, l, x[l] - start, order) if beyond else y[l]
            left += 1 if beyond else 0
        if left == 0:
            break
"""
