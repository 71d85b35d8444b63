"""From a declared network to its program; nothing in here knows a target language.

trace       - every element's law becomes a graph of its motion, states and parameters
events      - what a law with memory does at a few samples only
tiers       - what depends on the drive alone, or on a lane alone, leaves the inner loop
mechanics   - kinematics, balance of forces and Newton's step of networks with unknown nodes, as graphs
multistep   - steps of high order, where all unknown nodes have masses
equilibrium - the static equilibrium at the begin of a record
launch      - the velocities with which it begins
line_search - Newton's method along lines, for steps in which forces bend sharply
equations   - all passes of such a network
elimination - solving a small symmetric system of equations, as a graph
own_tables  - tables that each lane looks up by itself
meter       - rows that follow the energy
kept        - sorted programs on disk
compile     - the stages, called in order; networks that are built alike share one program
"""
