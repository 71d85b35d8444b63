"""From a declared network to running code.

trace   - every element's law becomes a graph of its motion, states and parameters
tiers   - what depends on the drive alone, or on a lane alone, leaves the inner loop
events  - what a law with memory does at a few samples only leaves it too
stages  - the rest is cut where long functions stand, such as the exponential
layout  - every number of a lane gets a row in the workspace
assembly - how instructions on vectors of lanes are written for the compiler
functions - the long functions
packing - one lane alone: several numbers share a vector
passes  - a pass over a group of lanes is written node by node
source  - all passes of a network become one self-contained text
native  - the text is compiled once per machine, and kept by what it is made of
columns - the drive of a run, as the kernel wants it
block   - groups of lanes that run together, and their memory
compiled - what every compiled network is
network - CompiledNetwork: simulate and score blocks of lanes

Where a network has nodes whose motion is unknown, other stages take the place of the inner ones.

scheme        - the time scheme: how velocities follow from positions
elimination   - solving a small symmetric system of equations, as a graph
mechanics     - kinematics, balance of forces and Newton's step, as graphs
system_source - the passes become one text
system        - CompiledSystem: the same as CompiledNetwork, for several forces and with an estimate of the error
ahead         - compiling before it is needed
settings      - numbers of a network that a run gives by its settings
"""
