"""From a declared network to running code.

compiler - a network becomes a program: the stages, called in order
ir       - what a program is, whatever the language
targets  - languages that programs are printed in, and compiled

cache    - where what is compiled is kept

The modules beside them run what is compiled:

columns   - the drive of a run, as the kernel wants it
block     - groups of lanes that run together, and their memory
compiled  - what every compiled network is
network   - CompiledNetwork: simulate and score blocks of lanes
scheme    - the time scheme of networks with unknown nodes: how velocities follow from positions
pieces    - what drives the steps of such a network, piece by piece
system    - CompiledSystem: the same as CompiledNetwork, for several forces and with an estimate of the error
parts     - a parallel network branch by branch
eager     - the same in plain numpy: the reference
ahead     - compiling before it is needed
settings  - parameters of a network that a run gives by its settings
observe   - how a load cell shows a force
jit       - a network as functions for somebody else's compiled code
export    - what exporters need of a network
"""
