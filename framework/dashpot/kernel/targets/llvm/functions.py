"""The long functions of a kernel, on bundles of vectors and without branches.

A call into the C mathematics library would take the lanes one by one, so they are written out. NaN passes through each
of them. Relative errors stay below 1e-14 in exp, log and the Wright omega function (3e-14 where that is below 1e-40);
expm1, log1p, tanh and power are within 2.5 units of the last place wherever the argument lies, and infinite, zero or
undefined where those of the C library are.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from dashpot.kernel.targets.llvm.assembly import BITS, NUMBER, Bundle
from dashpot.kernel.targets.llvm.library import one_by_one
from dashpot.kernel.targets.omega import OMEGA_BOTTOM, OMEGA_HIGH, OMEGA_LOW, OMEGA_TOP

LOG2_E, LN_2 = 1.4426950408889634, 0.6931471805599453
LN_2_HIGH, LN_2_LOW = 0.693145751953125, 1.4286068203094173e-06
# 2**52 + 2**51: a number added to it is rounded to an integer, which stands in the low bits
ROUNDING = 6755399441055744.0
EXPONENT = 52  # bits below the exponent

# 2**f for |f| <= 1/2, constant term first
POWER_OF_TWO = (
    1.0,
    0.6931471805599462,
    0.24022650695910075,
    0.05550410866465167,
    0.009618129107618665,
    0.0013333558200794592,
    0.00015403530424776529,
    1.5252672924850737e-05,
    1.3215451633221434e-06,
    1.0205905413765595e-07,
    7.070977866508138e-09,
)
# (log m - 2 s)/s**3 in s**2, s = (m - 1)/(m + 1), for m between sqrt(1/2) and sqrt(2)
LOGARITHM = (
    0.666666666666667,
    0.39999999999899005,
    0.28571428626173057,
    0.2222221110612709,
    0.1818289100504977,
    0.15331664799306263,
    0.14617093237558204,
)
# what is above the first coefficient of this, for powers
TWO_THIRDS, LEFT_OF_TWO_THIRDS = 0.6666666666666666, 3.700743415417188e-17
FINE_LOGARITHM = (
    0.40000000000000024,
    0.2857142857133851,
    0.2222222227110234,
    0.18181808247544543,
    0.15385574796462032,
    0.13285957435193352,
    0.1291361767218225,
)
# (exp(r) - 1 - r)/r**2 for |r| <= log(2)/2
BEYOND_LINEAR = (
    0.5,
    0.1666666666666667,
    0.04166666666666667,
    0.008333333333326136,
    0.001388888888888375,
    0.00019841269874815834,
    2.480158732554432e-05,
    2.7557255406285044e-06,
    2.7557273647451087e-07,
    2.5105214474751413e-08,
    2.0914685161418067e-09,
)
# a number whose bits taken from those of x leave the exponent n of x = 2**n m, with m between sqrt(1/2) and sqrt(2)
ROOT_OF_HALF = 4604544271217802189
FRACTION = 4503599627370495  # the bits below the exponent
HALF, TWO, SIGN = 0x3FE0000000000000, 0x4000000000000000, -0x8000000000000000  # the bits of 1/2, 2 and -0
LEAST, TOP = 2.2250738585072014e-308, 708.0  # the least number that is not denormal; exp(TOP) is a number
FLOOR, CEILING, LEVEL = -40.0, 710.0, 20.0  # where expm1 is -1 and infinite, where tanh is 1


@dataclass(frozen=True, eq=False)
class Rare:
    """``bundle``, which ``amend`` puts right in the lanes ``where`` it is not; these are rare."""

    bundle: Bundle
    where: Bundle
    amend: Callable[[], Bundle]

    def amended(self) -> Bundle:
        """The whole answer; nothing is spent on rare lanes as long as there are none."""
        assembly, plain = self.bundle.assembly, self.bundle
        return assembly.amended(self.where, plain, lambda: self.where.choose(self.amend(), plain))


def exp(x: Bundle) -> Bundle:
    """The exponential; 1e-308 and 8e307 stand for what is smaller and larger."""
    x = _held(x, -708.0, 709.0)
    shifted = x.times_plus(LOG2_E, ROUNDING)
    n = shifted - ROUNDING
    rest = n.times_plus(-LN_2_LOW, n.times_plus(-LN_2_HIGH, x))
    return _two_to(shifted, rest * LOG2_E)


def log(x: Bundle) -> Bundle:
    """The natural logarithm, of numbers that are not denormal."""
    n, m = _parts(x)
    y = _log_of_one_and(m - 1.0, n)
    y = x.compare("oeq", 0.0).choose(-math.inf, y)
    y = x.compare("olt", 0.0).choose(math.nan, y)
    return x.compare("olt", math.inf).choose(y, x)


def expm1(x: Bundle) -> Bundle:
    """exp(x) - 1."""
    return x.compare("oeq", 0.0).choose(x, _grown_less_one(_held(x, FLOOR, CEILING)))


def _grown_less_one(x: Bundle) -> Bundle:
    # 2**n p + (2**n - 1), by halves as 2**1024 is no number
    shifted, p = _grown(x)
    half = ((shifted.cast(BITS) << EXPONENT) + HALF).cast(NUMBER)
    y = half.times_plus(p, half - 0.5)
    return y + y


def tanh(x: Bundle) -> Bundle:
    """The hyperbolic tangent."""
    size = x.called("fabs")
    size = size.compare("ogt", LEVEL).choose(LEVEL, size)
    grown = _grown_less_one(size + size)
    y = grown / (grown + 2.0)
    return (y.cast(BITS) | (x.cast(BITS) & SIGN)).cast(NUMBER)


def log1p(x: Bundle) -> Bundle:
    """log(1 + x)."""
    whole = x + 1.0
    n, m = _parts(whole)
    # what 1 + x has lost by rounding, over 2**n, by halves as 2**-1024 is not exact
    scale = (x.cast(BITS).like(TWO) - ((n + ROUNDING).cast(BITS) << EXPONENT)).cast(NUMBER)
    f = ((x - (whole - 1.0)) * scale).times_plus(0.5, m - 1.0)
    y = _log_of_one_and(f, n)
    y = x.compare("oeq", 0.0).choose(x, y)
    y = x.compare("oeq", -1.0).choose(-math.inf, y)
    y = x.compare("olt", -1.0).choose(math.nan, y)
    return x.compare("olt", math.inf).choose(y, x)


def _log_of_one_and(f: Bundle, n: Bundle) -> Bundle:
    # log(2**n (1 + f)): log(1 + f) = 2 atanh(s), s = f/(2 + f)
    s = f * _inverse(f + 2.0, 3)
    q = s * s
    return n.times_plus(LN_2, s.times_plus(2.0, s * q * _polynomial(LOGARITHM, q)))


def power(x: Bundle, y: Bundle) -> Rare:
    """x to the power y."""
    # y log(x) as a sum of two numbers, since exp makes an absolute error of it a relative one
    large, small = _fine_log(x)
    t = y * large
    rest = y.times_plus(small, y.times_plus_exactly(large, -t))
    shifted, p = _grown(t, rest)
    z = ((p + 1.0).cast(BITS) + (shifted.cast(BITS) << EXPONENT)).cast(NUMBER)
    nothing = ~x.cast(BITS).differs(x.cast(BITS).like(0)) & y.compare("ogt", 0.0)
    plain = x.compare("oge", LEAST) & x.compare("olt", math.inf) & t.called("fabs").compare("olt", TOP)
    return Rare(nothing.choose(0.0, z), ~(plain | nothing), lambda: one_by_one("pow", [x, y]))


def _fine_log(x: Bundle) -> tuple[Bundle, Bundle]:
    # the logarithm as ``log`` finds it, in two numbers of which the second is what the first lacks
    n, m = _parts(x)
    below, above = m - 1.0, m + 1.0
    inverse = _inverse(above, 3)
    s = below * inverse
    left = s.times_plus_exactly(-above, below)
    left = (-s).times_plus(m - (above - 1.0), left) * inverse
    q = s * s
    cube = s * q
    third = cube * TWO_THIRDS
    left_of_cube = s.times_plus(s.times_plus_exactly(s, -q), s.times_plus_exactly(q, -cube))
    left_of_third = cube.times_plus(LEFT_OF_TWO_THIRDS, cube.times_plus_exactly(TWO_THIRDS, -third))
    rest = (cube * q).times_plus(_polynomial(FINE_LOGARITHM, q), left.times_plus(q + q, left + left))
    rest = n.times_plus(LN_2_LOW, left_of_cube.times_plus(TWO_THIRDS, left_of_third) + rest)
    first, second = n * LN_2_HIGH, s + s
    total = first + second
    whole = total + third
    rest = (second - (total - first)) + (third - (whole - total)) + rest
    large = whole + rest
    return large, rest - (large - whole)


def _grown(x: Bundle, rest: Bundle | None = None) -> tuple[Bundle, Bundle]:
    # n + ROUNDING and exp(r) - 1, where x + rest = n log(2) + r with |r| <= log(2)/2
    shifted = x.times_plus(LOG2_E, ROUNDING)
    n = shifted - ROUNDING
    r = n.times_plus(-LN_2_LOW, n.times_plus(-LN_2_HIGH, x))
    r = r if rest is None else r + rest
    return shifted, (r * r).times_plus(_polynomial(BEYOND_LINEAR, r), r)


def _parts(x: Bundle) -> tuple[Bundle, Bundle]:
    # n and m of x = 2**n m; n becomes a float through the mantissa of ROUNDING
    bits = x.cast(BITS) - ROOT_OF_HALF
    n = ((bits >> EXPONENT) + 4843621399236968448).cast(NUMBER) - ROUNDING
    return n, ((bits & FRACTION) + ROOT_OF_HALF).cast(NUMBER)


def _held(x: Bundle, low: float, high: float) -> Bundle:
    x = x.compare("olt", low).choose(low, x)
    return x.compare("ogt", high).choose(high, x)


def wrightomega(p: Bundle) -> Rare:
    """The solution y of y + log(y) = p."""
    return Rare(_omega_below(p), p.compare("ogt", OMEGA_HIGH), lambda: _omega_above(p))


def _omega_below(p: Bundle) -> Bundle:
    # y = exp(L) with L + exp(L) = p. Start: log2(y), below OMEGA_LOW a straight line. Then the series of y around the
    # start, in m and in b = dL/dp there; what is left out is m**4/24
    low = p.compare("olt", OMEGA_LOW).choose(OMEGA_LOW, p)
    p = p.compare("olt", -700.0).choose(-700.0, p)
    part = _polynomial(OMEGA_TOP, low) * _rough_inverse(_polynomial(OMEGA_BOTTOM, low))
    start = (p - low).times_plus(LOG2_E, part)
    shifted = start + ROUNDING
    y = _two_to(shifted, start - (shifted - ROUNDING))
    b = _inverse(y + 1.0)
    m = (start.times_plus(-LN_2, p) - y) * b
    bend = m.times_plus(b.times_plus(0.5, -1.0 / 3.0), 0.5)
    # y times a number near 1: a product of tiny numbers would take the processor a hundred times as long
    return y * m.times_plus((b * m).times_plus(bend, 1.0), 1.0)


def _omega_above(p: Bundle) -> Bundle:
    # y + log(y) = p by Newton's method
    y = p - log(p)
    for _ in range(3):
        y = y * ((p + 1.0) - log(y)) / (y + 1.0)
    return p.compare("olt", math.inf).choose(y, p)


def minimum(a: Bundle, b: Bundle) -> Bundle:
    """The smaller one, NaN if one is."""
    return b.compare("uno", b).choose(b, b.compare("olt", a).choose(b, a))


def maximum(a: Bundle, b: Bundle) -> Bundle:
    """The larger one, NaN if one is."""
    return b.compare("uno", b).choose(b, b.compare("ogt", a).choose(b, a))


def sign(a: Bundle) -> Bundle:
    """-1, 0, 1 or NaN."""
    side = a.compare("ogt", 0.0).choose(1.0, a.like(0.0))
    side = a.compare("olt", 0.0).choose(-1.0, side)
    return a.compare("uno", a).choose(a, side)


def _two_to(shifted: Bundle, f: Bundle) -> Bundle:
    # 2**(n + f) with |f| <= 1/2, where shifted is n + ROUNDING: n is added to the exponent
    return (_polynomial(POWER_OF_TWO, f).cast(BITS) + (shifted.cast(BITS) << EXPONENT)).cast(NUMBER)


def _polynomial(coefficients: Sequence[float], x: Bundle) -> Bundle:
    *others, last = coefficients
    total = x.like(last)
    for coefficient in reversed(others):
        total = total.times_plus(x, coefficient)
    return total


# 1/x of a positive number: the exponent turned round is right to 5 %; each step below squares or cubes the error. A
# division takes as long as eight of them together
TURNED, CENTRED = 0x7FDE623822FC16E6, 2.0012740


def _rough_inverse(x: Bundle) -> Bundle:
    y = (x.cast(BITS).like(TURNED) - x.cast(BITS)).cast(NUMBER)
    y = y * (-x).times_plus(y, CENTRED)
    return y * (-x).times_plus(y, 2.0)


def _inverse(x: Bundle, steps: int = 2) -> Bundle:
    y = (x.cast(BITS).like(TURNED) - x.cast(BITS)).cast(NUMBER)
    for _ in range(steps):
        miss = (-x).times_plus(y, 1.0)
        y = y.times_plus(miss.times_plus(miss, miss), y)
    return y
