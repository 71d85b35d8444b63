"""The Wright omega function y of y + log(y) = p: where every target starts from.

Start from log2(y), below OMEGA_LOW a straight line. Then the series of y around the start, in the miss m and in
b = dL/dp there, leaves m**4/24. Above OMEGA_HIGH Newton's method is better.
"""

from __future__ import annotations

# log2(omega(p)) to 3e-4 as a quotient, for p between -8 and 24
OMEGA_TOP = (
    -0.8186519570288853,
    0.7010005474163719,
    0.08235211367797804,
    0.033564115415736305,
    0.0017453797235457513,
    0.00011072075573655662,
)
OMEGA_BOTTOM = (
    1.0,
    0.268335298843771,
    0.07218180668419655,
    0.007771445050429686,
    0.0005511463825132435,
    1.4265236442888172e-05,
)
OMEGA_LOW, OMEGA_HIGH = -8.0, 24.0
