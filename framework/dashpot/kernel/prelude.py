"""The branch-free functions that every generated kernel file begins with.

A call into the C mathematics library inside the loop over lanes would keep it from being vectorised, so exp, log and
the Wright omega function are written out. NaN passes through each of them; relative errors stay below 1e-14.
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
def exp(x):
    # 2**n * exp(r) with |r| <= ln(2)/2; n is added to the exponent field
    x = -708.0 if x < -708.0 else x
    x = 709.0 if x > 709.0 else x
    n = math.floor(x * 1.4426950408889634 + 0.5)
    r = (x - n * 0.693145751953125) - n * 1.4286068203094173e-06
    p = 1.6059043836821613e-10
    p = p * r + 2.08767569878681e-09
    p = p * r + 2.505210838544172e-08
    p = p * r + 2.755731922398589e-07
    p = p * r + 2.7557319223985893e-06
    p = p * r + 2.48015873015873e-05
    p = p * r + 0.0001984126984126984
    p = p * r + 0.001388888888888889
    p = p * r + 0.008333333333333333
    p = p * r + 0.041666666666666664
    p = p * r + 0.16666666666666666
    p = p * r + 0.5
    p = p * r + 1.0
    p = p * r + 1.0
    # the low bits of n + 2**52 + 2**51 are n itself
    return from_bits(bits_of(p) + (bits_of(n + 6755399441055744.0) << 52))


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
def wrightomega(p):
    # L + exp(L) = p. Start: rational between -5 and 24, p below, log p - log p/p above with log read off the bits;
    # then two Halley steps, the second one with the exponential carried over by its series
    inside = -5.0 if p < -5.0 else p
    inside = 24.0 if inside > 24.0 else inside
    top = ((0.009156943182636457 * inside + 0.049618445252901794) * inside + 0.5073029828920402) * inside
    low = ((0.0018984142398111993 * inside + 0.03854019487630284) * inside + 0.2250352705204395) * inside
    count = from_bits((bits_of(p) >> 20) + 4841369599423283200) - 4503599627370496.0
    rough = (count * 2.3283064365386963e-10 - 1022.957) * 0.6931471805599453
    start = (top - 0.5694869514647896) / (low + 1.0)
    start = p if p < -5.0 else start
    start = rough - rough / p if p > 24.0 else start
    power = exp(start)
    miss = (start + power - p) / (1.0 + power)
    shift = -miss / (1.0 - 0.5 * miss * power / (1.0 + power))
    grow = 0.0001984126984126984
    grow = grow * shift + 0.001388888888888889
    grow = grow * shift + 0.008333333333333333
    grow = grow * shift + 0.041666666666666664
    grow = grow * shift + 0.16666666666666666
    grow = grow * shift + 0.5
    grow = grow * shift + 1.0
    power = power * (grow * shift + 1.0)
    start = start + shift
    miss = (start + power - p) / (1.0 + power)
    shift = miss + 0.5 * miss * miss * power / (1.0 + power)
    return power * (1.0 - shift + 0.5 * shift * shift)


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
"""
