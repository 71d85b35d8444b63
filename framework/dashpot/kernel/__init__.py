"""From a declared network to running code.

trace   - every element's law becomes a graph of its motion, states and parameters
tiers   - what depends on the drive alone, or on a lane alone, leaves the inner loop
source  - the rest is printed as one self-contained file of numba code
native  - the file is kept, content-addressed, and compiled once per machine
columns - the drive of a run, as the kernel wants it
network - CompiledNetwork: simulate and score blocks of lanes
"""
