"""From a declared network to running code.

trace   - every element's law becomes a graph of its motion, states and parameters
tiers   - what depends on the drive alone, or on a lane alone, leaves the inner loop
events  - what a law with memory does at a few samples only leaves it too
stages  - the rest is cut into loops, long functions on their own
layout  - every number of a lane gets a name in the loops and a row in the workspace
source  - the loops are printed as one self-contained file of numba code
native  - the file is kept, content-addressed, and compiled once per machine
columns - the drive of a run, as the kernel wants it
block   - lanes that run together, and their memory
network - CompiledNetwork: simulate and score blocks of lanes
"""
