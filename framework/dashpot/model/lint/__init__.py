"""What is weak in the structure of a network, found before any data: nothing is fitted, laws are only probed.

weaknesses - all of it, in the order of the text
graph      - nodes that nothing holds
law        - a branch on plain numbers
response   - what can be measured of a network, by small motions around many points
sensitivity - parameters without influence, and parameters that cannot be distinguished
power      - factors that make a branch give back more work than was put in
"""

from dashpot.model.lint.weaknesses import find_weaknesses

__all__ = ["find_weaknesses"]
