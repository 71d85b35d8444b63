"""The long functions of a kernel, on bundles of vectors and without branches.

A call into the C mathematics library would take the lanes one by one, so exp, log and the Wright omega function are
written out. NaN passes through each of them; relative errors stay below 1e-14 (3e-14 where the Wright omega function is
below 1e-40).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from dashpot.kernel.targets.llvm.assembly import BITS, NUMBER, Bundle
from dashpot.kernel.targets.omega import OMEGA_BOTTOM, OMEGA_HIGH, OMEGA_LOW, OMEGA_TOP

LOG2_E, LN_2 = 1.4426950408889634, 0.6931471805599453
LN_2_HIGH, LN_2_LOW = 0.693145751953125, 1.4286068203094173e-06
# 2**52 + 2**51: a number added to it is rounded to an integer, which stands in the low bits
ROUNDING = 6755399441055744.0
EXPONENT = 52  # bits below the exponent

# 2**f for |f| <= 1/2, constant term first
POWER_OF_TWO = (1.0, 0.6931471805599462, 0.24022650695910075, 0.05550410866465167, 0.009618129107618665,
                0.0013333558200794592, 0.00015403530424776529, 1.5252672924850737e-05, 1.3215451633221434e-06,
                1.0205905413765595e-07, 7.070977866508138e-09)  # fmt: skip
# (log m - 2 s)/s**3 in s**2, s = (m - 1)/(m + 1), for m between sqrt(1/2) and sqrt(2)
LOGARITHM = (0.666666666666667, 0.39999999999899005, 0.28571428626173057, 0.2222221110612709, 0.1818289100504977,
             0.15331664799306263, 0.14617093237558204)  # fmt: skip


def exp(x: Bundle) -> Bundle:
    """The exponential; 1e-308 and 8e307 stand for what is smaller and larger."""
    x = x.compare("olt", -708.0).choose(-708.0, x)
    x = x.compare("ogt", 709.0).choose(709.0, x)
    shifted = x.times_plus(LOG2_E, ROUNDING)
    n = shifted - ROUNDING
    rest = n.times_plus(-LN_2_LOW, n.times_plus(-LN_2_HIGH, x))
    return _two_to(shifted, rest * LOG2_E)


def log(x: Bundle) -> Bundle:
    """The natural logarithm, of numbers that are not denormal."""
    # x = 2**n m, log m = 2 atanh(s), s = (m - 1)/(m + 1). n becomes a float through the mantissa of ROUNDING
    bits = x.cast(BITS) - 4604544271217802189
    n = ((bits >> EXPONENT) + 4843621399236968448).cast(NUMBER) - ROUNDING
    m = ((bits & 4503599627370495) + 4604544271217802189).cast(NUMBER)
    s = (m - 1.0) * _inverse(m + 1.0, 3)
    q = s * s
    y = n.times_plus(LN_2, s.times_plus(2.0, s * q * _polynomial(LOGARITHM, q)))
    y = x.compare("oeq", 0.0).choose(-math.inf, y)
    y = x.compare("olt", 0.0).choose(math.nan, y)
    return x.compare("olt", math.inf).choose(y, x)


def wrightomega(p: Bundle) -> Bundle:
    """The solution y of y + log(y) = p."""
    return wrightomega_above(p, wrightomega_below(p))


def wrightomega_above(p: Bundle, below: Bundle) -> Bundle:
    """The same from what ``wrightomega_below`` answers."""
    high = p.compare("ogt", OMEGA_HIGH)
    return p.assembly.amended(high, below, lambda: high.choose(_omega_above(p), below))


def wrightomega_below(p: Bundle) -> Bundle:
    """The Wright omega function of what is not above ``OMEGA_HIGH``."""
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
