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
compiled - what every compiled network is
network - CompiledNetwork: simulate and score blocks of lanes

Where a network has nodes whose motion is unknown, other stages take the place of the inner ones.

scheme        - the time scheme: how velocities follow from positions
elimination   - solving a small symmetric system of equations, as a graph
mechanics     - kinematics, balance of forces and Newton's step, as graphs
system_source - the passes are printed as one file of numba code
system        - CompiledSystem: the same as CompiledNetwork, for several forces and with an estimate of the error
settings      - numbers of a network that a run gives by its settings
"""
